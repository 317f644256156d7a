"""Numbers of the page on what decides the band: laws, scatter of forces, elastic limit.

Every function returns what a template shows of one question, as those of `insight_facts`.
"""

from typing import Any

import numpy as np
import xarray as xr

from hardcontact.answer.facts import (
    Cells,
    ends,
    number,
    number_of,
    percent,
    span,
    surfaces,
)
from hardcontact.claims.verdicts import verdict
from hardcontact.insight.interaction_laws import EXPONENTIAL
from hardcontact.insight.pull_off_statistics import CHANCE, held_back
from hardcontact.numbers.number import Number
from hardcontact.scales.critical_band import POOLED
from hardcontact.surfaces.synthesis import SIDES

#: Numbers of the scatter of forces on a surface.
STATISTICS = (
    "modulus", "spread", "total_spread", "total_shape", "computed_spread", "contacts_needed",
    "scans_needed", "distance",
)  # fmt: skip
#: Distributions whose distance from computed forces is known.
DISTANCES = ("law", "weibull", "lognormal_fitted", "lognormal_of_law")


def law_facts(laws: xr.Dataset) -> dict[str, Any]:
    """Return how far the forces of other laws differ, the mean band of each, and fits."""
    of_laws = [laws.sel(law=law) for law in laws["law"].values]
    rows = [_law(one) for one in of_laws]
    judged = [row["verdict"] for row in rows if row["verdict"]]
    answer = "yes" if set(judged) == {"reproduced"} else "open"
    return {
        "rows": rows,
        "verdict": "no" if "not reproduced" in judged else answer,
        "reproduced": judged.count("reproduced"),
        "undecided": judged.count("undecided"),
        "tolerance": percent(Number("tolerance", laws.attrs["scale_tolerance"])),
        "spacing": Number("spacing", laws.attrs["atomic_spacing"], "nm"),
        "scans": laws.attrs["scans"],
        "contacts": laws.attrs["contacts"],
    }


def _law(law: xr.Dataset) -> Cells:
    """Return one law at the range and work that come nearest to the forces of Eq. 1."""
    case = law.sel(case="equivalent")
    error, limit = case["fit_error"].item(), law.attrs["scale_tolerance"]
    other = law["law"] != EXPONENTIAL.name
    row = {
        "law": str(law["law_label"].item()),
        "error": percent(number_of(case, "fit_error")),
        "verdict": verdict("below", error, *ends(case, "fit_error"), np.nan, limit)
        if other
        else "",
        "range": number_of(case, "range_of_law", "nm"),
        "work": number_of(case, "work_of_adhesion", "J m-2"),
        "strength": number_of(case, "implied_over_known"),
        "fitted": percent(number_of(law.sel(case="fitted"), "fit_error")),
        "atomic": percent(number_of(law.sel(case="atomic"), "fit_error")),
    }
    for side in SIDES:
        edge = case.sel(side=side, group=POOLED)
        row[side] = number_of(edge, "critical_wavelength", "nm", "no_edge")
    return row


def statistics_facts(statistics: xr.Dataset) -> dict[str, Any]:
    """Return how forces scatter by the law, computed and published, and how well it holds."""
    rows = []
    for row, one in surfaces(statistics.sel(rho=statistics.attrs["reference_rho"])):
        published, total = one["published_spread"].item(), one["total_shape"].item()
        rest = np.sqrt(published**2 - total**2) if published > total else np.nan
        row |= {name: number_of(one, name) for name in STATISTICS}
        row["published_spread"] = number_of(one, "published_spread", missing="not_printed")
        row["rest"] = number("rest", rest, "1", "nothing")
        rows.append(row)
    tested = held_back(statistics)
    low = tested["designed_modulus"] < 1
    moduli = np.sort(tested["designed_modulus"])
    untried = np.log(moduli[1:] / moduli[:-1]).argmax()
    return {
        "rows": rows,
        "validated": [
            _law_error(tested.isel(case=np.flatnonzero(part))) | {"modulus": name}
            for name, part in (("below", low), ("above", ~low))
        ],
        "designed": np.unique(tested["designed_surface"]).size,
        "untried": span("untried", moduli[untried : untried + 2]),
        "chance": Number("chance", CHANCE),
        "tolerance": percent(Number("tolerance", statistics.attrs["tolerance"])),
        "range": Number("range", statistics.attrs["reference_rho"], "nm"),
        "shape": span("shape", [row["total_shape"].value for row in rows]),
        "published": span("published", [row["published_spread"].value for row in rows]),
    }


def _law_error(cases: xr.Dataset) -> Cells:
    """Return how many designed cases there are, the error of the spread, distances, rejections."""
    ratio = np.log(cases["designed_spread"] / cases["designed_predicted_spread"])
    error = float(np.exp(np.sqrt((ratio**2).mean())) - 1)
    row: Cells = {
        "cases": Number("cases", cases.sizes["case"]),
        "error": percent(Number("error", error)),
    }
    for name in DISTANCES:
        distance = cases[f"designed_distance_{name}"]
        row[name] = Number(name, distance.median().item())
        row[f"{name}_rejected"] = percent(Number(name, (distance > CHANCE).mean().item()))
    return row


def elastic_limit_facts(limit: xr.Dataset) -> dict[str, Any]:
    """Return whether all surfaces have slopes at which contacts yield, and from which waves on."""
    rows = []
    for row, surface in surfaces(limit):
        index = surface["slope_index"]
        below = float(index["shortest_wavelength"].where(index >= 1).max())
        row |= {
            "all_scales": number("all_scales", index.values[0], "1", ""),
            "below": number("below", below, "nm", "not_reached"),
        }
        rows.append(row)
    all_yield = all(row["all_scales"].value >= 1 for row in rows)
    return {"rows": rows, "verdict": "yes" if all_yield else "no"}
