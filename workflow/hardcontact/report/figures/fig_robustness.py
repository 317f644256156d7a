"""Robustness: range, work of adhesion and critical band under other assumptions."""

from collections.abc import Iterable

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from hardcontact.inference.edges import POOLED
from hardcontact.report.figures import drawing, style, tables

TITLE = "How far the results depend on choices"
CHAPTER = "7. Robustness"
CAPTION = """\
(a) Range of adhesion, (b) work of adhesion, (c) short and (d) long edge of the band of all
substrates, each with one choice changed. Variants have fewer contacts and pixels than the study.
Compare them with the top row and its dotted line, the study's own choices on these grids.
Diamond: the study itself. Dashed: published.

Contact is plastic; variants have the first scan of the sphere alone. The choices: the definition
of curvature in Table 1, heights of {{ robustness.heights.surface | replace("_", " ") }}, a rough
sphere in Fig. 6, the preload, the hardness. Heights of the study are Gaussian. Skewed heights keep
the rms height of each scan, by a construction that was fitted to one public AFM scan of UNCD.
Small open circles: other local minima of the error, to which a fit may jump. Bars:
{{ inference.confidence | percent }} intervals over scans (a, b) or realizations, random surfaces
of one spectrum (c, d). An interval that ends at the longest or shortest computed range is open
there. Grey: the published uncertainty. "Not affected": the choice concerns Fig. 6 alone. "Never
reached": the force stays within the band at all cutoffs. Drawn from robustness.nc, fit.nc,
edges.nc and resources/paper/parameters.csv.
"""

BASELINE = "baseline"
STUDY_ITSELF = "the study itself"
STUDY_GAP = 0.4  # rows between the baseline and the study itself
GROUP_GAP = 0.4  # rows between groups of variants
VARIANT_LOOK: style.Look = {"color": "0.15", "marker": "o"}
STUDY_LOOK: style.Look = {"color": style.FIT_COLOUR, "marker": "D", "markerfacecolor": "white"}
MINIMUM_LOOK: style.Look = {"color": "0.15", "marker": "o", "markerfacecolor": "white", "ms": 3}
WHITE_BOX = {"facecolor": "white", "edgecolor": "none", "pad": 1}
MISSING_NOTE: style.Look = {"fontsize": 7, "ha": "center", "va": "center", "bbox": WHITE_BOX}
COLUMNS = ["panel", "variant", "label", "variant_kind", "origin", "quantity", *tables.VALUE_COLUMNS]
#: Published constant: unit, printed unit in it, title, axis.
QUANTITIES = {
    "range_of_adhesion": ("nm", 1, "range of adhesion", "ρ (nm)"),
    "work_of_adhesion": ("J/m2", 1e-3, "work of adhesion", "$W$ (mJ/m²)"),
    "edge_small": ("nm", 1, "short edge", "$λ_S$ (nm)"),
    "edge_large": ("nm", 1000, "long edge", "$λ_L$ (µm)"),
}
#: Values of a quantity at all local minima of the error of the fit.
MINIMUM_VARIABLES = {"range_of_adhesion": "range_at_minimum", "work_of_adhesion": "work_at_minimum"}


