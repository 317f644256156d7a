"""What a job of each rule costs, and what the terminal calls its stage: the table costs.tsv.

After a quick study, this renews the costs from its benchmarks:
``python workflow/snakemake_logger_plugin_stages/costs.py results/quick results/store-quick``
"""

import csv
import sys
from pathlib import Path
from statistics import mean, median
from typing import NamedTuple

TABLE = Path(__file__).with_name("costs.tsv")


class Stage(NamedTuple):
    """Processor time of a job of the quick study in s, and the name that the terminal shows."""

    seconds: float
    name: str


def read_stages() -> dict[str, Stage]:
    """Return the stage of each rule in the table."""
    with open(TABLE, newline="") as file:
        rows = csv.DictReader(file, delimiter="\t")
        return {row["rule"]: Stage(float(row["seconds"]), row["name"]) for row in rows}


def stage_of(rule: str, stages: dict[str, Stage]) -> Stage:
    """Return the stage of a rule; rules made in a loop share that of the name they begin with.

    A rule that is not in the table has the median cost and its own name.
    """
    names = [name for name in stages if rule == name or rule.startswith(f"{name}_")]
    if not names:
        return Stage(median(stage.seconds for stage in stages.values()), rule.replace("_", " "))
    longest = max(names, key=len)
    words = rule.removeprefix(longest).replace("_", " ")
    return Stage(stages[longest].seconds, stages[longest].name + words)


def measured_seconds(rule: str, folders: list[str]) -> list[float]:
    """Return the processor times (s) in the benchmarks of all jobs of a rule."""
    paths = [
        path
        for folder in folders
        for pattern in (f"{rule}.tsv", f"{rule}_*.tsv", f"{rule}/**/*.tsv")
        for path in Path(folder, "benchmarks").glob(pattern)
    ]
    times = []
    for path in paths:
        with open(path, newline="") as file:
            rows = csv.DictReader(file, delimiter="\t")
            times += [float(row["cpu_time"]) for row in rows if row["cpu_time"] != "NA"]
    return times


def main() -> None:
    """Write the table again, with the costs of the run in the given folders."""
    stages = read_stages()
    with open(TABLE, "w", newline="") as file:
        writer = csv.writer(file, delimiter="\t", lineterminator="\n")
        writer.writerow(("rule", "seconds", "name"))
        for rule, stage in stages.items():
            times = measured_seconds(rule, sys.argv[1:])
            writer.writerow((rule, f"{mean(times) if times else stage.seconds:.2g}", stage.name))


if __name__ == "__main__":
    main()
