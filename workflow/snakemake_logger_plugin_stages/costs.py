"""The table costs.tsv: the cost of a job of each rule, and the name of its stage in the terminal.

`python tests/benchmarks/stage_costs.py` renews the costs.
"""

import csv
import re
from pathlib import Path
from statistics import median
from typing import NamedTuple

TABLE = Path(__file__).with_name("costs.tsv")


class Stage(NamedTuple):
    """Processor time of a job in s, and the name that the terminal shows."""

    seconds: float
    name: str


def read_stages(column: str) -> dict[str, Stage]:
    """Return the stage of each rule, with its cost in a "quick", "own" or "full" study."""
    with open(TABLE, newline="") as file:
        rows = csv.DictReader(file, delimiter="\t")
        return {row["rule"]: Stage(float(row[column]), row["name"]) for row in rows}


def name_in_table(rule: str, stages: dict[str, Stage]) -> str:
    """Return the longest name in the table with which a rule begins, or an empty text."""
    names = [name for name in stages if f"{rule}_".startswith(f"{name}_")]
    return max(names, key=len, default="")


def stage_of(rule: str, stages: dict[str, Stage]) -> Stage:
    """Return the stage of a rule; rules from a loop share the row of their common name.

    A rule that is not in the table has the median cost and its own name.
    """
    name = name_in_table(rule, stages)
    if not name:
        seconds = median(stage.seconds for stage in stages.values())
        return Stage(seconds, rule.replace("_", " "))
    name_end = rule.removeprefix(name).removeprefix("_")  # a figure, or the numbers of scans
    name_end = re.sub(r"^(\d+)_(?:\d+_)*(\d+)$", r"\1 to \2", name_end)
    return Stage(stages[name].seconds, f"{stages[name].name} {name_end}".strip())
