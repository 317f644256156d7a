"""The costs of more realizations and larger masters, from the jobs of a finished study.

    python tests/benchmarks/cost.py [--study paper]

Prints a table of core hours, memory and disk. Times are processor times of the jobs as Snakemake
measured them, so that other work of the machine counts little. They include the start-up of jobs,
but not Snakemake's own process.
"""

import argparse
import re
from math import log2
from pathlib import Path

import pandas as pd
import yaml

#: Rules with jobs for each realization.
MASTERS = ["synthesize_masters"]
FILTERED = ["compute_filtered_forces/scales"]


def processor(row):
    """Processor time of a job (s), from the last look that Snakemake took at it.

    It looks twice a second for 15.5 s, then every 30 s; the time after the last look is taken to
    be as busy as that before.
    """
    # A job that ends before the first look has a wall time only.
    if not row.cpu_time > 0:
        return row.s
    looked = row.s if row.s < 15.5 else 15.5 + 30 * ((row.s - 15.5) // 30)
    return row.cpu_time * row.s / looked


def jobs(folders):
    """One row per job: rule, seconds of processor, memory in MB."""
    rows = []
    for folder in folders:
        for path in sorted(Path(folder, "benchmarks").rglob("*.tsv")):
            row = pd.read_csv(path, sep="\t").iloc[-1]
            rule, *wildcards = path.relative_to(Path(folder, "benchmarks")).with_suffix("").parts
            rule = re.sub(r"(_\d+)+$", "", rule)  # the numbers of scans that are made together
            if rule == "compute_filtered_forces":  # by purpose: scales, sets, and so on
                rule = f"{rule}/{wildcards[0]}"
            rows.append(
                {"rule": rule, "seconds": processor(row), "memory": row.max_rss * 2**20 / 1e6}
            )
    return pd.DataFrame(rows)


def size(paths):
    """Bytes of files."""
    return sum(path.stat().st_size for path in paths)


def row(name, seconds, memory, disk):
    print(f"| {name} | {seconds / 3600:.3g} h | {memory / 1000:.2g} GB | {disk / 1e9:.3g} GB |")


def costs(study):
    """Print the table for the study's configuration and for larger studies."""
    results = Path("results", study)
    configuration = yaml.safe_load((results / "configuration.yaml").read_text())
    store, count = Path(configuration["store"]), configuration["scales"]["realizations"]
    pixels = configuration["scales"]["short"]["pixels"]
    job_costs = jobs([store, results])
    is_repeated = job_costs.rule.isin(MASTERS + FILTERED)
    fixed, per_realization = (
        job_costs.seconds[~is_repeated].sum(),
        job_costs.seconds[is_repeated].sum() / count,
    )
    masters = size((store / "masters").rglob("*.nc"))
    forces = size((store / "filtered/scales").rglob("*.nc"))
    other_disk = (
        size(path for path in Path("results").rglob("*") if path.is_file()) - masters - forces
    )
    memory, largest = job_costs.memory[is_repeated].max(), job_costs.memory.max()
    print("| study | core time | largest job | disk |\n|---|---|---|---|")
    for realizations in (count, 10, 100, 10_000):
        disk = other_disk + (masters + forces) * realizations / count
        row(f"{realizations} realizations", fixed + realizations * per_realization, largest, disk)
    finer = 32768 / pixels
    slower = finer**2 * log2(32768) / log2(pixels)  # as the Fourier transforms that it consists of
    row(
        f"{count} realizations of 32768² pixels",
        fixed + count * per_realization * slower,
        memory * finer**2,
        other_disk + forces + masters * finer**2,
    )
    print(f"{len(job_costs)} jobs, {job_costs.seconds.sum() / 60:.0f} core minutes")
    print(job_costs.groupby("rule").agg({"seconds": ["count", "mean", "sum"], "memory": "max"}))


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--study", default="paper")
    costs(parser.parse_args().study)
