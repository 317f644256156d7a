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
import time
from pathlib import Path

import numpy as np
from Adhesion.Interactions import Exponential
from Adhesion.System import BoundedSmoothContactSystem
from ContactMechanics import PeriodicFFTElasticHalfSpace
from ContactMechanics.Systems import NonSmoothContactSystem
from scipy import fft
from scipy.optimize import minimize_scalar
from SurfaceTopography import Topography

from hardcontact import adhesion, contact, elastic, fourier, spectrum, sphere, synthesis, topography

RADIUS, WINDOW, LOAD, HARDNESS, RHO = 250e3, 12500.0, 10e-6, 25e9, 5.6
MODULUS, WORK = 289.7e9, 46.3e-3
RHOS = [0.5, 1, 2, 3, 4, 5, 5.6, 6, 7, 8, 9, 10]
CONTACTS = 20


def uncd(q):
    """Measured C_iso (nm⁴) of UNCD: resources/spectra/uncd.csv."""
    return spectrum.smooth_rolloff(q, 6.1e7, 930.0, 0.84)


def surface(pixels):
    rng = synthesis.generator(1, "benchmark", pixels)
    return synthesis.random_surface(rng, pixels, 5000 / pixels, uncd)


def timed(function, repeats=3):
    """Median seconds of a call, and what it returned."""
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
    return [(statistics.median(one), result) for one, result in zip(seconds, results, strict=True)]


def pull_off(heights, threads):
    """Plastic totals (contact, contact) of a smooth sphere, closest approach included."""
    pixels = heights.shape[0]
    pixel = 5000 / pixels
    positions = sphere.contact_positions(pixels, CONTACTS)
    window = sphere.window_pixels(WINDOW, pixel)
    touching = contact.contact_pixel_count(LOAD, HARDNESS, pixel)
    contacts = contact.all_lowest_gaps(heights, positions, pixel, RADIUS, window, touching)
    sums, h_max = adhesion.smooth_sphere_sums(
        heights, positions, pixel, RADIUS, window, RHO, threads
    )
    return np.array(
        [
            adhesion.plastic_total(sums[place], h_max, gaps, RHO)
            for place, (gaps, _) in contacts.items()
        ]
    ).reshape(CONTACTS, CONTACTS)


def direct(heights, roughness, place, pixel, rho):
    """The same total by the sum over every pixel pair of the window."""
    positions = sphere.contact_positions(heights.shape[0], CONTACTS)
    window = sphere.window_pixels(WINDOW, pixel)
    touching = contact.contact_pixel_count(LOAD, HARDNESS, pixel)
    gaps = contact.gap_map(heights, positions[list(place)], pixel, RADIUS, window, roughness)
    return touching + adhesion.direct_sum(gaps, touching, rho)


def smooth_sphere(threads):
    heights, flat = surface(8192), np.zeros((1, 1))
    transform, _ = timed(
        lambda: fft.irfft2(fft.rfft2(heights.astype(float), workers=threads), workers=threads)
    )
    fast, totals = timed(lambda: pull_off(heights, threads))
    places = [(0, 0), (7, 13), (19, 4)]
    slow, expected = timed(
        lambda: [direct(heights, flat, place, 5000 / 8192, RHO) for place in places], 1
    )
    slow *= CONTACTS**2 / len(places)
    error = max(
        abs(totals[place] / value - 1) for place, value in zip(places, expected, strict=True)
    )
    yield "8192², 400 plastic contacts, smooth sphere", f"{fast:.2f} s"
    yield "forward and inverse real FFT of that surface / that", f"{transform / fast:.1f}"
    yield "direct sum, 3 contacts scaled to 400 / that", f"{slow / fast:.0f}"
    yield "largest relative difference to the direct sum", f"{error:.1e}"


def rough_sphere():
    pixel = 2500 / 512
    maps = []
    for seed, scale in ((1, 1.0), (2, 4e-4)):
        rng = synthesis.generator(seed, "benchmark pair")
        scan = synthesis.substitute_scan(
            rng, 512, pixel, 1024, lambda q, scale=scale: scale * uncd(q), 0.0, 0.0
        )
        maps.append(topography.mirror_stitch(topography.level(scan, pixel)))
    positions = sphere.contact_positions(1024, CONTACTS)
    window = sphere.window_pixels(WINDOW, pixel)
    touching = contact.contact_pixel_count(LOAD, HARDNESS, pixel)

    def fast():
        contacts = contact.all_lowest_gaps(
            maps[0], positions, pixel, RADIUS, window, touching, maps[1]
        )
        return touching + adhesion.rough_sphere_sums(
            *maps, positions, contacts, pixel, RADIUS, window, RHOS
        )

    quick, totals = timed(fast)
    places = [(i, j) for i in range(0, CONTACTS, 5) for j in range(2, CONTACTS, 6)]
    slow, expected = timed(
        lambda: [[direct(*maps, place, pixel, rho) for place in places] for rho in RHOS], 1
    )
    slow *= CONTACTS**2 / len(places)
    error = max(
        abs(totals[k][place] / value - 1)
        for k, row in enumerate(expected)
        for place, value in zip(places, row, strict=True)
    )
    yield "1024² stitched pair, 400 contacts, 12 ranges, rough sphere", f"{quick:.2f} s"
    yield f"direct sum, {len(places)} contacts scaled to 400 / that", f"{slow / quick:.0f}"
    yield "largest relative difference to the direct sum", f"{error:.1e}"


