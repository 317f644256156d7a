"""Fig. 4: range and work of adhesion from the computed pull-off forces."""

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from hardcontact.figures import fig4_error, style
from hardcontact.figures.tables import (
    ROW_COLUMNS,
    VALUE_COLUMNS,
    bounded,
    label_surfaces,
    value_and_bounds,
)

__all__ = ["draw", "table"]

CONTACT_MODEL = "plastic"  # the one the paper's conclusions rest on
MICRONEWTON = 1e-6
MEGAPASCAL = 1e6
MILLIJOULE = 1e-3
PRESSURE_DECADES = 3  # below, the pressure adds nothing visible to the force
COLUMNS = [*ROW_COLUMNS, "x", *VALUE_COLUMNS]


def table(
    contact: xr.Dataset,
    inference: xr.Dataset,
    published_constants: pd.DataFrame,
    published_pull_off: pd.DataFrame,
) -> pd.DataFrame:
    """Return the curves and fitted values of Fig. 4, one row a point.

    Parameters
    ----------
    contact, inference, published_constants, published_pull_off : xarray.Dataset, pandas.DataFrame
        As `draw` takes them.

    Returns
    -------
    pandas.DataFrame
        `x` is the separation (nm, panel a) or the range of adhesion rho (nm, b to d), `value` with
        its bootstrap interval `low`, `high` in `unit`. The maps of panels a (adhesive pressure)
        and d (mean relative error) stay in contact.nc and inference.nc.
    """
    fit = inference.sel(contact_model=CONTACT_MODEL)
    frames = [
        _separation_rows(contact),
        *_curve_rows(fit),
        *_published_rows(fit, published_pull_off),
        pd.DataFrame([_range_from_ratios(fit)]),
        fig4_error.error_map_rows(fit, published_constants),
    ]
    return label_surfaces(pd.concat(frames, ignore_index=True), inference)[COLUMNS]


@style.print_style()
def draw(
    contact: xr.Dataset,
    inference: xr.Dataset,
    published_constants: pd.DataFrame,
    published_pull_off: pd.DataFrame,
) -> Figure:
    """Draw Fig. 4: (a) one contact, (b) force ratios, (c) forces, (d) error of range and work.

    Parameters
    ----------
    contact : xarray.Dataset
        With the adhesive pressure (y, x) in Pa and the force (separation) in N.
    inference : xarray.Dataset
        With all that is computed in panels b to d.
    published_constants : pandas.DataFrame
        With range (nm) and work of adhesion (J/m2) and their uncertainties.
    published_pull_off : pandas.DataFrame
        With mean and median force (N) by surface.

    Returns
    -------
    matplotlib.figure.Figure
        The figure.
    """
    fit = inference.sel(contact_model=CONTACT_MODEL)
    figure = style.create(5.6)
    rows = figure.add_gridspec(2, 1, height_ratios=(1, 1.2))
    above, below = rows[0], rows[1]
    upper = above.subgridspec(1, 3, width_ratios=(1.4, 0.8, 1.5))
    pressure, separation, ratios = upper.subplots(squeeze=False)[0]
    forces, error = below.subgridspec(1, 2).subplots(squeeze=False)[0]
    _draw_pressure(pressure, contact)
    _draw_separation(separation, contact)
    _draw_ratios(ratios, fit, published_pull_off)
    _draw_forces(forces, fit, published_pull_off)
    fig4_error.draw_error_map(error, fit, published_constants)
    figure.legend(handles=_legend_handles(fit), loc="outside upper center", ncols=5)
    style.mark_basis(figure, inference)
    return figure


def _reference(fit: xr.Dataset) -> str:
    """Return the surface the ratios refer to, whose own ratio is 1 everywhere."""
    return str(abs(fit["ratio"] - 1).max("rho").idxmin("surface").item())


def _separation_rows(contact: xr.Dataset) -> pd.DataFrame:
    return pd.DataFrame(
        {
            "panel": "a",
            "surface": str(contact.attrs["surface"]),
            "origin": "computed",
            "quantity": "force",
            "x": contact["separation"].values,
            "value": contact["force"].values,
            "unit": "N",
        }
    )


def _curve_rows(fit: xr.Dataset) -> list[pd.DataFrame]:
    """Return ratio (panel b) and mean force at the fitted work of adhesion (c) of each surface."""
    curves = [
        ("b", "ratio", bounded(fit, "ratio"), "1"),
        ("c", "mean_force", bounded(fit, "mean_force") * fit["work_of_adhesion"].item(), "N"),
    ]
    return [
        pd.DataFrame(
            {
                "panel": panel,
                "surface": str(surface),
                "origin": "computed",
                "quantity": quantity,
                "unit": unit,
                "x": fit["rho"].values,
                **{name: values[name].sel(surface=surface).values for name in values},
            }
        )
        for panel, quantity, values, unit in curves
        for surface in fit["surface"].values
    ]


def _published(fit: xr.Dataset, published_pull_off: pd.DataFrame) -> pd.DataFrame:
    """Return published mean and median (N) by surface, and the ratio of means."""
    forces = published_pull_off.reindex(fit["surface"].values)
    mean = forces["mean_force"]
    return forces.assign(ratio=mean / mean[_reference(fit)])


def _published_rows(fit: xr.Dataset, published_pull_off: pd.DataFrame) -> list[pd.DataFrame]:
    published = _published(fit, published_pull_off)
    return [
        pd.DataFrame(
            {
                "panel": panel,
                "surface": published.index.astype(str),
                "origin": "published",
                "quantity": quantity,
                "value": published[quantity].values,
                "unit": unit,
            }
        )
        for panel, quantity, unit in (
            ("b", "ratio", "1"),
            ("c", "mean_force", "N"),
            ("c", "median_force", "N"),
        )
    ]


