"""How fast, how exact and how large: ratios within one run, printed as a table.

    python tests/benchmarks/benchmark.py [--threads 2] [--largest 16384]

Not a test: machines are noisy, so nothing here passes or fails. Every row times both sides in the
same process, in turn, and takes the median of three.
"""

import argparse
import datetime
import multiprocessing
import os
import platform
import statistics
import sys
import time
from pathlib import Path

import numpy as np
from scipy import fft

# As a script it finds the modules of tests/helpers/.
sys.path.insert(0, str(Path(__file__).parents[1] / "helpers"))

from direct_sum import direct_total, gap_of_bodies
from elastic_libraries import library_pressure, library_pull_off
from measurements import cut_scan, uncd_density

from hardcontact.base.arrays import generator
from hardcontact.contact.bearing_area import all_contact_pixels
from hardcontact.contact.contact import Contact
from hardcontact.contact.elastic import adhesive_pull_off, pressure_at_load
from hardcontact.contact.force_sum.outside_sums import outside_sums
from hardcontact.contact.geometry import join_bodies, part_around_lowest, reference_gap_map
from hardcontact.contact.pull_off import attraction_sums
from hardcontact.surfaces.filters import interpolate, lowpass
from hardcontact.surfaces.height_map import mirror_scan
from hardcontact.surfaces.levelling import level_plane
from hardcontact.surfaces.synthesis import random_surface

RADIUS, RHO = 250e3, 5.6
CONTACTS = 20
CONTACT = Contact(
    radius=RADIUS, preload=10e-6, hardness=25e9, window=12500.0, contacts_per_row=CONTACTS
)
MODULUS, WORK = 289.7e9, 46.3e-3
RHOS = [0.5, 1, 2, 3, 4, 5, 5.6, 6, 7, 8, 9, 10]


def surface(pixels):
    return random_surface(generator(1, "benchmark", pixels), pixels, 5000 / pixels, uncd_density)


def bodies_in_contact(substrate, sphere=None):
    """Return substrate and sphere with the study's contacts, and the number of contact pixels."""
    bodies = join_bodies(substrate, sphere, CONTACT)
    return bodies, CONTACT.pixel_count(bodies.geometry.pixel_size)


def timed(function, repeats=3):
    """Return the median seconds of a call, and its result."""
    ((seconds, result),) = timed_in_turn(function, repeats=repeats)
    return seconds, result


def timed_in_turn(*functions, repeats=3):
    """As `timed`, for each of several functions that are called in turn."""
    seconds, results = [[] for _ in functions], [None] * len(functions)
    for _ in range(repeats):
        for k, function in enumerate(functions):
            start = time.perf_counter()
            results[k] = function()
            seconds[k].append(time.perf_counter() - start)
    return [
        (statistics.median(call_seconds), result)
        for call_seconds, result in zip(seconds, results, strict=True)
    ]


def times_as_long(ratio):
    """Return a ratio of times in words, relative to a row above."""
    return f"{float(f'{ratio:.3g}'):g} times as long"


def pull_off(substrate):
    """Plastic totals (contact_y, contact_x) of a smooth sphere, closest approach included."""
    bodies, contact_pixel_count = bodies_in_contact(substrate)
    contacts = all_contact_pixels(bodies, contact_pixel_count)
    return attraction_sums(bodies, contacts, [contact_pixel_count], [RHO])[0, 0]


def smooth_sphere(threads):
    substrate = surface(8192)
    heights = substrate.heights
    transform, _ = timed(
        lambda: fft.irfft2(fft.rfft2(heights.astype(float), workers=threads), workers=threads)
    )
    fast, totals = timed(lambda: pull_off(substrate))
    contacts = [(0, 0), (7, 13), (19, 4)]
    bodies, contact_pixel_count = bodies_in_contact(substrate)
    slow, direct_sums = timed(
        lambda: [
            direct_total(gap_of_bodies(bodies, contact), contact_pixel_count, RHO)
            for contact in contacts
        ],
        1,
    )
    slow *= CONTACTS**2 / len(contacts)
    error = max(
        abs(totals[contact] / value - 1)
        for contact, value in zip(contacts, direct_sums, strict=True)
    )
    yield "400 plastic contacts on 8192² pixels, smooth sphere", f"{fast:.2f} s"
    yield "a forward and an inverse FFT of this surface", times_as_long(transform / fast)
    yield "the direct sum, from 3 of the contacts", times_as_long(slow / fast)
    yield "largest relative difference from the direct sum", f"{error:.1e}"


def mirrored(seed, scale):
    """A mirrored scan of 512² pixels with the spectrum of UNCD times `scale`."""
    rng = generator(seed, "benchmark pair")
    random = random_surface(rng, 1024, 2500 / 512, lambda q: scale * uncd_density(q))
    scan = cut_scan(random, 512)
    return mirror_scan(level_plane(scan))


