"""The tables of the paper's study as printed: statements with their verdicts, and Table 1."""

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr
import yaml

from hardcontact.base.formatting import format_as_paper, is_unbounded
from hardcontact.base.number import NumberStatus
from hardcontact.paper.claims.selection import LARGER_PIXELS, WITHOUT_SCAN
from hardcontact.paper.claims.verdicts import (
    BY_CONSTRUCTION,
    NOT_REPRODUCED,
    ONE_SIDED,
    REPRODUCED,
    REPRODUCED_SHARE,
    count_verdicts,
    sets_needed,
)
from hardcontact.report import TEXTS
from hardcontact.report.quantities import NO_INTERVAL_WORDS
from hardcontact.surfaces.metrics import TABLE1_VARIABLES


def claim_facts(claims: pd.DataFrame, set_count: int, confidence: float) -> dict[str, Any]:
    """Return the facts about claims that templates show, by the names that templates use."""
    rows: dict[str, Any] = {}
    for position, row in enumerate(claims.to_dict("records"), start=1):
        # Templates test for None, because a comparison with NaN is always false.
        plain = {name: None if pd.isna(value) else value for name, value in row.items()}
        rows[row["id"]] = plain | _printed_claim(row) | {"position": position}
    main_rows = [row for row in rows.values() if row["main"]]
    main_rows.sort(key=lambda row: int(row["main"]))
    independent = [row for row in rows.values() if row["kind"] == "independent"]
    main_first = sorted(independent, key=lambda row: row["main"] == "")
    return {
        # Rows by id, and the ids of main statements, the first in rank first.
        "claims": rows,
        "main_statements": [row["id"] for row in main_rows],
        # Factors within which numbers of main statements agree, as texts.
        "accepted_factors": sorted(
            {row["rule"].split()[1] for row in main_rows if row["rule"].startswith("factor ")}
        ),
        # Independent statements that are not reproduced, main ones first.
        "contradicted": [row for row in main_first if row["verdict"] == NOT_REPRODUCED],
        "counts": count_verdicts(claims).to_dict("records"),
        "decisive_share": REPRODUCED_SHARE,
        "set_count": set_count,
        # Number of sets that must agree, or disagree, for a verdict.
        "sets_needed": sets_needed(set_count, confidence),
        # Number of independent statements that are reproduced without any scan.
        "without_scan": sum(
            row["basis"] in WITHOUT_SCAN for row in independent if row["verdict"] == REPRODUCED
        ),
        # Number of independent statements that only the paper's pixels can test.
        "larger_pixels": sum(LARGER_PIXELS in row["note"] for row in independent),
    }


def _printed_claim(row: Mapping[Any, Any]) -> dict[str, Any]:
    """Return the numbers of a claim as printed, and its kind."""
    unit = row["unit"]
    # A one-sided rule has a published limit, which the accepted numbers show.
    published = "" if row["rule"] in ONE_SIDED else format_as_paper(row["published"], unit)
    interval = (row["low"], row["high"])
    kind = "follows" if row["follows_from"] else "independent"
    # Without sets, ends of the interval are rounded so that they stay on their side of the limits.
    has_sets = pd.notna(row["agreeing_share"])
    limits = () if has_sets else (row["accepted_low"], row["accepted_high"])
    computed_text = format_as_paper(row["computed"], unit)
    if is_unbounded(row["computed"], *interval, unit):
        computed_text += f" ({NO_INTERVAL_WORDS[NumberStatus.NO_INTERVAL]})"
    elif row["low"] != row["high"]:
        computed_text = format_as_paper(
            row["computed"], unit, interval, open_end=row["open_end"], limits=limits
        )
    return {
        "published_text": published or "as stated",
        "accepted_text": _format_accepted_numbers(row["accepted_low"], row["accepted_high"], unit),
        "computed_text": computed_text,
        "kind": BY_CONSTRUCTION if row["verdict"] == BY_CONSTRUCTION else kind,
    }


def _format_accepted_numbers(low: float, high: float, unit: str) -> str:
    """Return the numbers that agree with a statement, in words."""
    if np.isinf(low):
        return f"below {format_as_paper(high, unit)}"
    if np.isinf(high):
        return f"above {format_as_paper(low, unit)}"
    low_text, _, low_unit = format_as_paper(low, unit).partition(" ")
    high_text, _, high_unit = format_as_paper(high, unit).partition(" ")
    if low_unit != high_unit:
        return f"{low_text} {low_unit} to {high_text} {high_unit}"
    # Both ends have equally many decimals: at most those of the upper end with three digits.
    printed = max(len(text.partition(".")[2]) for text in (low_text, high_text))
    decimals = min(printed, _decimals_of(float(high_text), 0.0))
    return f"{float(low_text):.{decimals}f} to {float(high_text):.{decimals}f} {high_unit}".rstrip()


def table1_rows(topography: xr.Dataset, published: pd.DataFrame) -> list[list[str]]:
    """Return the rows of Table 1 as printed: a title, then the value for each surface."""
    names = topography["surface"].values
    surfaces = [topography.sel(surface=name) for name in names]
    table1 = yaml.safe_load((TEXTS / "templates/table1.yaml").read_text("utf-8"))
    rows = []
    for quantity, row in table1.items():
        unit = row["unit"]
        values = published[published["quantity"] == quantity].set_index("surface")
        cells = [_format_published(values, name, unit) for name in names]
        rows.append([f"{row['title']}, published", *cells])
        for variable, title in row["computed"].items():
            cells = [_format_computed(surface, variable, quantity, unit) for surface in surfaces]
            rows.append([title, *cells])
    return rows


def _format_published(values: pd.DataFrame, surface: str, unit: float) -> str:
    """Return a published value and its uncertainty, in multiples of `unit`."""
    if surface not in values.index:
        return "–"
    value, uncertainty = values.loc[surface, ["value", "uncertainty"]].to_numpy(float) / unit
    decimals = max(len(f"{number:g}".partition(".")[2]) for number in (value, uncertainty))
    return _format_with_uncertainty(value, uncertainty, decimals)


def _format_computed(surface: xr.Dataset, variable: str, quantity: str, unit: float) -> str:
    """Return a mean over scans, or a value over all scales, in multiples of `unit`.

    A dagger marks what substitutes meet by construction.
    """
    has_scans = f"{variable}_mean" in surface
    name = f"{variable}_mean" if has_scans else variable
    spread = surface[f"{variable}_std"].item() / unit if has_scans else math.nan
    value = surface[name].item() / unit
    meets_by_construction = quantity in surface["table1_rows_met"].item().split(",")
    mark = " †" if meets_by_construction and TABLE1_VARIABLES[quantity] == name else ""
    return _format_with_uncertainty(value, spread, _decimals_of(value, spread)) + mark


def _format_with_uncertainty(value: float, uncertainty: float, decimals: int) -> str:
    """Return "107.1 ± 12.0", three digits without an uncertainty, or a dash without a value."""
    if not math.isfinite(value):
        return "–"
    if not math.isfinite(uncertainty):
        return f"{value:.3g}"
    return f"{value:.{decimals}f} ± {uncertainty:.{decimals}f}"


def _decimals_of(value: float, uncertainty: float) -> int:
    """Return the decimals for at most two digits of the uncertainty and three of the value."""
    digits = [1 - math.floor(math.log10(uncertainty))] if uncertainty > 0 else []
    digits += [2 - math.floor(math.log10(abs(value)))] if value and math.isfinite(value) else []
    return max(0, min(digits, default=2))
