"""Numbers of the page on forces that others measured."""

from typing import Any

import numpy as np
import xarray as xr

from hardcontact.answer.facts import Cells, count, ends, number_of, percent
from hardcontact.claims.weighed_experiments import NOT_TESTABLE
from hardcontact.insight.experiments import DISTANCE
from hardcontact.numbers.number import Number

#: Least share of the draws in which the error of the law is known that a verdict rests on.
LEAST_TRIED = 0.05
#: Contacts that the law is for.
HARD = "hard"


def ledger_facts(ledger: xr.Dataset) -> dict[str, Any]:
    """Return every experiment that is tested, with its verdict, and what the others lack.

    Of hard contacts and of negative controls the verdicts are counted.
    """
    tested = ledger["verdict"] != NOT_TESTABLE
    rows = [_row(one) for one in _each(ledger.sel(experiment=tested))]
    others = [_about(one) for one in _each(ledger.sel(experiment=~tested))]
    hard = [row for row in rows if row["contact"] == HARD]
    controls = [row for row in rows if row["contact"] != HARD]
    return {
        "rows": rows,
        "others": others,
        "hard": len(hard),
        "agree": count(hard, "verdict", "reproduced", "consistent"),
        "undecided": count(hard, "verdict", "undecided"),
        "contradicted": [row for row in hard if row["verdict"] == "not reproduced"],
        "controls": len(controls),
        "failed": count(controls, "verdict", "not reproduced"),
        "draws": ledger.attrs["draws"],
    }


def _each(ledger: xr.Dataset) -> list[xr.Dataset]:
    return [ledger.sel(experiment=name) for name in ledger["experiment"].values]


def _about(one: xr.Dataset) -> Cells:
    names = ("label", "materials", "contact", "statement", "height_basis", "missing")
    return {name: str(one[name].item()) for name in names}


def _row(one: xr.Dataset) -> Cells:
    """Return a measured number, what agrees with it, the law's interval and the verdict."""
    unit = "nm" if one["statement"] == DISTANCE else "1"
    accepted = ends(one, "accepted")
    code = {(True, False): "more_than", (False, True): "at_most"}.get(tuple(np.isfinite(accepted)))
    measured = Number("measured", one["measured"].item(), unit, *accepted, code or "")
    few = one["tried"].item() < LEAST_TRIED
    return _about(one) | {
        "measured": measured,
        "predicted": number_of(one, "predicted", unit, strict=False),
        "verdict": str(one["verdict"].item()),
        "tried": percent(number_of(one, "tried")),
        "says": "few" if few else "",
        "agreement": percent(number_of(one, "agreement")),
        "decided_by": str(one["decided_by"].item()),
    }
