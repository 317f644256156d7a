"""Fig. 4: range and work of adhesion from the computed pull-off forces."""

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from hardcontact.figures import style

__all__ = ["draw", "table"]

CONTACT_MODEL = "plastic"  # the one the paper's conclusions rest on
MICRONEWTON = 1e-6
MEGAPASCAL = 1e6
MILLIJOULE = 1e-3
BEST = "#D55E00"  # best fit and its region, against the blues and yellows of the error map
PRESSURE_DECADES = 3  # below, the pressure adds nothing visible to the force


def table(contact: xr.Dataset, inference: xr.Dataset) -> pd.DataFrame:
    """Return the curves and fitted values of Fig. 4, one row a point.

    `x` is the separation (nm, panel a) or the range of adhesion rho (nm, b to d), `value` with its
    95 % bootstrap interval `low`, `high` in `unit`. The maps of panels a (adhesive pressure) and d
    (mean relative error) stay in contact.nc and inference.nc.
    """
    fit = inference.sel(contact_model=CONTACT_MODEL)
    frames = [_separation_rows(contact), *_curve_rows(fit), *_published_rows(fit), _fit_rows(fit)]
    rows = pd.concat([*frames, _bootstrap_rows(fit)], ignore_index=True)
    named = inference[["label", "basis"]].to_dataframe()[["label", "basis"]]
    return rows.join(named, on="surface")[
        [
            "panel",
            "surface",
            "label",
            "basis",
            "origin",
            "quantity",
            "x",
            "value",
            "low",
            "high",
            "unit",
        ]
    ]


@style.print_style()
def draw(contact: xr.Dataset, inference: xr.Dataset) -> Figure:
    """Draw Fig. 4: (a) one contact, (b) force ratios, (c) forces, (d) error of range and work.

    From `contact` the adhesive pressure (y, x) in Pa and the force (separation) in N; from
    `inference` everything else, its attrs published_range, published_range_uncertainty in nm and
    published_work, published_work_uncertainty in J/m2.
    """
    fit = inference.sel(contact_model=CONTACT_MODEL)
    figure = style.create(5.6)
    above, below = figure.add_gridspec(2, 1, height_ratios=(1, 1.2))
    pressure, separation, ratios = above.subgridspec(1, 3, width_ratios=(1.4, 0.8, 1.5)).subplots()
    forces, error = below.subgridspec(1, 2).subplots()
    _draw_pressure(pressure, contact)
    _draw_separation(separation, contact)
    _draw_ratios(ratios, fit)
    _draw_forces(forces, fit)
    _draw_error(error, fit)
    figure.legend(handles=_legend_handles(fit), loc="outside upper center", ncols=5)
    style.mark_basis(figure, inference)
    return figure


def _reference(fit: xr.Dataset) -> str:
    """Return the surface the ratios refer to: the one whose own ratio is 1 everywhere."""
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
        ("b", "ratio", _with_bounds(fit, "ratio"), "1"),
        ("c", "mean_force", _with_bounds(fit, "mean_force") * fit["work_of_adhesion"].item(), "N"),
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


def _with_bounds(fit: xr.Dataset, name: str) -> xr.Dataset:
    """Return a variable and its 95 % bounds under the names value, low, high."""
    names = {name: "value", f"{name}_low": "low", f"{name}_high": "high"}
    return fit[list(names)].rename(names)


def _published_rows(fit: xr.Dataset) -> list[pd.DataFrame]:
    quantities = [
        ("b", "ratio", "published_ratio", "1"),
        ("c", "mean_force", "published_mean_force", "N"),
        ("c", "median_force", "published_median_force", "N"),
    ]
    return [
        pd.DataFrame(
            {
                "panel": panel,
                "surface": fit["surface"].values.astype(str),
                "origin": "published",
                "quantity": quantity,
                "value": fit[name].values,
                "unit": unit,
            }
        )
        for panel, quantity, name, unit in quantities
    ]