def rough_sphere():
    bodies, contact_pixel_count = bodies_in_contact(mirrored(1, 1.0), mirrored(2, 4e-4))

    def fast():
        return contact_pixel_count + outside_sums(
            bodies, all_contact_pixels(bodies, contact_pixel_count), RHOS
        )

    def direct(contact, rho):
        return direct_total(gap_of_bodies(bodies, contact), contact_pixel_count, rho)

    quick, totals = timed(fast)
    contacts = [(i, j) for i in range(0, CONTACTS, 5) for j in range(2, CONTACTS, 6)]
    slow, direct_sums = timed(
        lambda: [[direct(contact, rho) for contact in contacts] for rho in RHOS], 1
    )
    slow *= CONTACTS**2 / len(contacts)
    error = max(
        abs(totals[k][contact] / value - 1)
        for k, row in enumerate(direct_sums)
        for contact, value in zip(contacts, row, strict=True)
    )
    yield "400 contacts at 12 ranges on 1024² pixels, rough sphere", f"{quick:.2f} s"
    yield f"the direct sum, from {len(contacts)} of the contacts", times_as_long(slow / quick)
    yield "largest relative difference from the direct sum", f"{error:.1e}"


def elastic_contact(pixels=512):
    bodies, _ = bodies_in_contact(mirrored(1, 1.0))
    pixel = bodies.geometry.pixel_size
    gap = part_around_lowest(reference_gap_map(bodies, (3, 5)), pixels)
    window = f"window of {pixels}² pixels"
    (seconds, pressure), (library_seconds, expected) = timed_in_turn(
        lambda: pressure_at_load(gap, pixel, MODULUS, CONTACT.preload),
        lambda: library_pressure(gap, pixel, MODULUS, CONTACT.preload),
    )
    yield f"elastic contact at the preload, {window}", f"{seconds:.2f} s"
    yield "ContactMechanics", times_as_long(library_seconds / seconds)
    yield (
        "largest difference, of the peak",
        f"{abs(pressure - expected).max() / expected.max():.1e}",
    )
    (seconds, (_, force)), (library_seconds, expected) = timed_in_turn(
        lambda: adhesive_pull_off(gap, pixel, MODULUS, WORK, RHO),
        lambda: library_pull_off(gap, pixel, MODULUS, WORK, RHO),
        repeats=1,
    )
    yield f"elastic pull-off, {window}", f"{seconds:.2f} s"
    yield "Adhesion", times_as_long(library_seconds / seconds)
    yield "relative difference of the force", f"{abs(force / expected - 1):.1e}"


def filtered_job(pixels, answer):
    """Answer seconds and peak memory (GiB) of one job of Fig. 6 in a separate process."""
    substrate = surface(pixels)
    start = time.perf_counter()
    pull_off(interpolate(lowpass(substrate, 43.0), pixels))
    seconds = time.perf_counter() - start
    # The high-water mark of this process alone; getrusage would begin at its parent's.
    peak = next(line for line in Path("/proc/self/status").open() if line.startswith("VmHWM"))
    answer.put((seconds, int(peak.split()[1]) / 2**20))


def growth(largest):
    context, previous = multiprocessing.get_context("spawn"), None
    for pixels in (4096, 8192, 16384):
        if pixels > largest:
            continue
        answer = context.Queue()
        process = context.Process(target=filtered_job, args=(pixels, answer))
        process.start()
        seconds, peak = answer.get()
        process.join()
        factor = f", {times_as_long(seconds / previous)}" if previous else ""
        previous = seconds
        yield (
            f"a cutoff of Fig. 6 (filter, interpolation, 400 contacts) on {pixels}² pixels",
            f"{seconds:.2f} s{factor}, peak {peak:.2f} GiB",
        )


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--threads", type=int, default=os.cpu_count())
    parser.add_argument("--largest", type=int, default=16384)
    options = parser.parse_args()
    model = next(
        (
            line.split(":")[1].strip()
            for line in Path("/proc/cpuinfo").open()
            if line.startswith("model name")
        ),
        platform.processor(),
    )
    print(
        f"{datetime.date.today()}, {model}, {options.threads} threads, "
        f"Python {platform.python_version()}, numpy {np.__version__}\n"
    )
    print("| what | measured |\n| --- | --- |")
    for rows in (
        smooth_sphere(options.threads),
        rough_sphere(),
        elastic_contact(),
        growth(options.largest),
    ):
        for description, value in rows:
            print(f"| {description} | {value} |", flush=True)


if __name__ == "__main__":
    main()
