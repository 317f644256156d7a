"""Panels b and c of Fig. 4: ratios of forces, and forces, against the range of adhesion."""

from typing import Any

import pandas as pd
import xarray as xr
from matplotlib.axes import Axes

from hardcontact.figures import marks, style, tables

AT_FIT: dict[str, Any] = {"mfc": "white", "ms": 5, "mew": 1.2}
RATIO_FIT: dict[str, Any] = {"color": "black", "lw": 1.2, "marker": "P", "ms": 5}

Curves = dict[tuple[str, str], xr.Dataset]  # by quantity, and by what the values are over


def _reference(fit: xr.Dataset) -> str:
    """Return the surface the ratios refer to, whose own ratio is 1 everywhere."""
    return str(abs(fit["ratio"] - 1).max("rho").idxmin("surface").item())


def force_curves(fit: xr.Dataset, of_sets: xr.Dataset, work: float) -> Curves:
    """Return ratio and mean force (N) at a work of adhesion (J/m2) against rho.

    By quantity, and by whether they are over the "scans" of the study or over the "sets".
    """
    return {
        ("ratio", "scans"): tables.bounded(fit, "ratio"),
        ("ratio", "sets"): tables.over_sets(of_sets["ratio"]),
        ("mean_force", "scans"): tables.bounded(fit, "mean_force") * work,
        ("mean_force", "sets"): tables.over_sets(of_sets["mean_force"]) * work,
    }


def curve_rows(
    fit: xr.Dataset, curves: Curves, published_pull_off: pd.DataFrame
) -> list[pd.DataFrame]:
    """Return what panels b and c show: curves, values at the fit (nm, N), published values."""
    return [
        *_computed_rows(curves),
        _fitted_rows(fit),
        *_published_rows(fit, published_pull_off),
        pd.DataFrame([tables.value_and_bounds(fit, "range_from_ratios")]).assign(
            panel="b", origin="computed", quantity="range_from_ratios", over="scans", unit="nm"
        ),
    ]


def _computed_rows(curves: Curves) -> list[pd.DataFrame]:
    shown = {"ratio": ("b", "1"), "mean_force": ("c", "N")}
    return [
        values.to_dataframe()[["value", "low", "high"]]
        .reset_index()
        .rename(columns={"rho": "x"})
        .assign(quantity=quantity, over=over, panel=shown[quantity][0], unit=shown[quantity][1])
        .assign(origin="computed")
        for (quantity, over), values in curves.items()
    ]


def _fitted_rows(fit: xr.Dataset) -> pd.DataFrame:
    """Return the mean forces (N) at the fitted range and work of adhesion."""
    forces = tables.bounded(fit.sel(pair="fitted"), "force_mean")
    rows = forces.to_dataframe()[["value", "low", "high"]].reset_index()
    rows = rows.assign(panel="c", origin="computed", quantity="mean_force_at_fit", over="scans")
    return rows.assign(unit="N", x=fit["range_of_adhesion"].item())


def _published(fit: xr.Dataset, published_pull_off: pd.DataFrame) -> pd.DataFrame:
    """Return published mean and median (N) by surface, and the ratio of means."""
    forces = published_pull_off.reindex(fit["surface"].values)
    mean = forces["mean_force"]
    return forces.assign(ratio=mean / mean[_reference(fit)])


def _published_rows(fit: xr.Dataset, published_pull_off: pd.DataFrame) -> list[pd.DataFrame]:
    published = _published(fit, published_pull_off).rename_axis("surface").reset_index()
    return [
        published[["surface", quantity]]
        .rename(columns={quantity: "value"})
        .assign(panel=panel, origin="published", quantity=quantity, unit=unit)
        for panel, quantity, unit in (
            ("b", "ratio", "1"),
            ("c", "mean_force", "N"),
            ("c", "median_force", "N"),
        )
    ]


def draw_ratios(
    axes: Axes, fit: xr.Dataset, curves: Curves, published_pull_off: pd.DataFrame
) -> None:
    """Draw the ratio of mean forces to the reference surface against rho (nm)."""
    reference = _reference(fit)
    _draw_curves(axes, fit, curves["ratio", "scans"], curves["ratio", "sets"], skipped=reference)
    ratios = _published(fit, published_pull_off)["ratio"]
    _draw_levels(axes, ratios.drop(reference), fit, "-")
    best = tables.value_and_bounds(fit, "range_from_ratios")
    along = [best[name] for name in ("low", "value", "high")]
    style.end_near_values([axes])
    axes.plot(along, [0.05] * 3, transform=axes.get_xaxis_transform(), markevery=[1], **RATIO_FIT)
    axes.set_ylabel(f"force / that of {fit['label'].sel(surface=reference).item()}")
    style.label_panel(axes, "b", "ratios of forces, for any $W$")


def draw_forces(
    axes: Axes, fit: xr.Dataset, curves: Curves, work: float, published_pull_off: pd.DataFrame
) -> None:
    """Draw the mean force (µN) at the published work of adhesion (J/m2) against rho (nm)."""
    scans, of_sets = (curves["mean_force", over] / marks.MICRONEWTON for over in ("scans", "sets"))
    _draw_curves(axes, fit, scans, of_sets)
    published = _published(fit, published_pull_off) / marks.MICRONEWTON
    _draw_levels(axes, published["mean_force"], fit, "-")
    _draw_levels(axes, published["median_force"], fit, ":")
    fitted = tables.bounded(fit.sel(pair="fitted"), "force_mean") / marks.MICRONEWTON
    for surface, look in style.looks(fit["surface"].values).items():
        of_surface = fitted.sel(surface=surface)
        axes.errorbar(
            fit["range_of_adhesion"],
            of_surface["value"],
            marks.reach(of_surface)[:, None],
            elinewidth=1.2,
            zorder=4,
            **look | AT_FIT,
        )
    style.end_near_values([axes])
    axes.set_ylabel("mean pull-off force (µN)")
    style.label_panel(
        axes, "c", rf"curves: at the published $W$ = {work / marks.MILLIJOULE:.3g} mJ/m²"
    )


def _draw_curves(
    axes: Axes, fit: xr.Dataset, scans: xr.Dataset, of_sets: xr.Dataset, skipped: str = ""
) -> None:
    """Draw the value with its interval, and the band of the sets, of each but the skipped one."""
    for surface, look in style.looks(fit["surface"].values).items():
        if surface == skipped:
            continue
        band, curve = of_sets.sel(surface=surface), scans.sel(surface=surface)
        marks.fill_sets(axes, band["rho"], band, look["color"])
        axes.errorbar(
            curve["rho"], curve["value"], marks.reach(curve), elinewidth=0.7, ms=2.5, **look
        )
    axes.set(xscale="log", yscale="log")


def _draw_levels(axes: Axes, levels: pd.Series, fit: xr.Dataset, dashes: str) -> None:
    """Draw a horizontal line for each surface with a published value."""
    colours = style.colours(fit["surface"].values)
    for surface, level in levels.dropna().items():
        axes.axhline(level, color=colours[str(surface)], lw=0.9, ls=dashes)
