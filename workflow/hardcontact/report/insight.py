"""The page on what decides the band: a question, its numbers and a figure for each part.

A part needs a figure in `report.figures.listing.OF_INSIGHT`, a rule that makes the dataset of that
figure, a question in ``insight.html``, and words in ``insight/<figure>.html``. The words take
their numbers from the dataset.
"""

import math
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.band.critical_band import POOLED
from hardcontact.base.number import Number
from hardcontact.report.captions import Caption
from hardcontact.report.figures.listing import describe
from hardcontact.report.quantities import number_of, on_scans
from hardcontact.report.report_pages import claim_facts
from hardcontact.report.templates import rendered
from hardcontact.surfaces.synthesis import SIDES
from hardcontact.theory.closed_form import MANY_POINTS, SINGLE_PEAKS
from hardcontact.theory.edge_scaling import CLOSED_FORM, FORMULA
from hardcontact.theory.pull_off_statistics import CHANCE, held_back

#: Distributions that are compared with computed forces.
DISTANCES = ("law", "weibull", "lognormal_fitted", "lognormal_of_law")


def insight_page(
    datasets: Mapping[str, xr.Dataset],
    figures: Mapping[str, tuple[bytes, Caption]],
    claims: pd.DataFrame,
    constants: pd.DataFrame,
    pixels: int,
    errors: Mapping[tuple[str, str], tuple[Number, int]],
) -> str:
    """Return the page, HTML.

    Parameters
    ----------
    datasets : mapping
        The final datasets of the parts, and `band`, by their names.
    figures : mapping
        SVG and caption by the names of the figures, in the order of the page.
    claims : pandas.DataFrame
        The statements as from `verdicts.read_verdicts`, and the `dataset` that each is about.
    constants : pandas.DataFrame
        As from `published.constants`.
    pixels : int
        Pixels along an edge of the scans.
    errors : mapping
        Errors of the closed form as from `prediction.validated_errors`.
    """
    # The first is the band, which knows the study's own scans; a validation table does not.
    bases: dict[str, str] = {}
    for dataset in (datasets["band"], *datasets.values()):
        if "surface" in dataset.dims:
            labels = zip(dataset["label"].values, dataset["basis"].values, strict=True)
            bases = dict(labels) | bases
    figure_of = {describe(figure).inputs[0]: figure for figure in figures}
    claims = claims.assign(open_end="", figure=claims["dataset"].map(figure_of))
    return rendered(
        "insight.html",
        figures=figures,
        claims=claim_facts(claims)["claims"],
        published=constants["value"],
        coarse=pixels < constants["value"]["scan_pixels"],
        substitutes=[label for label, basis in bases.items() if basis == "substitute"],
        edge_errors=list(edge_errors(datasets["scaling"])),
        scatter_errors=list(scatter_errors(datasets["statistics"])),
        errors=errors,
        chance=CHANCE,
        half_factor=half_factor(datasets["closed_form"]),
        band_edge=band_edge,
        long_edge=long_edge,
        on_scans=on_scans,
        exp=math.exp,
        **datasets,
    )


def band_edge(band: xr.Dataset, side: str, group: str = POOLED) -> Number:
    """Return the edge of the band at one side, of one surface or of the mean over all."""
    return number_of(band.sel(side=side, group=group), "critical_wavelength", "nm", "no_edge")


def long_edge(of_size: xr.Dataset) -> Number:
    """Return the long edge on windows of one size of scan_size.nc, or the bound on an open one."""
    bound = of_size["long_edge_bound"].item()
    if np.isfinite(of_size["long_edge"]) or np.isnan(bound):
        return number_of(of_size, "long_edge", "nm", "no_edge")
    status = "open_above" if of_size["long_edge_at_least"] else "open_below"
    return Number("long_edge", bound, "nm", status=status)


def half_factor(closed_form: xr.Dataset) -> float:
    """Return the factor within which half of the forces of the closed form lie."""
    errors = closed_form["error"].isel(map_size=-1).sel(source="spectrum")
    return float(np.exp(np.median(np.abs(np.log(errors.values)))))


def edge_errors(scaling: xr.Dataset) -> Iterator[dict[str, Any]]:
    """Yield the errors of predicted edges of designed surfaces held out, by side and regime.

    An error is the computed edge relative to the predicted one: the median, and the middle 90 % as
    the interval.
    """
    held_out = scaling.sel(designed=scaling["held_back"] == 1)
    many = held_out["designed_level"] > held_out["designed_over_range"]
    for side in SIDES:
        for regime, chosen in ((MANY_POINTS, many), (SINGLE_PEAKS, ~many)):
            is_edge = held_out["designed_bound"].sel(side=side) == 0
            errors = held_out["designed_error"].sel(side=side, designed=chosen & is_edge)
            row: dict[str, Any] = {"side": side, "regime": regime}
            for prediction in (FORMULA, CLOSED_FORM):
                known = errors.sel(prediction=prediction).dropna("designed")
                low, median, high = known.quantile([0.05, 0.5, 0.95]).values
                row[prediction] = Number("error", median, "1", low, high)
            yield row | {"surfaces": known.size}


def scatter_errors(statistics: xr.Dataset) -> Iterator[dict[str, Any]]:
    """Yield the errors of the predicted scatter on designed surfaces held out.

    There is a row below and a row above a modulus of 1. It has the number of cases, the rms error
    of the standard deviation of ln F, and the median Kolmogorov-Smirnov distances of DISTANCES.
    """
    cases = held_back(statistics)
    low = cases["designed_modulus"] < 1
    for modulus, chosen in (("below 1", low), ("above 1", ~low)):
        part = cases.isel(case=np.flatnonzero(chosen))
        ratio = np.log(part["designed_spread"] / part["designed_predicted_spread"])
        row = {"modulus": modulus, "cases": part.sizes["case"]}
        row["error"] = Number("error", float(np.expm1(np.sqrt((ratio**2).mean()))))
        for name in DISTANCES:
            row[name] = Number(name, part[f"designed_distance_{name}"].median().item())
        yield row
