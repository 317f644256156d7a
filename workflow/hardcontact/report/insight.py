"""The page about the causes of the band: a question, its numbers and a figure for each part.

A part needs a figure in `report.figures.listing.INSIGHT_FIGURES`, a rule that makes the dataset of
that figure, a question in ``insight.html``, and text in ``insight/<figure>.html``. The text takes
its numbers from the dataset.
"""

import math
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr
from numpy.typing import ArrayLike

from hardcontact.base.formatting import is_boundless
from hardcontact.base.number import Number
from hardcontact.inference.edges import POOLED
from hardcontact.report.figures.listing import Caption, describe_figure
from hardcontact.report.quantities import ends, printed_label
from hardcontact.report.report_pages import claim_facts
from hardcontact.report.templates import rendered
from hardcontact.surfaces.synthesis import SIDES
from hardcontact.theory.closed_form import MANY_POINTS, SINGLE_PEAKS
from hardcontact.theory.edge_scaling import CLOSED_FORM, FORMULA
from hardcontact.theory.force_scatter import CHANCE, held_out_surfaces

#: Distributions that are compared with computed forces.
DISTRIBUTIONS = ("law", "weibull", "lognormal_fitted", "lognormal_of_law")


def insight_page(
    datasets: Mapping[str, xr.Dataset],
    figures: Mapping[str, tuple[bytes, Caption]],
    claims: pd.DataFrame,
    constants: pd.DataFrame,
    pixels: int,
    errors: Mapping[tuple[str, str], tuple[Number, int]],
) -> str:
    """Return the page, HTML.

    datasets: the final datasets of the parts, and `band`, by their names.
    figures: SVG and caption by the names of the figures, in the order of the page.
    claims: the table that `verdicts.read_verdicts` returns, with the `dataset` of each statement.
    constants: the table that `published.constants` returns.
    pixels: pixels along a side of the scans.
    errors: errors of the closed form, from `prediction.validated_errors`.
    """
    # The band has the bases of the study's own surfaces, validation tables those of others.
    bases: dict[str, str] = {}
    for dataset in (datasets["edges"], *datasets.values()):
        if "surface" in dataset.dims:
            labels = zip(dataset["label"].values, dataset["basis"].values, strict=True)
            bases = dict(labels) | bases
    figure_of = {describe_figure(figure).inputs[0]: figure for figure in figures}
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
        band_edge=edge_number,
        long_edge=long_edge,
        on_scans=on_scans,
        number_of=number_of,
        span=span,
        surfaces=surfaces,
        in_percent=in_percent,
        Number=Number,
        exp=math.exp,
        **datasets,
    )


def edge_number(band: xr.Dataset, side: str, group: str = POOLED) -> Number:
    """Return the edge of the band at one side, for one surface or the mean over all surfaces."""
    return number_of(band.sel(side=side, group=group), "edge", "nm", "no_edge")


def long_edge(size_data: xr.Dataset) -> Number:
    """Return the long edge on windows of one size of scan_size.nc, or its bound if it is open."""
    bound = size_data["long_edge_bound"].item()
    if np.isfinite(size_data["long_edge"]) or np.isnan(bound):
        return number_of(size_data, "long_edge", "nm", "no_edge")
    status = "open_above" if size_data["long_edge_bound_is_lower"] else "open_below"
    return Number("long_edge", bound, "nm", status=status)


def half_factor(closed_form: xr.Dataset) -> float:
    """Return the median error, as a factor, of forces from the closed form."""
    errors = closed_form["predicted_over_computed"].isel(map_size=-1).sel(source="spectrum")
    return float(np.exp(np.median(np.abs(np.log(errors.values)))))


def edge_errors(scaling: xr.Dataset) -> Iterator[dict[str, Any]]:
    """Yield the errors of predicted edges of designed surfaces held out, by side and regime.

    An error is the computed edge relative to the predicted edge: the median, with the middle 90 %
    as its interval.
    """
    held_out = scaling.sel(designed=scaling["held_out"] == 1)
    has_many_points = held_out["designed_level"] > held_out["designed_rms_height_over_range"]
    for side in SIDES:
        for regime, in_regime in ((MANY_POINTS, has_many_points), (SINGLE_PEAKS, ~has_many_points)):
            is_edge = held_out["designed_bound"].sel(side=side) == 0
            errors = held_out["designed_computed_over_predicted"].sel(
                side=side, designed=in_regime & is_edge
            )
            row: dict[str, Any] = {"side": side, "regime": regime}
            for prediction in (FORMULA, CLOSED_FORM):
                prediction_errors = errors.sel(prediction=prediction).dropna("designed")
                low, median, high = prediction_errors.quantile([0.05, 0.5, 0.95]).values
                row[prediction] = Number("error", median, "1", low, high)
            yield row | {"surfaces": prediction_errors.size}


