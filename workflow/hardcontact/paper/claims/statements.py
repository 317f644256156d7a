"""The statements of the paper, resources/paper/claims.csv: reading, and checks before a run."""

import csv
import math
import re
from collections.abc import Iterator
from functools import cache
from itertools import chain
from pathlib import Path
from typing import Any

import pandas as pd

from hardcontact.base.dataset import MEANINGS, read_meanings
from hardcontact.config.faults import quote_key, raise_faults, spelling_question
from hardcontact.config.tables import Row, parse_number, user_table
from hardcontact.paper.claims.judgement import DERIVED_QUANTITIES
from hardcontact.paper.claims.selection import LABELS, WITHOUT_SCAN, split_selection
from hardcontact.paper.claims.verdicts import accepted_range
from hardcontact.surfaces.metrics import TABLE1_VARIABLES

#: Datasets that each set of sets.nc has.
SET_DATASETS = ("topography", "adhesion", "fit", "edges")
#: Columns with numbers.
NUMBER_COLUMNS = ("published", "published_low", "published_high")
#: The words that each column may have; an empty tuple permits any text.
PERMITTED_WORDS: dict[str, tuple[str, ...]] = {
    "id": (), "main": (), "section": (), "statement": (), "number": (), "unit": (), "rule": (),
    **dict.fromkeys(NUMBER_COLUMNS, ()),
    "evidence": ("published", "inferred", "assumed"),
    "dataset": (), "quantity": (), "select": (),
    "needs": ("", "measured", *WITHOUT_SCAN, "construction", "experiment"),
    "follows_from": (),
    "samples_from": ("", "sets", "posterior"),
    "note": (),
}  # fmt: skip
#: The form of a cell, and how a message describes it.
FORMS = {
    "id": (re.compile("[a-z0-9_]+"), "a name"),
    "main": (re.compile("([1-9][0-9]*)?"), "the rank of a main statement or nothing"),
    "number": (re.compile(".*\\w.*"), "words for the quantity that the numbers give"),
    "select": (
        re.compile("(\\w+=[^;=]+(;\\w+=[^;=]+)*)?"), "labels such as surface=uncd;side=short"
    ),
}  # fmt: skip


def read_claims(path: str | Path) -> pd.DataFrame:
    """Read the claims of the paper, one row each; published numbers are floats, NaN if blank."""
    table = pd.read_csv(path, dtype=str, keep_default_na=False)
    return table.assign(**{name: pd.to_numeric(table[name]) for name in NUMBER_COLUMNS})


def claims_of_sets(path: str | Path) -> list[dict[Any, Any]]:
    """Return the columns that determine the values of the claims that sets.nc has."""
    table = read_claims(path)
    columns = ["id", "dataset", "quantity", "select", "rule"]
    return table.loc[table["samples_from"] == "sets", columns].to_dict("records")


def datasets_of_claims(path: str | Path) -> list[str]:
    """Return the names of the datasets that claims need, in alphabetical order."""
    names = read_claims(path)["dataset"].str.split("+").explode()
    return sorted({*names} - {"paper"})


def check_claims(path: str | Path) -> None:
    """Check a table of statements."""
    content = f"a table with the columns {', '.join(PERMITTED_WORDS)} (resources/paper/README.md)"
    table = user_table(path, content)
    table.require([*PERMITTED_WORDS], content, PERMITTED_WORDS)
    rows = table.convert(_checked_claim)
    all_ids = {row["id"] for row in rows.values()}
    earlier_ids = set[str]()
    faults = []
    for line, row in rows.items():
        if row["id"] in earlier_ids:
            faults.append(f"{path}: line {line}: id: expected each once, found {row['id']} again")
        if row["follows_from"] and row["follows_from"] not in all_ids:
            unknown_id = quote_key(row["follows_from"])
            faults.append(f"{path}: line {line}: follows_from: expected an id, found {unknown_id}")
        earlier_ids.add(row["id"])
    raise_faults(faults)


def _checked_claim(row: Row) -> Row:
    """Return a row; raise ValueError with a line for each faulty cell."""
    raise_faults(_cell_faults(row))
    return row


def _cell_faults(row: Row) -> Iterator[str]:
    """Yield the fault of each faulty cell of a row, as expected and found."""
    for name, (form, description) in FORMS.items():
        if not form.fullmatch(row[name]):
            yield f"{name}: expected {description}, found {quote_key(row[name])}"
    variables = read_meanings(row["dataset"].partition("+")[0])
    if row["quantity"] not in {*DERIVED_QUANTITIES, *TABLE1_VARIABLES, *variables}:
        files = "workflow/hardcontact/paper/claims or a variable of workflow/report/variables.tsv"
        yield f"quantity: expected a function of {files}, found {quote_key(row['quantity'])}"
    for name, words in PERMITTED_WORDS.items():
        if words and row[name] not in words:
            permitted = "one of " + ", ".join(word or "nothing" for word in words)
            yield f"{name}: expected {permitted}, found {quote_key(row[name])}"
    yield from _dataset_faults(row)
    if FORMS["select"][0].fullmatch(row["select"]):
        yield from _selection_faults(row["select"])
    for name in NUMBER_COLUMNS:
        if row[name] and not abs(parse_number(row[name])) >= 0:
            yield f"{name}: expected a number, found {quote_key(row[name])}"
    try:
        accepted_range(row["rule"], *(parse_number(row[name]) for name in NUMBER_COLUMNS[1:]))
    except ValueError as error:
        yield str(error)


def _dataset_faults(row: Row) -> Iterator[str]:
    """Yield the fault of an unknown dataset, or of one without samples."""
    datasets = set(row["dataset"].split("+"))
    sampled_datasets = {"sets": {*SET_DATASETS, "paper"}, "posterior": {"posterior"}}
    if unknown := sorted(datasets - _known_datasets()):
        question = spelling_question(unknown[0], _known_datasets())
        permitted = "datasets of workflow/report/variables.tsv, with + between"
        yield f"dataset: expected {permitted}, found {quote_key(unknown[0])}{question}"
    elif not datasets <= sampled_datasets.get(row["samples_from"], datasets):
        samples = [name for name, names in sampled_datasets.items() if datasets <= names]
        permitted = f"{' or '.join(['nothing', *samples])} for the dataset {row['dataset']}"
        yield f"samples_from: expected {permitted}, found {quote_key(row['samples_from'])}"


@cache
def _known_datasets() -> set[str]:
    """Return the names of the datasets that a claim may name; edges.nc has no own variables."""
    table = pd.read_csv(MEANINGS, sep="\t", usecols=["dataset"], quoting=csv.QUOTE_NONE)
    return {*table["dataset"], "edges", "paper"} - {"*"}


def _selection_faults(select: str) -> Iterator[str]:
    """Yield a fault of each dimension and label that no study has."""
    for dimension, groups in split_selection(select).items():
        if dimension not in LABELS:
            question = spelling_question(dimension, LABELS)
            yield f"select: expected one of {', '.join(LABELS)}, found {dimension}{question}"
            continue
        labels = LABELS[dimension]
        for label in chain.from_iterable(groups):
            if not labels and math.isnan(parse_number(label)):
                yield f"select: expected {dimension} as a number, found {quote_key(label)}"
            elif labels and label not in labels:
                permitted = f"{dimension}, one of {', '.join(labels)}"
                question = spelling_question(label, labels)
                yield f"select: expected {permitted}, found {quote_key(label)}{question}"
