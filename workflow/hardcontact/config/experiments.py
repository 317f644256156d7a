"""The table of published experiments, with priors of what they do not state, and its faults."""

import math
from functools import partial

import pandas as pd

from hardcontact.claims.verdicts import accepted_range
from hardcontact.config.schema import Schema, plain, refuse, refuse_lines
from hardcontact.config.tables import Row, found, number, user_table
from hardcontact.insight.experiments import UNKNOWN, Cell, Experiment

EXPERIMENTS, PRIORS = "resources/experiments.csv", "resources/priors.csv"
EXPERIMENTS_SCHEMA = "workflow/schemas/experiments.schema.yaml"
NUMBERS = ("measured", "low", "high")


def experiments(path: str, priors: str, schema: Schema) -> list[Experiment]:
    """Return the published experiments of a table, whose columns are those of the schema of a row.

    Unknown cells have the ends of their prior, NaN without one. A fault is a line of a ValueError,
    all of them at once.
    """
    table = user_table(path, "a table of experiments (resources/README.md)")
    columns = list(schema["properties"])
    if table.header != columns or not table.cells:
        raise ValueError(
            f"{path}: expected the columns {', '.join(columns)} and a row an experiment; "
            f"found {plain(', '.join(table.header))} and {len(table.cells)} rows"
        )
    problems = table.problems(partial(_faults, schema=schema))
    rows = table.rows()
    ids = pd.Series({line: row["id"] for line, row in rows.items()})
    problems += [
        f"{path}: line {line}: id: expected each once, found again {found(name)}"
        for line, name in ids[ids.duplicated()].items()
    ]
    refuse_lines(problems)
    known = pd.read_csv(priors, index_col="quantity")[["low", "high"]]
    unknown = {str(name): Cell(UNKNOWN, *ends) for name, *ends in known.itertuples()}
    return [_experiment(row, unknown, schema) for row in rows.values()]


def _cells(row: Row, schema: Schema) -> dict[str, Cell]:
    """Return the cells, as ``"stated 1.5"``, ``"assumed 500..2500"`` or UNKNOWN, by column."""
    cells = {}
    for name, part in schema["properties"].items():
        if part.get("$ref") == "#/$defs/cell":
            basis, _, numbers = row[name].partition(" ")
            low, _, high = numbers.partition("..")
            cells[name] = Cell(basis, number(low), number(high or low))
    return cells


def _faults(row: Row, schema: Schema) -> list[str]:
    """Return what is wrong with the cells of a row, by column."""
    try:
        refuse(row, schema, "")
    except ValueError as error:
        return str(error).splitlines()
    cells, faults = _cells(row, schema), []
    for name, cell in cells.items():
        least, most = schema["properties"][name]["within"]
        if cell.basis != UNKNOWN and not least <= cell.low <= cell.high <= most:
            faults.append(
                f"{name}: expected a number between {least:g} and {most:g}, or two that ascend, "
                f"found {found(row[name])}"
            )
    smoother, rougher = cells["rms_height_nm"], cells["rougher_rms_height_nm"]
    if rougher.high < smoother.low:
        faults.append(
            f"rougher_rms_height_nm: expected at least rms_height_nm, "
            f"{found(row['rms_height_nm'])}, found {found(row['rougher_rms_height_nm'])}"
        )
    measured, low, high = (number(row[name]) for name in NUMBERS)
    try:
        least, most = (
            accepted_range(row["rule"], low, high) if row["rule"] else (math.nan, math.nan)
        )
    except ValueError as error:
        return [*faults, f"rule: expected the limits that it needs, found none: {error}"]
    if (row["rule"] or row["measured"]) and not least <= measured <= most:
        faults.append(
            f"measured: expected a number that its rule accepts, or neither, found "
            f"{found(row['measured'])} with the rule {found(row['rule'])}"
        )
    return faults


def _experiment(row: Row, unknown: dict[str, Cell], schema: Schema) -> Experiment:
    words = {name: row[name] for name in Experiment._fields if name in row}
    numbers = {name: number(row[name]) for name in NUMBERS}
    cells = {
        name: unknown.get(name, cell) if cell.basis == UNKNOWN else cell
        for name, cell in _cells(row, schema).items()
    }
    return Experiment(**{**words, **numbers, "cells": cells})  # type: ignore[arg-type]