def _range_from_ratios(fit: xr.Dataset) -> dict[str, str | float]:
    return {
        "panel": "b",
        "origin": "computed",
        "quantity": "range_from_ratios",
        "unit": "nm",
        **value_and_bounds(fit, "range_from_ratios"),
    }


def _draw_pressure(axes: Axes, contact: xr.Dataset) -> None:
    """Map the adhesive pressure (MPa) around the apex, over its largest PRESSURE_DECADES."""
    pressure = abs(contact["adhesive_pressure"]) / MEGAPASCAL
    top = pressure.max().item()
    bottom = top / 10**PRESSURE_DECADES
    x, y = contact["x"].values / 1000, contact["y"].values / 1000
    image = axes.pcolormesh(
        x,
        y,
        pressure.clip(min=bottom).values,
        norm=LogNorm(bottom, top),
        cmap="magma",
        shading="nearest",
        rasterized=True,
    )
    reach = _reach(pressure, bottom) / 1000
    axes.set(xlim=(-reach, reach), ylim=(-reach, reach), xlabel="x (µm)", ylabel="y (µm)")
    axes.set_aspect("equal")
    axes.locator_params(nbins=4)
    axes.figure.colorbar(image, ax=axes, pad=0.02, shrink=0.8, label="adhesive pressure (MPa)")
    style.label_panel(axes, "a", str(contact.attrs["label"]))


def _reach(pressure: xr.DataArray, bottom: float) -> float:
    """Return the half width (nm) of the square about the apex that holds all pressure > bottom."""
    farthest = (abs(pressure[along]).where(pressure > bottom).max().item() for along in "xy")
    return 1.05 * float(max(farthest))


def _draw_separation(axes: Axes, contact: xr.Dataset) -> None:
    axes.axhline(0, color="0.7", lw=0.6)
    axes.plot(contact["separation"], contact["force"] / MICRONEWTON, color=style.PUBLISHED)
    axes.set(xlabel="separation (nm)", ylabel="force (µN)")
    axes.locator_params(nbins=5)


def _draw_ratios(axes: Axes, fit: xr.Dataset, published_pull_off: pd.DataFrame) -> None:
    """Draw the ratio of mean forces to the reference surface against rho (nm)."""
    reference = _reference(fit)
    _draw_curves(axes, fit, bounded(fit, "ratio"), skipped=reference)
    ratios = _published(fit, published_pull_off)["ratio"]
    _draw_levels(axes, ratios.drop(reference), fit, "-")
    best = value_and_bounds(fit, "range_from_ratios")
    if np.isfinite([best["low"], best["high"]]).all():
        axes.axvspan(best["low"], best["high"], color="0.88", zorder=0)
    axes.axvline(best["value"], color="0.4", lw=0.8, ls="--")
    label = fit["label"].sel(surface=reference).item()
    axes.set(xscale="log", yscale="log", xlabel="range of adhesion ρ (nm)")
    axes.set_ylabel(f"force / that of {label}")
    style.label_logarithmic(axes.xaxis)
    style.label_panel(axes, "b")


def _draw_forces(axes: Axes, fit: xr.Dataset, published_pull_off: pd.DataFrame) -> None:
    """Draw the mean force (µN) at the fitted work of adhesion against rho (nm)."""
    work = fit["work_of_adhesion"].item()
    _draw_curves(axes, fit, bounded(fit, "mean_force") * (work / MICRONEWTON))
    published = _published(fit, published_pull_off) / MICRONEWTON
    _draw_levels(axes, published["mean_force"], fit, "-")
    _draw_levels(axes, published["median_force"], fit, ":")
    axes.axvline(fit["range_of_adhesion"].item(), color="0.4", lw=0.8, ls="-.")
    axes.set(xscale="log", yscale="log", xlabel="range of adhesion ρ (nm)")
    axes.set_ylabel("pull-off force (µN)")
    style.label_logarithmic(axes.xaxis)
    style.label_panel(axes, "c", rf"at $W$ = {work / MILLIJOULE:.3g} mJ/m²")


def _draw_curves(axes: Axes, fit: xr.Dataset, curves: xr.Dataset, skipped: str = "") -> None:
    """Draw value and band against rho of each surface but the skipped one."""
    for surface, look in style.looks(fit["surface"].values).items():
        if surface != skipped:
            style.draw_over_range(axes, curves.sel(surface=surface), band=0.2, **look)


def _draw_levels(axes: Axes, levels: pd.Series, fit: xr.Dataset, dashes: str) -> None:
    """Draw a horizontal line for each surface with a published value."""
    colours = style.colours(fit["surface"].values)
    for surface, level in levels.dropna().items():
        axes.axhline(level, color=colours[str(surface)], lw=0.9, ls=dashes)


def _legend_handles(fit: xr.Dataset) -> list[Line2D | Patch]:
    """Return one entry a surface and one for each kind of line of panels b and c."""
    confidence = style.print_share(fit.attrs["confidence"])
    return [
        *style.surface_handles(fit),
        Line2D([], [], color="0.3", lw=0.9, label="published mean"),
        Line2D([], [], color="0.3", lw=0.9, ls=":", label="published median"),
        Patch(color="0.3", alpha=0.25, lw=0, label=f"{confidence} bootstrap interval"),
        Line2D([], [], color="0.4", lw=0.8, ls="--", label="ρ from the ratios (b)"),
        Line2D([], [], color="0.4", lw=0.8, ls="-.", label="ρ of the best fit (c)"),
    ]
