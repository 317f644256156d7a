"""Conclusions from the claims and numbers of the paper's study, which templates put into words."""

from collections.abc import Mapping
from typing import Any

import numpy as np
import pandas as pd

from hardcontact.base.formatting import format_as_paper, is_unbounded
from hardcontact.base.number import Number, NumberStatus
from hardcontact.paper.claims.selection import LARGER_PIXELS, WITHOUT_SCAN
from hardcontact.paper.claims.verdicts import (
    BY_CONSTRUCTION,
    NOT_REPRODUCED,
    ONE_SIDED,
    REPRODUCED,
    REPRODUCED_SHARE,
    count_verdicts,
)
from hardcontact.report.paper_study.table1 import decimals_of
from hardcontact.report.quantities import NO_INTERVAL_WORDS


def claim_facts(claims: pd.DataFrame) -> dict[str, Any]:
    """Return the facts about claims that templates show, by the names that templates use."""
    # Templates test for None, because a comparison with NaN is always false.
    plain_rows = claims.astype(object).where(claims.notna(), None).to_dict("records")
    rows = zip(plain_rows, claims.to_dict("records"), strict=True)
    facts: dict[str, Any] = {
        str(row["id"]): plain | _printed_claim(row) | {"position": position}
        for position, (plain, row) in enumerate(rows, start=1)
    }
    ranks = {name: int(row["main"]) for name, row in facts.items() if row["main"]}
    independent = [row for row in facts.values() if row["kind"] == "independent"]
    # Main statements first.
    ordered = sorted(independent, key=lambda row: row["main"] == "")
    main_rules = {facts[name]["rule"] for name in ranks}
    return {
        # Rows by id, and the ids of main statements, the first in rank first.
        "claims": facts,
        "main_statements": sorted(ranks, key=lambda name: ranks[name]),
        # Factors within which numbers of main statements agree.
        "accepted_factors": sorted(
            rule.removeprefix("factor ") for rule in main_rules if rule.startswith("factor ")
        ),
        # Rows of independent statements, main statements first.
        "contradicted": [row for row in ordered if row["verdict"] == NOT_REPRODUCED],
        "counts": count_verdicts(claims).to_dict("records"),
        "decisive_share": REPRODUCED_SHARE,
        # Number of statements that are reproduced without any scan.
        "without_scan": sum(
            row["basis"] in WITHOUT_SCAN for row in independent if row["verdict"] == REPRODUCED
        ),
        # Number of statements that only the paper's pixels can test.
        "larger_pixels": sum(LARGER_PIXELS in (row["note"] or "") for row in independent),
    }


def _printed_claim(row: Mapping[Any, Any]) -> dict[str, Any]:
    """Return the numbers of a claim as printed, and its kind."""
    unit = row["unit"]
    # The accepted range shows a limit.
    published = "" if row["rule"] in ONE_SIDED else format_as_paper(row["published"], unit)
    interval = (row["low"], row["high"])
    kind = "follows" if row["follows_from"] else "independent"
    # Where no sets decide, the ends show on which side of each limit they lie.
    limits = () if row["agreeing_share"] >= 0 else (row["accepted_low"], row["accepted_high"])
    computed_text = format_as_paper(row["computed"], unit)
    if is_unbounded(row["computed"], *interval, unit):
        computed_text += f" ({NO_INTERVAL_WORDS[NumberStatus.NO_INTERVAL]})"
    elif row["low"] != row["high"]:
        bounds = {"open_end": row["open_end"], "limits": limits}
        computed_text = format_as_paper(row["computed"], unit, interval, **bounds)
    return {
        "published_text": published or "as stated",
        "accepted_text": _print_accepted_range(row["accepted_low"], row["accepted_high"], unit),
        "computed_text": computed_text,
        "kind": BY_CONSTRUCTION if row["verdict"] == BY_CONSTRUCTION else kind,
    }


def _print_accepted_range(low: float, high: float, unit: str) -> str:
    """Return the range of numbers that agree with a statement, in words."""
    if np.isinf(low):
        return f"below {format_as_paper(high, unit)}"
    if np.isinf(high):
        return f"above {format_as_paper(low, unit)}"
    low_text, _, low_unit = format_as_paper(low, unit).partition(" ")
    high_text, _, high_unit = format_as_paper(high, unit).partition(" ")
    if low_unit != high_unit:
        return f"{low_text} {low_unit} to {high_text} {high_unit}"
    # Equally many decimals: at most those that the upper end has with three digits.
    printed = max(len(text.partition(".")[2]) for text in (low_text, high_text))
    decimals = min(printed, decimals_of(float(high_text), 0.0))
    return f"{float(low_text):.{decimals}f} to {float(high_text):.{decimals}f} {high_unit}".rstrip()


def most_sensitive_coatings(coatings: Mapping[str, Mapping[str, Number]]) -> dict[str, str]:
    """Return the label of the coating whose force changes first, by edge; coatings are by label."""
    return {
        "short_edge": min(coatings, key=lambda label: coatings[label]["short_edge"].value),
        "long_edge": max(coatings, key=lambda label: coatings[label]["long_edge"].value),
    }


def features_by_scatter(numbers: Mapping[str, Number]) -> str:
    """Return which features scatter ln F more like the published forces: "bumps" or "pits"."""
    bumps = numbers["bumps_log_force_std"].value
    pits = numbers["pits_log_force_std"].value
    published = numbers["featured_log_force_std_published"].value
    return "bumps" if abs(bumps - published) < abs(pits - published) else "pits"