def _fit_rows(fit: xr.Dataset) -> pd.DataFrame:
    """Return range and work of adhesion, computed with bootstrap bounds, published with +-."""
    rows = [
        {
            "panel": panel,
            "origin": "computed",
            "quantity": name,
            "unit": unit,
            "value": fit[name].item(),
            "low": fit[f"{name}_low"].item(),
            "high": fit[f"{name}_high"].item(),
        }
        for panel, name, unit in (
            ("b", "range_from_ratios", "nm"),
            ("d", "range_of_adhesion", "nm"),
            ("d", "work_of_adhesion", "J/m2"),
        )
    ]
    for name, attribute, unit in (
        ("range_of_adhesion", "published_range", "nm"),
        ("work_of_adhesion", "published_work", "J/m2"),
    ):
        value, spread = fit.attrs[attribute], fit.attrs[f"{attribute}_uncertainty"]
        rows.append(
            {
                "panel": "d",
                "origin": "published",
                "quantity": name,
                "unit": unit,
                "value": value,
                "low": value - spread,
                "high": value + spread,
            }
        )
    rows += [
        {
            "panel": "d",
            "origin": "computed",
            "quantity": f"error_region_{name}",
            "unit": unit,
            "low": fit[f"region_{name}_low"].item(),
            "high": fit[f"region_{name}_high"].item(),
        }
        for name, unit in (("range", "nm"), ("work", "J/m2"))
    ]
    best = {"panel": "d", "origin": "computed", "quantity": "best_error", "unit": "1"}
    return pd.DataFrame([*rows, {**best, "value": fit["best_error"].item()}])


def _bootstrap_rows(fit: xr.Dataset) -> pd.DataFrame:
    return pd.DataFrame(
        {
            "panel": "d",
            "origin": "computed",
            "quantity": "bootstrap_work_of_adhesion",
            "x": fit["bootstrap_range"].values,
            "value": fit["bootstrap_work"].values,
            "unit": "J/m2",
        }
    )


def _draw_pressure(axes: Axes, contact: xr.Dataset) -> None:
    """Map the adhesive pressure (Pa) around the apex, as far as it is worth seeing."""
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
    largest = np.maximum(abs(pressure["x"]), abs(pressure["y"]))
    return 1.05 * largest.where(pressure > bottom).max().item()


def _draw_separation(axes: Axes, contact: xr.Dataset) -> None:
    axes.axhline(0, color="0.7", lw=0.6)
    axes.plot(contact["separation"], contact["force"] / MICRONEWTON, color=style.PUBLISHED)
    axes.set(xlabel="separation (nm)", ylabel="force (µN)")
    axes.locator_params(nbins=5)


def _draw_ratios(axes: Axes, fit: xr.Dataset) -> None:
    """Draw the ratio of mean forces to the reference surface against rho (nm)."""
    reference = _reference(fit)
    _draw_curves(axes, fit, _with_bounds(fit, "ratio"), skipped=reference)
    _draw_levels(axes, fit, fit["published_ratio"], "-", skipped=reference)
    low, high = fit["range_from_ratios_low"].item(), fit["range_from_ratios_high"].item()
    if np.isfinite([low, high]).all():
        axes.axvspan(low, high, color="0.88", zorder=0)
    axes.axvline(fit["range_from_ratios"].item(), color="0.4", lw=0.8, ls="--")
    label = fit["label"].sel(surface=reference).item()
    axes.set(xscale="log", yscale="log", xlabel="range of adhesion ρ (nm)")
    axes.set_ylabel(f"force / that of {label}")
    style.label_logarithmic(axes.xaxis)
    style.label_panel(axes, "b")


def _draw_forces(axes: Axes, fit: xr.Dataset) -> None:
    """Draw the mean force (µN) at the fitted work of adhesion against rho (nm)."""
    work = fit["work_of_adhesion"].item()
    _draw_curves(axes, fit, _with_bounds(fit, "mean_force") * (work / MICRONEWTON))
    _draw_levels(axes, fit, fit["published_mean_force"] / MICRONEWTON, "-")
    _draw_levels(axes, fit, fit["published_median_force"] / MICRONEWTON, ":")
    axes.axvline(fit["range_of_adhesion"].item(), color="0.4", lw=0.8, ls="-.")
    axes.set(xscale="log", yscale="log", xlabel="range of adhesion ρ (nm)")
    axes.set_ylabel("pull-off force (µN)")
    style.label_logarithmic(axes.xaxis)
    style.label_panel(axes, "c", rf"at $W$ = {work / MILLIJOULE:.3g} mJ/m²")


def _draw_curves(axes: Axes, fit: xr.Dataset, curves: xr.Dataset, skipped: str = "") -> None:
    """Draw value and band against rho of each surface, the skipped one left out."""
    surfaces = fit["surface"].values
    colours, markers = style.colours(surfaces), style.markers(surfaces)
    for surface in map(str, surfaces):
        if surface == skipped:
            continue
        curve, colour = curves.sel(surface=surface), colours[surface]
        axes.fill_between(fit["rho"], curve["low"], curve["high"], color=colour, alpha=0.2, lw=0)
        axes.plot(fit["rho"], curve["value"], color=colour, marker=markers[surface])


