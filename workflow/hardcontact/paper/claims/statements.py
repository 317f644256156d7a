"""The statements of the paper, resources/paper/claims.csv: reading, and checks before a run."""

import csv
import math
from collections.abc import Collection, Iterable, Iterator
from functools import cache
from itertools import chain
from pathlib import Path
from typing import Annotated, Any, Literal

import pandas as pd
from pydantic import model_validator

from hardcontact.base.dataset import MEANINGS, read_meanings
from hardcontact.config.faults import quote_key, raise_faults, spelling_question
from hardcontact.config.key_types import Matching
from hardcontact.config.keys import Keys
from hardcontact.config.user_files import NumberCell, parse_number, read_rows
from hardcontact.paper.claims.judgement import DERIVED_QUANTITIES
from hardcontact.paper.claims.selection import LABELS, split_selection
from hardcontact.paper.claims.verdicts import accepted_numbers
from hardcontact.surfaces.metrics import TABLE1_VARIABLES

#: Datasets of the claims that may have samples, by the source of the samples (`samples_from`).
SAMPLED_DATASETS = {
    "sets": {"topography", "adhesion", "fit", "edges", "paper"}, "posterior": {"posterior"},
}  # fmt: skip


class ClaimRow(Keys):
    """A row of the table of statements, as it is checked before a run.

    A run then uses the row as a `selection.Claim`.
    """

    id: Annotated[str, Matching("[a-z0-9_]+", "a name")]
    main: Annotated[str, Matching("([1-9][0-9]*)?", "the rank of a main statement or nothing")]
    section: str
    statement: str
    number: Annotated[str, Matching(r".*\w.*", "words for the quantity that the numbers give")]
    published: NumberCell
    published_low: NumberCell
    published_high: NumberCell
    unit: str
    rule: str
    evidence: Literal["published", "inferred", "assumed"]
    dataset: str
    quantity: str
    select: Annotated[
        str, Matching(r"(\w+=[^;=]+(;\w+=[^;=]+)*)?", "labels such as surface=uncd;side=short")
    ]
    needs: Literal[
        "", "measured", "no scan", "no scan; assumed asperities", "construction", "experiment"
    ]
    follows_from: str
    samples_from: Literal["", "sets", "posterior"]
    note: str

    @model_validator(mode="after")
    def _check_rules_across_columns(self) -> "ClaimRow":
        raise_faults([*self._quantity_faults(), *self._selection_faults()])
        # Raises ValueError for an unknown rule, or a missing limit.
        accepted_numbers(self.rule, self.published_low, self.published_high)
        return self

    def _quantity_faults(self) -> list[str]:
        """Return the faults of the datasets, or else of the quantity and of its samples."""
        datasets = self.dataset.split("+")
        accepted_datasets = "datasets of workflow/report/variables.tsv, with + between"
        if faults := [*_word_faults("dataset", datasets, _known_datasets(), accepted_datasets)]:
            return faults
        quantities = {*DERIVED_QUANTITIES, *TABLE1_VARIABLES, *read_meanings(datasets[0])}
        folder = "workflow/hardcontact/paper/claims"
        accepted_quantity = f"a function of {folder} or a variable of workflow/report/variables.tsv"
        sources = [name for name, names in SAMPLED_DATASETS.items() if names >= {*datasets}]
        accepted_sources = f"{' or '.join(['nothing', *sources])} for the dataset {self.dataset}"
        return [
            *_word_faults("quantity", [self.quantity], quantities, accepted_quantity),
            *_word_faults("samples_from", [self.samples_from], ["", *sources], accepted_sources),
        ]

    def _selection_faults(self) -> Iterator[str]:
        """Yield a fault of each dimension and label that no study has."""
        for dimension, groups in split_selection(self.select).items():
            labels = [*chain.from_iterable(groups)]
            known_labels = LABELS.get(dimension)
            if known_labels is None:
                accepted = f"one of {', '.join(LABELS)}"
                yield from _word_faults("select", [dimension], LABELS, accepted)
            elif known_labels:
                accepted = f"{dimension}, one of {', '.join(known_labels)}"
                yield from _word_faults("select", labels, known_labels, accepted)
            else:
                numbers = [label for label in labels if not math.isnan(parse_number(label))]
                yield from _word_faults("select", labels, numbers, f"{dimension} as a number")


def _word_faults(
    column: str, words: Iterable[str], known_words: Collection[str], accepted: str
) -> Iterator[str]:
    """Yield a line for each word that is not known, with the known word that it resembles."""
    for word in words:
        if word not in known_words:
            question = spelling_question(word, known_words)
            yield f"{column}: expected {accepted}, found {quote_key(word)}{question}"


@cache
def _known_datasets() -> set[str]:
    """Return the names of the datasets that a claim may name."""
    table = pd.read_csv(MEANINGS, sep="\t", usecols=["dataset"], quoting=csv.QUOTE_NONE)
    # All variables of edges.nc stand under `*`, variables of several datasets.
    return {*table["dataset"], "edges", "paper"} - {"*"}


def check_claims(path: str | Path) -> None:
    """Raise ValueError with the faults of a table of statements, a line each."""
    content = "a table with the columns {} (resources/paper/README.md)"
    rows = read_rows(path, ClaimRow, content)
    all_ids = [row.id for row in rows.values()]
    faults = []
    for index, (line, row) in enumerate(rows.items()):
        if row.id in all_ids[:index]:
            faults.append(f"{path}: line {line}: id: expected each once, found {row.id} again")
        faults += [
            f"{path}: line {line}: {fault}"
            for fault in _word_faults("follows_from", [row.follows_from], ["", *all_ids], "an id")
        ]
    raise_faults(faults)


def read_claims(path: str | Path) -> pd.DataFrame:
    """Read the claims of the paper, one row each; published numbers are floats, NaN if blank."""
    table = pd.read_csv(path, dtype=str, keep_default_na=False)
    numbers = ("published", "published_low", "published_high")
    return table.assign(**{name: pd.to_numeric(table[name]) for name in numbers})


def claims_of_sets(path: str | Path) -> list[dict[Any, Any]]:
    """Return, for each value of sets.nc, the columns of its claim that determine it."""
    table = read_claims(path)
    columns = ["id", "dataset", "quantity", "select", "rule"]
    return table.loc[table["samples_from"] == "sets", columns].to_dict("records")


def datasets_of_claims(path: str | Path) -> list[str]:
    """Return the sorted names of the datasets other than `paper` that claims need."""
    names = read_claims(path)["dataset"].str.split("+").explode()
    return sorted({*names} - {"paper"})
