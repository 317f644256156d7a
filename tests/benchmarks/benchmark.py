"""How fast, how exact and how large: the table of workflow/report/performance.md.

    python tests/benchmarks/benchmark.py

Not a test: machines are noisy, so nothing here passes or fails. Each time is the shortest of
three; what takes long runs once.
"""

import multiprocessing
import sys
import time
from pathlib import Path

import numpy as np

# As a script it finds the modules of tests/helpers/.
sys.path.insert(0, str(Path(__file__).parents[1] / "helpers"))

from direct_sum import direct_total, gap_of_bodies
from elastic_libraries import library_pressure, library_pull_off
from measurements import cut_scan, uncd_density

from hardcontact.base.arrays import generator
from hardcontact.contact.bearing_area import all_contact_pixels
from hardcontact.contact.contact import Contact
from hardcontact.contact.elastic import adhesive_pull_off, pressure_at_load
from hardcontact.contact.geometry import join_bodies, reference_gap_map, square_around_lowest
from hardcontact.contact.pull_off import attraction_sums
from hardcontact.surfaces.filters import interpolate, lowpass
from hardcontact.surfaces.height_map import mirror_scan
from hardcontact.surfaces.levelling import level_plane
from hardcontact.surfaces.synthesis import random_surface

RHO, MODULUS, WORK = 5.6, 289.7e9, 46.3e-3  # nm, Pa, J/m²: the paper's
CONTACT = Contact(radius=250e3, preload=10e-6, hardness=25e9, window=12500.0, contacts_per_row=20)
#: Indices (i, j) of contacts whose direct sums are timed.
TIMED_CONTACTS = [(0, 0), (7, 13), (19, 4)]


def uncd_surface(pixels):
    return random_surface(generator(1, "benchmark", pixels), pixels, 5000 / pixels, uncd_density)


def bodies_in_contact(substrate):
    """Return a substrate below a smooth sphere, and the number of pixels in contact."""
    bodies = join_bodies(substrate, None, CONTACT)
    return bodies, CONTACT.pixel_count(bodies.geometry.pixel_size)


def timed(function, *arguments, repeats=3):
    """Return the shortest time of a call in seconds, and its result."""
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        result = function(*arguments)
        times.append(time.perf_counter() - start)
    return min(times), result


def plastic_sums(substrate):
    """Return the force sums (contact_y, contact_x) of plastic contacts with a smooth sphere."""
    bodies, count = bodies_in_contact(substrate)
    return attraction_sums(bodies, all_contact_pixels(bodies, count), [count], [RHO])[0, 0]


def force_sum_rows():
    substrate = uncd_surface(8192)
    bodies, count = bodies_in_contact(substrate)

    def direct_sums():
        return [direct_total(gap_of_bodies(bodies, index), count, RHO) for index in TIMED_CONTACTS]

    seconds, totals = timed(plastic_sums, substrate)
    direct_seconds, expected = timed(direct_sums, repeats=1)
    error = max(
        abs(totals[index] / total - 1)
        for index, total in zip(TIMED_CONTACTS, expected, strict=True)
    )
    slowdown = direct_seconds * CONTACT.contacts_per_row**2 / len(TIMED_CONTACTS) / seconds
    yield "400 plastic contacts on 8192² pixels", seconds, f"direct sum {slowdown:.3g}, {error:.1e}"


def elastic_rows():
    random = random_surface(generator(1, "benchmark pair"), 1024, 2500 / 512, uncd_density)
    bodies, _ = bodies_in_contact(mirror_scan(level_plane(cut_scan(random, 512))))
    window = square_around_lowest(reference_gap_map(bodies, (3, 5)), 512)
    problem = window, bodies.geometry.pixel_size, MODULUS
    seconds, pressure = timed(pressure_at_load, *problem, CONTACT.preload)
    library_seconds, expected = timed(library_pressure, *problem, CONTACT.preload)
    error = abs(pressure - expected).max() / expected.max()
    slowdown = library_seconds / seconds
    yield "elastic contact at the preload", seconds, f"library {slowdown:.3g}, {error:.1e}"
    seconds, (_, force) = timed(adhesive_pull_off, *problem, WORK, RHO, repeats=1)
    library_seconds, expected = timed(library_pull_off, *problem, WORK, RHO, repeats=1)
    error, slowdown = abs(force / expected - 1), library_seconds / seconds
    yield "elastic pull-off", seconds, f"library {slowdown:.3g}, {error:.1e}"


def filtered_job(pixels, results):
    """Put seconds and peak memory (GiB) of a cutoff of Fig. 6 into a queue of another process."""
    substrate = uncd_surface(pixels)
    cutoff = 43.0  # the paper's short edge in nm
    seconds, _ = timed(
        lambda: plastic_sums(interpolate(lowpass(substrate, cutoff), pixels)), repeats=1
    )
    # The high-water mark of this process alone; getrusage would begin at its parent's.
    peak = next(line for line in Path("/proc/self/status").open() if line.startswith("VmHWM"))
    results.put((seconds, int(peak.split()[1]) / 2**20))


def cutoff_rows():
    context = multiprocessing.get_context("spawn")
    for pixels in (4096, 16384):
        results = context.Queue()
        process = context.Process(target=filtered_job, args=(pixels, results))
        process.start()
        seconds, peak = results.get()
        process.join()
        yield f"a cutoff of Fig. 6 on {pixels}² pixels", seconds, f"peak {peak:.2f} GiB"


def main():
    print(f"numpy {np.__version__}\n\n| what | time | times as long, difference |\n|---|---|---|")
    for rows in (force_sum_rows(), elastic_rows(), cutoff_rows()):
        for description, seconds, comparison in rows:
            print(f"| {description} | {seconds:.2f} s | {comparison} |", flush=True)


if __name__ == "__main__":
    main()