def _draw_levels(
    axes: Axes, fit: xr.Dataset, levels: xr.DataArray, dashes: str, skipped: str = ""
) -> None:
    """Draw a horizontal line for each surface with a published value."""
    for surface, colour in style.colours(fit["surface"].values).items():
        level = levels.sel(surface=surface).item()
        if surface != skipped and np.isfinite(level):
            axes.axhline(level, color=colour, lw=0.9, ls=dashes)


def _draw_error(axes: Axes, fit: xr.Dataset) -> None:
    """Map the mean relative error over rho (nm) and W (mJ/m2), with what was fitted on it."""
    error = fit["mean_relative_error"].transpose("work", "rho_fine")
    rho, work = fit["rho_fine"].values, fit["work"].values / MILLIJOULE
    image = axes.pcolormesh(
        rho,
        work,
        error.values,
        norm=LogNorm(vmax=max(1.0, 3 * error.min().item())),
        cmap="cividis",
        shading="nearest",
        rasterized=True,
    )
    threshold = fit.attrs["error_threshold"]
    if (error < threshold).any():
        axes.contour(rho, work, error.values, levels=[threshold], colors=BEST, linewidths=1.0)
        axes.plot([], [], color=BEST, lw=1.0, label=f"error < {threshold:g}")
    _draw_fits(axes, fit)
    axes.set(xscale="log", yscale="log", xlabel="range of adhesion ρ (nm)")
    axes.set(ylabel="work of adhesion $W$ (mJ/m²)")
    axes.set_xlim(_view(fit["rho_fine"], fit["bootstrap_range"], fit.attrs["published_range"]))
    low, high = _view(fit["work"], fit["bootstrap_work"], fit.attrs["published_work"])
    axes.set_ylim(low / MILLIJOULE, high / MILLIJOULE)
    style.label_logarithmic(axes.xaxis)
    style.label_logarithmic(axes.yaxis)
    bar = axes.figure.colorbar(image, ax=axes, label="mean relative error", pad=0.02, extend="max")
    style.label_logarithmic(bar.ax.yaxis)
    style.label_panel(axes, "d", f"smallest error {fit['best_error'].item():.2g}")
    axes.legend(loc="lower left", frameon=True, facecolor="0.7", framealpha=0.9)


def _view(grid: xr.DataArray, samples: xr.DataArray, published: float) -> tuple[float, float]:
    """Return limits, inside the grid, that show the published value and the bootstrap samples."""
    shown = [*samples.quantile([0.01, 0.99]).values, published]
    margin = 1.6
    return (
        max(grid.min().item(), min(shown) / margin),
        min(grid.max().item(), max(shown) * margin),
    )


def _draw_fits(axes: Axes, fit: xr.Dataset) -> None:
    """Mark bootstrap cloud, best fit and published values in the map of panel d."""
    axes.plot(
        fit["bootstrap_range"],
        fit["bootstrap_work"] / MILLIJOULE,
        ".",
        color="white",
        ms=2,
        alpha=0.6,
        mew=0,
        rasterized=True,
    )
    axes.plot([], [], "o", color="white", ms=2.5, label="bootstrap")
    axes.plot(
        fit["range_of_adhesion"],
        fit["work_of_adhesion"] / MILLIJOULE,
        "*",
        color=BEST,
        mec="white",
        mew=0.5,
        ms=9,
        ls="none",
        label="best fit",
    )
    axes.errorbar(
        fit.attrs["published_range"],
        fit.attrs["published_work"] / MILLIJOULE,
        xerr=fit.attrs["published_range_uncertainty"],
        yerr=fit.attrs["published_work_uncertainty"] / MILLIJOULE,
        fmt="o",
        color="black",
        mec="white",
        mew=0.5,
        ms=4,
        lw=1.2,
        label="published",
    )


def _legend_handles(fit: xr.Dataset) -> list:
    """Return one entry a surface and one for each kind of line of panels b and c."""
    surfaces = fit["surface"].values
    colours, markers = style.colours(surfaces), style.markers(surfaces)
    of_surfaces = [
        Line2D(
            [],
            [],
            color=colours[name],
            marker=markers[name],
            label=str(fit["label"].sel(surface=name).item()),
        )
        for name in map(str, surfaces)
    ]
    return [
        *of_surfaces,
        Line2D([], [], color="0.3", lw=0.9, label="published mean"),
        Line2D([], [], color="0.3", lw=0.9, ls=":", label="published median"),
        Patch(color="0.3", alpha=0.25, lw=0, label="95 % bootstrap interval"),
        Line2D([], [], color="0.4", lw=0.8, ls="--", label="ρ from the ratios (b)"),
        Line2D([], [], color="0.4", lw=0.8, ls="-.", label="ρ of the best fit (c)"),
    ]
