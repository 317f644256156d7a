"""Check the statements of the paper, resources/paper/claims.csv, before a job removes verdicts."""

import re
from collections.abc import Iterator
from pathlib import Path

from hardcontact.base.dataset import read_meanings
from hardcontact.config.faults import quote_key, raise_faults
from hardcontact.config.tables import Row, parse_number, user_table
from hardcontact.paper.claim_selection import WITHOUT_SCAN
from hardcontact.paper.evaluation import CLAIM_DATASETS, DERIVED_QUANTITIES, NUMBER_COLUMNS
from hardcontact.paper.verdicts import accepted_range
from hardcontact.surfaces.metrics import TABLE1_VARIABLES

#: Columns, and the words that each may have; an empty tuple permits any text.
COLUMNS: dict[str, tuple[str, ...]] = {
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


def refuse_claims(path: str | Path) -> None:
    """Refuse a faulty table of statements; raise ValueError with a line for each fault."""
    content = f"a table with the columns {', '.join(COLUMNS)} (workflow/README.md)"
    table = user_table(path, content)
    table.require([*COLUMNS], content, COLUMNS)
    names = set[str]()
    rows = table.convert(_checked_claim)
    origins = {row["id"] for row in rows.values()}
    faults = []
    for line, row in rows.items():
        if row["id"] in names:
            faults.append(f"{path}: line {line}: id: expected each once, found {row['id']} again")
        if row["follows_from"] and row["follows_from"] not in origins:
            origin = quote_key(row["follows_from"])
            faults.append(f"{path}: line {line}: follows_from: expected an id, found {origin}")
        names.add(row["id"])
    raise_faults(faults)


def _checked_claim(row: Row) -> Row:
    """Return a row; raise ValueError with a line for each faulty cell."""
    raise_faults(_cell_faults(row))
    return row


def _cell_faults(row: Row) -> Iterator[str]:
    """Yield the fault of each faulty cell of a row, as expected and found."""
    for name, (form, accepted) in FORMS.items():
        if not form.fullmatch(row[name]):
            yield f"{name}: expected {accepted}, found {quote_key(row[name])}"
    variables = read_meanings(row["dataset"].partition("+")[0])
    if row["quantity"] not in {*DERIVED_QUANTITIES, *TABLE1_VARIABLES, *variables}:
        files = "workflow/hardcontact/paper or a variable of workflow/report/variables.tsv"
        yield f"quantity: expected a function of {files}, found {quote_key(row['quantity'])}"
    for name, words in COLUMNS.items():
        if words and row[name] not in words:
            yield f"{name}: expected {_join_words(words)}, found {quote_key(row[name])}"
    if not set(row["dataset"].split("+")) <= {*CLAIM_DATASETS, "paper"}:
        datasets = _join_words((*CLAIM_DATASETS, "paper"))
        yield f"dataset: expected {datasets}, with + between, found {quote_key(row['dataset'])}"
    for name in NUMBER_COLUMNS:
        if row[name] and not abs(parse_number(row[name])) >= 0:
            yield f"{name}: expected a number, found {quote_key(row[name])}"
    try:
        accepted_range(row["rule"], *(parse_number(row[name]) for name in NUMBER_COLUMNS[1:]))
    except ValueError as error:
        yield f"rule: expected interval, factor 2, below, above or order, found: {error}"


def _join_words(words: tuple[str, ...]) -> str:
    """Return words as a choice, in which nothing is named."""
    return "one of " + ", ".join(word or "nothing" for word in words)
