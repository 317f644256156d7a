"""Numbers of the page on forces that others measured."""

from typing import Any

import numpy as np
import xarray as xr

from hardcontact.answer.facts import Cells, count, ends, number_of, percent
from hardcontact.claims.weighed_experiments import LEAST_TRIED, NOT_TESTABLE, NOT_TRIED
from hardcontact.insight.experiments import DISTANCE
from hardcontact.numbers.number import Number

WORDS = ("label", "materials", "contact", "statement", "verdict", "height_basis",
         "decided_by", "missing")  # fmt: skip


def ledger_facts(ledger: xr.Dataset) -> dict[str, Any]:
    """Return every experiment that is tested, with its verdict, and what the others lack.

    The verdicts are counted of hard contacts and of negative controls for which the law was tried.
    """
    rows = [_row(ledger.sel(experiment=name)) for name in ledger["experiment"].values]
    tested = [row for row in rows if row["verdict"] != NOT_TESTABLE]
    decided = [row for row in tested if row["verdict"] != NOT_TRIED]
    hard = [row for row in decided if row["contact"] == "hard"]
    controls = [row for row in decided if row["contact"] != "hard"]
    return {
        "rows": tested,
        "others": [row for row in rows if row["verdict"] == NOT_TESTABLE],
        "hard": count(tested, "contact", "hard"),
        "tried": len(hard),
        "least_tried": percent(Number("tried", LEAST_TRIED)),
        "agree": count(hard, "verdict", "reproduced", "consistent"),
        "undecided": count(hard, "verdict", "undecided"),
        "contradicted": [row for row in hard if row["verdict"] == "not reproduced"],
        "controls": len(controls),
        "failed": count(controls, "verdict", "not reproduced"),
        "draws": ledger.attrs["draws"],
    }


def _row(one: xr.Dataset) -> Cells:
    """Return a measured number, what agrees with it, the law's interval and the verdict."""
    unit = "nm" if one["statement"] == DISTANCE else "1"
    accepted = ends(one, "accepted")
    bound = {(True, False): "more_than", (False, True): "at_most"}.get(tuple(np.isfinite(accepted)))
    return {name: str(one[name].item()) for name in WORDS} | {
        "measured": Number("measured", one["measured"].item(), unit, *accepted, bound or ""),
        "predicted": number_of(one, "predicted", unit, strict=False),
        "tried": percent(number_of(one, "tried")),
        "agreement": percent(number_of(one, "agreement")),
    }
