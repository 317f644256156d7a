"""Processor time of a finished study by rule, and what of it transforms and sums take.

    python tests/benchmarks/rule_times.py [--study paper]

The second time is composed of kernels that this run times: random numbers, Fourier transforms and
exponentials of arrays as large as those of the rule, each as often as its result needs it. It is no
bound that a rule could reach: the search for contact pixels, reading, writing and the start of jobs
are not in it. Rules without it do other things.
"""

import argparse
import time
from functools import cache
from pathlib import Path

import numpy as np
import yaml
from cost import jobs
from scipy import fft

from hardcontact.config.files import CHUNK


@cache
def kernels(pixels):
    """Processor seconds of random numbers, transforms both ways and exponentials, best of three."""
    heights = np.random.default_rng(1).standard_normal((pixels, pixels), np.float32)
    transform = fft.rfft2(heights)
    blocks = heights.reshape(-1, 64, pixels)  # rows that stay in the cache
    block = np.empty((64, pixels))
    calls = {
        "draw": lambda: np.random.default_rng(1).standard_normal((pixels, pixels)),
        "forward": lambda: fft.rfft2(heights),
        "inverse": lambda: fft.irfft2(transform),
        "exponential": lambda: [np.exp(rows, out=block, dtype=float) for rows in blocks],
    }
    return {name: min(processor_seconds(call) for _ in range(3)) for name, call in calls.items()}


def processor_seconds(call):
    start = time.process_time()
    call()
    return time.process_time() - start


def filter_seconds(pixels, cutoffs):
    """One transform of a master, then for it and every cutoff an inverse one and a sum."""
    seconds = kernels(pixels)
    return seconds["forward"] + (len(cutoffs) + 1) * (seconds["inverse"] + seconds["exponential"])


def surface_seconds(pixels):
    """A random surface: random numbers and an inverse transform."""
    return kernels(pixels)["draw"] + kernels(pixels)["inverse"]


def kernel_seconds(configuration, store):
    """Return the processor seconds of the kernels of each rule that consists of them."""
    sides = {
        side: len(list((store / "masters").rglob(f"{side}.nc"))) for side in ("small", "large")
    }
    chunks = [path.stem.split("-")[1:3] for path in (store / "filtered/sets").rglob("*.nc")]
    realizations = sum(int(last) - int(first) + 1 for first, last in chunks)
    scales, sets = configuration["scales"], configuration["sets"]
    scan = 2 * configuration["scan"]["pixels"]  # stitched
    scan_seconds = len(configuration["adhesion"]["ranges"]) * kernels(scan)["exponential"]
    pools = len(list((store / "pool").rglob("*.nc")))
    return {
        "filter_masters/scales": sum(
            count * filter_seconds(scales[side]["pixels"], scales[side]["cutoffs"])
            for side, count in sides.items()
        ),
        "filter_masters/sets": sum(
            realizations * (surface_seconds(sets[side]["pixels"]) + filter_seconds(**sets[side]))
            for side in sides
        ),
        "synthesize_masters": sides["small"] * surface_seconds(scales["small"]["pixels"]),
        "compute_pool": pools * CHUNK * sets["rms_heights"] * scan_seconds,
    }


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--study", default="paper")
    results = Path("results", parser.parse_args().study)
    configuration = yaml.safe_load((results / "configuration.yaml").read_text())
    store = Path(configuration["store"])
    rule_times = jobs([store, results]).groupby("rule").seconds.agg(["count", "sum"])
    rule_kernels = kernel_seconds(configuration, store)
    print("| rule | jobs | processor minutes | of it kernels |\n|---|---|---|---|")
    for rule, row in rule_times.sort_values("sum", ascending=False).iterrows():
        kernel_cell = f"{rule_kernels[rule] / 60:.2f}" if rule in rule_kernels else ""
        print(f"| {rule} | {row['count']:.0f} | {row['sum'] / 60:.2f} | {kernel_cell} |")
    kernel_minutes = sum(rule_kernels.values()) / 60
    print(f"{rule_times['sum'].sum() / 60:.0f} processor minutes, kernels {kernel_minutes:.0f}")