def library_at_load(gap, pixel):
    """What `elastic.contact_at_load` asks the library for, in its units (nm, nN), unchecked."""
    size = (gap.shape[0] * pixel,) * 2
    half_space = PeriodicFFTElasticHalfSpace(gap.shape, MODULUS * 1e-9, size)
    body = Topography(gap.mean() - gap, size, periodic=True)
    system = NonSmoothContactSystem(half_space, body)
    return system.minimize_proxy(external_force=LOAD * 1e9, pentol=elastic.OVERLAP / 2)


def library_pull_off(gap, pixel):
    """What `elastic.adhesive_pull_off` asks the library for, unchecked."""
    heights, size = gap.min() - gap, (gap.shape[0] * pixel,) * 2
    attraction = WORK / RHO * pixel**2 * np.exp(heights / RHO)
    half_space = PeriodicFFTElasticHalfSpace(gap.shape, MODULUS * 1e-9, size)
    body = Topography(heights, size, periodic=True)
    system = BoundedSmoothContactSystem(half_space, Exponential(WORK, RHO), body)
    system.disp = half_space.evaluate_disp(attraction)
    stretch = -system.disp.min()
    options = {"ftol": 0, "gtol": elastic.RESIDUAL * attraction.max(), "maxiter": 5000}

    def force(offset):
        start = np.maximum(system.disp, heights + offset)
        system.minimize_proxy(offset=offset, initial_displacements=start, options=options)
        return system.interaction_force.sum() - system.force[system.gap <= 0].sum()

    bounds = (-1.5 * stretch, 0)
    return minimize_scalar(force, bounds=bounds, method="bounded", options={"xatol": stretch / 6})


def elastic_contact(pixels=512):
    pixel = 2500 / 512
    heights = surface(1024)
    positions = sphere.contact_positions(1024, CONTACTS)[[3, 5]]
    window = sphere.window_pixels(WINDOW, pixel)
    gap = contact.gap_map(heights, positions, pixel, RADIUS, window, np.zeros((1, 1)))
    gap = contact.around_lowest(gap, pixels)
    for what, ours, library in (
        (
            "elastic contact at the preload",
            lambda: elastic.contact_at_load(gap, pixel, MODULUS, LOAD),
            lambda: library_at_load(gap, pixel),
        ),
        (
            "elastic pull-off",
            lambda: elastic.adhesive_pull_off(gap, pixel, MODULUS, WORK, RHO),
            lambda: library_pull_off(gap, pixel),
        ),
    ):
        (checked, _), (alone, _) = timed_in_turn(ours, library)
        yield f"{pixels}² window: {what}", f"{checked:.2f} s"
        yield "that / calling the library alone, unchecked", f"{checked / alone:.2f}"


def filtered_job(pixels, threads, answer):
    """What one job of Fig. 6 does at a size, in a process of its own: seconds, peak memory."""
    heights = surface(pixels)
    start = time.perf_counter()
    band, _ = fourier.lowpass(heights, 5000 / pixels, 43.0)
    pull_off(fourier.interpolate(band, pixels), threads)
    seconds = time.perf_counter() - start
    # The high-water mark of this process alone; getrusage would begin at its parent's.
    peak = next(line for line in Path("/proc/self/status").open() if line.startswith("VmHWM"))
    answer.put((seconds, int(peak.split()[1]) / 2**20))


def growth(threads, largest):
    context, previous = multiprocessing.get_context("spawn"), None
    for pixels in (4096, 8192, 16384):
        if pixels > largest:
            continue
        answer = context.Queue()
        process = context.Process(target=filtered_job, args=(pixels, threads, answer))
        process.start()
        seconds, peak = answer.get()
        process.join()
        factor = f", {seconds / previous:.1f} x the time before" if previous else ""
        previous = seconds
        yield (
            f"{pixels}²: filter, interpolate, 400 contacts",
            (f"{seconds:.2f} s, peak {peak:.2f} GiB{factor}"),
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
        growth(options.threads, options.largest),
    ):
        for what, value in rows:
            print(f"| {what} | {value} |", flush=True)


if __name__ == "__main__":
    main()
