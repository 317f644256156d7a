"""Robustness: range, work of adhesion and critical band under other assumptions.

The error of the fit has several local minima along the range: beside the fit, which is the least,
stand the others, so that a step from one to another is told from a shift of both.
"""

from typing import Any, NamedTuple

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from hardcontact.figures import drawing, style, tables

TITLE = "How far the results depend on choices"
CHAPTER = "7. Robustness"
CAPTION = """\
(a) Range of adhesion, (b) work of adhesion, (c) short and (d) long critical wavelength of all
substrates, each computed again with one choice changed, with fewer contacts and pixels than the
study. Compare with the top row and its dotted line: the study's own choices at this smaller
size. Diamond: the study itself. Dashed: published.

Contact is plastic. The choices: what curvature in Table 1 means to the substitutes; how the
heights of {{ robustness.heights.surface }} are distributed (the study: Gaussian; skewness
otherwise, with blunt tops, the rms height of each scan kept); a tip of an AFM that has imaged
{{ reference_surface }}; a rough sphere in Fig. 6; the preload; the hardness. The skewed heights
are made by a construction that was fitted to one public AFM scan of UNCD; no skewness is known
of the other surfaces, and none was chosen by its effect here. Variants have the first scan of
the sphere alone. Small open circles: the other local minima of the error along the range of
adhesion, which a fit may jump to. Dots and diamonds with {{ inference.confidence | percent }}
interval, from Student's t on logarithms over scans (a, b) or over realizations (c, d); an
interval that ends at the largest or smallest range computed is open there. Grey: the published
uncertainty where one is given. "Not affected": the choice concerns Fig. 6 alone; "never
reached": the force stays within the band at all cutoffs. Drawn from robustness.nc (which also
has the least error and the mean force of each surface at the published range and work),
inference.nc, band.nc and resources/paper/parameters.csv.
"""

BASELINE = "baseline"
FULL = "the study itself"
CONTACT_MODEL, GROUP = "plastic", "pooled"  # what the variants are computed with and for
ABOVE = 0.4  # rows between the baseline and the study itself
GAP = 0.4  # rows between groups of variants
VARIANT: style.Look = {"color": "0.15", "marker": "o"}
STUDY: style.Look = {"color": style.FIT, "marker": "D", "markerfacecolor": "white"}
MINIMUM: style.Look = {"color": "0.15", "marker": "o", "markerfacecolor": "white", "ms": 3}
WHITE_BOX = {"facecolor": "white", "edgecolor": "none", "pad": 1}
MISSING: style.Look = {"fontsize": 7, "ha": "center", "va": "center", "bbox": WHITE_BOX}
COLUMNS = ["panel", "variant", "label", "group", "origin", "quantity", *tables.VALUE_COLUMNS]


class _Quantity(NamedTuple):
    """The quantity of one panel, and how it is printed."""

    panel: str
    title: str
    axis: str
    unit: str
    printed_unit: float  # in `unit`
    ticks: tuple[int, ...]  # digits labelled in each decade
    missing: str  # said of a variant without a value
    minimum: str = ""  # name of its values at all local minima of the error


QUANTITIES = {  # by the name of the published constant
    "range_of_adhesion": _Quantity(
        "a", "range of adhesion", "ρ (nm)", "nm", 1, (1, 3), "not affected", "minimum_range"
    ),
    "work_of_adhesion": _Quantity(
        "b", "work of adhesion", "$W$ (mJ/m²)", "J/m2", 1e-3, (1, 3), "not affected", "minimum_work"
    ),
    "critical_wavelength_small": _Quantity(
        "c", "short cutoff", "$λ_S$ (nm)", "nm", 1, (1, 2, 3, 4, 5, 7), "never reached"
    ),
    "critical_wavelength_large": _Quantity(
        "d", "long cutoff", "$λ_L$ (µm)", "nm", 1000, (1, 2, 3, 5), "never reached"
    ),
}


def _table(
    robustness: xr.Dataset,
    inference: xr.Dataset,
    band: xr.Dataset,
    published_constants: pd.DataFrame,
) -> pd.DataFrame:
    """Return the four quantities, one row each of a variant, of the study and of the paper.

    Range of adhesion and critical wavelengths in nm, work of adhesion in J/m2, each with its
    interval `low`, `high` (published: its +-), empty where a variant does not affect a quantity or
    the force never leaves the band. Of range and work a row each of the other minima of the error
    of a variant follows. `variant` is empty but for variants.
    """
    of_study = inference.sel(contact_model=CONTACT_MODEL).merge(
        band.sel(group=GROUP), compat="override"
    )
    study = {"label": FULL, "origin": "computed"}
    rows = [
        {"panel": quantity.panel, "quantity": name, "unit": quantity.unit, **row}
        for name, quantity in QUANTITIES.items()
        for row in (
            *_variant_rows(robustness, name, quantity.minimum),
            {**study, **_result(of_study, name)},
            {"origin": "published", **tables.published_value(published_constants, name)},
        )
    ]
    return pd.DataFrame(rows)[COLUMNS]


