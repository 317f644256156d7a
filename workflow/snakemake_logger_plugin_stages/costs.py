"""The table costs.tsv: the cost of a job of each rule, and the name of its stage in the terminal.

After a quick and a full study, this renews the costs from their benchmarks:
``python workflow/snakemake_logger_plugin_stages/costs.py quick results/quick results/store-quick``
``python workflow/snakemake_logger_plugin_stages/costs.py full results/paper results/store``
"""

import csv
import re
import sys
from collections import defaultdict
from pathlib import Path
from statistics import mean, median
from typing import NamedTuple

TABLE = Path(__file__).with_name("costs.tsv")


class Stage(NamedTuple):
    """Processor time of a job in s, and the name that the terminal shows."""

    seconds: float
    name: str


def read_stages(effort: str) -> dict[str, Stage]:
    """Return the stage of each rule, with its cost in a "quick" or a "full" study."""
    return {row["rule"]: Stage(float(row[effort]), row["name"]) for row in _read_rows()}


def _read_rows() -> list[dict[str, str]]:
    """Return the rows of the table."""
    with open(TABLE, newline="") as file:
        return list(csv.DictReader(file, delimiter="\t"))


def _name_in_table(rule: str, stages: dict[str, Stage]) -> str:
    """Return the longest name in the table with which a rule begins, or an empty text."""
    names = [name for name in stages if f"{rule}_".startswith(f"{name}_")]
    return max(names, key=len, default="")


def stage_of(rule: str, stages: dict[str, Stage]) -> Stage:
    """Return the stage of a rule; rules from a loop share the stage of their common name.

    A rule that is not in the table has the median cost and its own name.
    """
    name = _name_in_table(rule, stages)
    if not name:
        seconds = median(stage.seconds for stage in stages.values())
        return Stage(seconds, rule.replace("_", " "))
    name_end = rule.removeprefix(name).removeprefix("_")  # a figure, or the numbers of scans
    if re.fullmatch(r"\d+(_\d+)+", name_end):
        first_scan, *_, last_scan = name_end.split("_")
        name_end = f"{first_scan} to {last_scan}"
    return Stage(stages[name].seconds, f"{stages[name].name} {name_end}".strip())


def main() -> None:
    """Write the table again, with the mean costs of the benchmarks of a study of this effort."""
    effort, *folders = sys.argv[1:]
    stages = read_stages(effort)
    times = defaultdict[str, list[float]](list)
    for benchmarks in (Path(folder, "benchmarks") for folder in folders):
        for path in benchmarks.rglob("*.tsv"):
            rule = path.relative_to(benchmarks).parts[0].removesuffix(".tsv")
            with open(path, newline="") as file:
                (row,) = csv.DictReader(file, delimiter="\t")
            if row["cpu_time"] != "NA":
                times[_name_in_table(rule, stages)].append(float(row["cpu_time"]))
    rows = _read_rows()
    for row in rows:
        if row["rule"] in times:
            row[effort] = f"{mean(times[row['rule']]):.2g}"
    with open(TABLE, "w", newline="") as file:
        writer = csv.DictWriter(file, list(rows[0]), delimiter="\t", lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


if __name__ == "__main__":
    main()