def scatter_errors(statistics: xr.Dataset) -> Iterator[dict[str, Any]]:
    """Yield the errors of the predicted scatter on designed surfaces held out.

    The first row is for a modulus below 1, the second for a modulus above 1. A row has the number
    of cases, the rms error of the standard deviation of ln F, and the median Kolmogorov-Smirnov
    distances of DISTRIBUTIONS.
    """
    cases = held_out_surfaces(statistics)
    is_below = cases["designed_weibull_modulus"] < 1
    for modulus, in_group in (("below 1", is_below), ("above 1", ~is_below)):
        group = cases.isel(case=np.flatnonzero(in_group))
        ratio = np.log(group["designed_log_force_std"] / group["designed_predicted_log_force_std"])
        row = {"modulus": modulus, "cases": group.sizes["case"]}
        row["error"] = Number("error", float(np.expm1(np.sqrt((ratio**2).mean()))))
        for name in DISTRIBUTIONS:
            row[name] = Number(name, group[f"designed_distance_{name}"].median().item())
        yield row


def number_of(
    dataset: xr.Dataset,
    variable: str,
    unit: str = "",
    missing: str = "",
    *,
    name: str = "",
    source: str = "computed",
    strict: bool = True,
) -> Number:
    """Return a variable without dimensions, with its `<variable>_interval` if there is one.

    The unit replaces that of the dataset, and the name that of the variable. `missing` is the
    status of a value that is not finite. If strict, an interval that reaches too far counts as
    none, and an interval without ends has the status "no_interval".
    """
    unit = unit or str(dataset[variable].attrs.get("units", "1"))
    number = Number(name or variable, float(dataset[variable].item()), unit, source=source)
    if not math.isfinite(number.value):
        return number._replace(status=missing)
    if f"{variable}_interval" not in dataset:
        return number
    low, high = ends(dataset, variable)
    if (low, high) == (0, math.inf) or (strict and is_boundless(number.value, low, high, unit)):
        return number._replace(status="no_interval")
    without = strict and not (math.isfinite(low) or math.isfinite(high))
    return number._replace(low=low, high=high, status="no_interval" if without else "")


def span(values: ArrayLike, unit: str = "1", name: str = "span") -> Number:
    """Return the smallest and the largest of the finite values."""
    finite = [value for value in np.ravel(values) if np.isfinite(value)]
    return _bounds_only(name, min(finite, default=np.nan), max(finite, default=np.nan), unit)


def in_percent(share: Number) -> Number:
    """Return a share, which is a fraction of one, in percent."""
    low, high = 100 * share.low, 100 * share.high
    return share._replace(value=100 * share.value, low=low, high=high, unit="%")


def surfaces(dataset: xr.Dataset) -> list[tuple[str, xr.Dataset]]:
    """Return the printed name of each surface of a dataset, and the data of this surface."""
    selected = [dataset.sel(surface=name) for name in dataset["surface"].values]
    return [(printed_label(data["label"].item(), data["basis"].item()), data) for data in selected]


def on_scans(scan_size: xr.Dataset) -> xr.Dataset:
    """Return edges and forces on mirrored windows of the size of the study's scans."""
    windows = scan_size.sel(map_size=scan_size["mirrored"] == 1)
    return windows.sel(map_size=scan_size.attrs["scan_size"], method="nearest")


def _bounds_only(
    name: str, low: float, high: float, unit: str = "1", missing: str = "not_known"
) -> Number:
    """Return a number of which only ends are known; the status says which."""
    codes = {(True, True): "between", (True, False): "more_than", (False, True): "at_most"}
    status = codes.get((math.isfinite(low), math.isfinite(high)), missing)
    return Number(name, math.nan, unit, low, high, status)