def draw(
    robustness: xr.Dataset,
    inference: xr.Dataset,
    band: xr.Dataset,
    published_constants: pd.DataFrame,
) -> tuple[pd.DataFrame, Figure]:
    """Draw (a) range, (b) work of adhesion, (c, d) critical wavelengths, one row a variant.

    The study itself, above them, has more contacts, pixels and realizations.
    """
    rows = _table(robustness, inference, band, published_constants)
    heights = _heights(robustness)
    figure = drawing.create(0.24 * heights[-1] + 1.8, inference)
    row = figure.subplots(1, len(QUANTITIES), sharey=True)
    for axes, quantity in zip(row, QUANTITIES.values(), strict=True):
        _draw_quantity(axes, rows[rows["panel"] == quantity.panel], quantity, heights)
    row[0].set_yticks(heights, robustness["variant_label"].values)
    row[0].set_ylim(heights[-1] + 0.5, -ABOVE - 0.5)
    style.legend_above(figure, _legend_handles(robustness), 2)
    return rows, figure


def _result(data: xr.Dataset, name: str) -> dict[str, float]:
    """Return value, low and high of a quantity of one variant, or of the study."""
    variable, _, side = name.partition("_wavelength_")
    if side:
        return tables.value_and_bounds(data.sel(side=side), f"{variable}_wavelength")
    return tables.value_and_bounds(data, name)


def _variant_rows(robustness: xr.Dataset, name: str, minimum: str) -> list[dict[str, Any]]:
    """Return one row a variant, then one for each local minimum of its error but the least."""
    described = robustness[["variant_label", "group"]].to_dataframe()
    variants = [
        {"variant": variant, "label": label, "group": group, "origin": "computed"}
        for variant, label, group in described[["variant_label", "group"]].itertuples()
    ]
    rows: list[dict[str, Any]]
    rows = [{**one, **_result(robustness.sel(variant=one["variant"]), name)} for one in variants]
    if minimum:
        others = robustness[minimum].isel(minimum=slice(1, None))
        rows += [
            {**one, "quantity": minimum, "value": value}
            for one in variants
            for value in others.sel(variant=one["variant"]).values
            if np.isfinite(value)
        ]
    return rows


def _heights(robustness: xr.Dataset) -> np.ndarray:
    """Return where each variant is drawn, downwards, with gaps between the groups."""
    group = robustness["group"].values
    return np.concatenate([[0], np.cumsum(1 + GAP * (group[1:] != group[:-1]))])


def _draw_quantity(
    axes: Axes, rows: pd.DataFrame, quantity: _Quantity, heights: np.ndarray
) -> None:
    """Draw one quantity: variants downwards, the study above them, the published value behind."""
    published = rows[rows["origin"] == "published"].iloc[0]
    factor = quantity.printed_unit
    if np.isfinite(published["low"]):
        axes.axvspan(published["low"] / factor, published["high"] / factor, color="0.85", zorder=0)
    axes.axvline(published["value"] / factor, color="0.4", lw=1.0, ls="--")
    other = rows["quantity"] == quantity.minimum
    variants = rows[rows["group"].notna() & ~other]
    others = rows[other].groupby("variant")["value"]
    for height, (_, variant) in zip(heights, variants.iterrows(), strict=True):
        if variant["variant"] in others.groups:
            minima = others.get_group(variant["variant"]) / factor
            axes.plot(minima, [height] * len(minima), ls="none", **MINIMUM)
        _draw_result(axes, height, variant, quantity, VARIANT)
        if variant["group"] == BASELINE:
            axes.axvline(variant["value"] / factor, color="0.15", lw=0.6, ls=":")
            study = rows[rows["label"] == FULL].iloc[0]
            _draw_result(axes, height - ABOVE, study, quantity, STUDY)
    axes.set(xscale="log", xlabel=quantity.axis)
    axes.tick_params(axis="y", length=0)
    style.label_logarithmic(axes.xaxis, at=quantity.ticks)
    style.label_panel(axes, quantity.panel, quantity.title)


def _draw_result(
    axes: Axes, height: float, result: pd.Series, quantity: _Quantity, look: style.Look
) -> None:
    """Draw a value and its interval, or say why there is none."""
    value, low, high = result[["value", "low", "high"]].astype(float) / quantity.printed_unit
    axes.plot([low, high], [height, height], color=look["color"], lw=1.2)
    axes.plot([value], [height], ls="none", **look)
    if not np.isfinite(value):
        at = axes.get_yaxis_transform()
        axes.text(0.5, height, quantity.missing, transform=at, **MISSING)


def _legend_handles(robustness: xr.Dataset) -> list[Artist]:
    """Return one entry for each kind of mark; the dotted line has the name of the top row."""
    baseline = robustness["variant_label"].values[robustness["group"].values == BASELINE][0]
    size = robustness.attrs
    plural = "" if size["realizations"] == 1 else "s"
    variants = (
        f"variants: {size['count']} x {size['count']} contacts, {size['realizations']} "
        f"realization{plural} of {size['pixels_small']}² and {size['pixels_large']}² pixels"
    )
    return [
        Line2D([], [], lw=1.2, label=variants, **VARIANT),
        Line2D([], [], ls="none", label="other minima of the error", **MINIMUM),
        Line2D([], [], lw=1.2, label=f"{FULL}, all of its contacts and pixels", **STUDY),
        Line2D([], [], lw=0.6, ls=":", color="0.15", label=str(baseline)),
        Line2D([], [], lw=1.0, ls="--", color="0.4", label="published"),
        Patch(color="0.85", lw=0, label="its uncertainty"),
    ]