def draw(
    robustness: xr.Dataset,
    fit: xr.Dataset,
    edges: xr.Dataset,
    published_constants: pd.DataFrame,
) -> tuple[pd.DataFrame, Figure]:
    """Draw (a) range, (b) work of adhesion, (c, d) edges, one row a variant.

    In the table only variants have a `variant`. Values are empty if a variant does not affect a
    quantity, or if the force stays within the tolerance.
    """
    # Results of the study itself, with plastic contact and the mean over all substrates.
    study = fit.sel(contact_model="plastic").merge(edges.sel(group=POOLED), compat="override")
    group = robustness["variant_kind"].values
    row_positions = np.concatenate([[0], np.cumsum(1 + GROUP_GAP * (group[1:] != group[:-1]))])
    figure = drawing.create(0.24 * row_positions[-1] + 1.8, fit)
    panels = figure.subplots(1, len(QUANTITIES), sharey=True)
    frames = []
    for letter, axes, (name, (unit, printed_unit, title, axis)) in zip(
        "abcd", panels, QUANTITIES.items(), strict=True
    ):
        variants = _results(robustness, name)
        study_results = _results(study, name).assign(label=STUDY_ITSELF)
        published = tables.published_rows(published_constants, {name: unit}, letter)
        computed_rows = [variants.assign(quantity=name), study_results.assign(quantity=name)]
        _draw_published(axes, published.iloc[0], printed_unit)
        if name in MINIMUM_VARIABLES:
            minima = _other_minima(robustness, MINIMUM_VARIABLES[name])
            row = minima["variant"].map(dict(zip(variants["variant"], row_positions, strict=True)))
            axes.plot(minima["value"] / printed_unit, row, ls="none", **MINIMUM_LOOK)
            computed_rows.append(minima.assign(quantity=MINIMUM_VARIABLES[name]))
        note = "not affected" if name in MINIMUM_VARIABLES else "never reached"
        columns = ["value", "low", "high"]
        _draw_results(axes, variants[columns] / printed_unit, row_positions, note, VARIANT_LOOK)
        _draw_results(axes, study_results[columns] / printed_unit, [-STUDY_GAP], note, STUDY_LOOK)
        baseline = variants["value"][variants["variant_kind"] == BASELINE].item()
        axes.axvline(baseline / printed_unit, color="0.15", lw=0.6, ls=":")
        axes.set(xscale="log", xlabel=axis)
        axes.tick_params(axis="y", length=0)
        style.label_logarithmic(
            axes.xaxis, digits=(1, 3) if name in MINIMUM_VARIABLES else (1, 2, 3, 5)
        )
        style.label_panel(axes, letter, title)
        frames.append(pd.concat(computed_rows).assign(panel=letter, origin="computed", unit=unit))
        frames.append(published)
    panels[0].set_yticks(row_positions, robustness["variant_label"].values)
    panels[0].set_ylim(row_positions[-1] + 0.5, -STUDY_GAP - 0.5)
    style.legend_above(figure, _legend_handles(robustness), 2)
    return pd.concat(frames).reindex(columns=COLUMNS), figure


def _results(data: xr.Dataset, name: str) -> pd.DataFrame:
    """Return a row for each variant, or one for the study, with a quantity and its interval."""
    if name not in MINIMUM_VARIABLES:
        name, _, side = name.rpartition("_")
        data = data.sel(side=side)
    values = tables.value_and_interval(data, name)
    if "variant" not in data.dims:
        return pd.DataFrame([{str(end): number.item() for end, number in values.items()}])
    labels = data[["variant_label", "variant_kind"]].rename(variant_label="label")
    return tables.number_rows(values.merge(labels, compat="override"))


def _other_minima(robustness: xr.Dataset, name: str) -> pd.DataFrame:
    """Return a quantity at the local minima of the error of each variant, except the lowest."""
    minima = robustness[["variant_label", "variant_kind", name]].isel(minimum=slice(1, None))
    return tables.number_rows(minima.rename({"variant_label": "label", name: "value"})).dropna(
        subset=["value"]
    )


def _draw_published(axes: Axes, published: pd.Series, unit: float) -> None:
    """Draw the published value as a line, and its uncertainty, if any, as a band."""
    if np.isfinite(published["low"]):
        axes.axvspan(published["low"] / unit, published["high"] / unit, color="0.85", zorder=0)
    axes.axvline(published["value"] / unit, color="0.4", lw=1.0, ls="--")


def _draw_results(
    axes: Axes, results: pd.DataFrame, row_positions: Iterable[float], note: str, look: style.Look
) -> None:
    """Draw values and their intervals, or a note if there is no value."""
    for row_position, (value, low, high) in zip(
        row_positions, results.itertuples(index=False), strict=True
    ):
        axes.plot([low, high], [row_position, row_position], color=look["color"], lw=1.2)
        axes.plot([value], [row_position], ls="none", **look)
        if not np.isfinite(value):
            axes.text(0.5, row_position, note, transform=axes.get_yaxis_transform(), **MISSING_NOTE)


def _legend_handles(robustness: xr.Dataset) -> list[Artist]:
    """Return one entry for each kind of mark; the dotted line has the name of the top row."""
    baseline = robustness["variant_label"].values[robustness["variant_kind"].values == BASELINE][0]
    size = robustness.attrs
    plural = "" if size["realizations"] == 1 else "s"
    variants = (
        f"variants: {size['contacts_per_side']} x {size['contacts_per_side']} contacts, "
        f"{size['realizations']} "
        f"realization{plural} of {size['pixels_small']}² and {size['pixels_large']}² pixels"
    )
    return [
        Line2D([], [], lw=1.2, label=variants, **VARIANT_LOOK),
        Line2D([], [], ls="none", label="other minima of the error", **MINIMUM_LOOK),
        Line2D(
            [], [], lw=1.2, label=f"{STUDY_ITSELF}, all of its contacts and pixels", **STUDY_LOOK
        ),
        Line2D([], [], lw=0.6, ls=":", color="0.15", label=str(baseline)),
        Line2D([], [], lw=1.0, ls="--", color="0.4", label="published"),
        Patch(color="0.85", lw=0, label="its uncertainty"),
    ]
