"""The error map of Fig. 4: mean relative error by range and work of adhesion."""

from typing import Any

import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm

from hardcontact.figures import style
from hardcontact.figures.tables import published_value, value_and_bounds

__all__ = ["draw_error_map", "error_map_rows"]

PANEL = "d"
UNITS = {"range_of_adhesion": "nm", "work_of_adhesion": "J/m2"}
MILLIJOULE = 1e-3
BEST = "#D55E00"  # best fit and its region, against the blues and yellows of the error map


def error_map_rows(fit: xr.Dataset, published_constants: pd.DataFrame) -> pd.DataFrame:
    """Return the marks in the map: fitted and published values, region, bootstrap samples.

    Parameters
    ----------
    fit, published_constants : xarray.Dataset, pandas.DataFrame
        As `draw_error_map` takes them.

    Returns
    -------
    pandas.DataFrame
        One row a value with `low` and `high`, or a bootstrap sample; ranges in nm, works in J/m2.
    """
    rows = [
        *_fit_rows(fit),
        *_published_rows(published_constants),
        *_region_rows(fit),
        {"origin": "computed", "quantity": "best_error", "unit": "1"}
        | {"value": fit["best_error"].item()},
    ]
    samples = pd.DataFrame(
        {
            "origin": "computed",
            "quantity": "bootstrap_work_of_adhesion",
            "x": fit["bootstrap_range"].values,
            "value": fit["bootstrap_work"].values,
            "unit": "J/m2",
        }
    )
    return pd.concat([pd.DataFrame(rows), samples], ignore_index=True).assign(panel=PANEL)


def draw_error_map(axes: Axes, fit: xr.Dataset, published_constants: pd.DataFrame) -> None:
    """Map the mean relative error over rho (nm) and W (mJ/m2), and mark fit and published values.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
        Where to draw.
    fit : xarray.Dataset
        The part of inference.nc with one contact model.
    published_constants : pandas.DataFrame
        With range (nm) and work of adhesion (J/m2) and their uncertainties.
    """
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
    _draw_published(axes, published_constants)
    axes.set(xscale="log", yscale="log", xlabel="range of adhesion ρ (nm)")
    axes.set(ylabel="work of adhesion $W$ (mJ/m²)")
    published = published_constants["value"]
    axes.set_xlim(_view(fit["rho_fine"], fit["bootstrap_range"], published["range_of_adhesion"]))
    low, high = _view(fit["work"], fit["bootstrap_work"], published["work_of_adhesion"])
    axes.set_ylim(low / MILLIJOULE, high / MILLIJOULE)
    style.label_logarithmic(axes.xaxis)
    style.label_logarithmic(axes.yaxis)
    bar = axes.figure.colorbar(image, ax=axes, label="mean relative error", pad=0.02, extend="max")
    style.label_logarithmic(bar.ax.yaxis)
    style.label_panel(axes, PANEL, f"smallest error {fit['best_error'].item():.2g}")
    axes.legend(loc="lower left", frameon=True, facecolor="0.7", framealpha=0.9)


def _fit_rows(fit: xr.Dataset) -> list[dict[str, Any]]:
    return [
        {"origin": "computed", "quantity": name, "unit": unit, **value_and_bounds(fit, name)}
        for name, unit in UNITS.items()
    ]


def _published_rows(published_constants: pd.DataFrame) -> list[dict[str, Any]]:
    return [
        {"origin": "published", "quantity": name, "unit": unit}
        | published_value(published_constants, name)
        for name, unit in UNITS.items()
    ]


def _region_rows(fit: xr.Dataset) -> list[dict[str, Any]]:
    """Return the ranges and works of adhesion between which the error is below the threshold."""
    rows = []
    for name, unit in (("range", "nm"), ("work", "J/m2")):
        ends = dict(zip(("low", "high"), fit[f"region_{name}"].values.tolist(), strict=True))
        named = {"origin": "computed", "quantity": f"error_region_{name}", "unit": unit}
        rows.append({**named, **ends})
    return rows


def _view(grid: xr.DataArray, samples: xr.DataArray, published: float) -> tuple[float, float]:
    """Return limits, inside the grid, that show the published value and the bootstrap samples."""
    shown = [*samples.quantile([0.01, 0.99]).values, published]
    margin = 1.6
    return (
        max(grid.min().item(), min(shown) / margin),
        min(grid.max().item(), max(shown) * margin),
    )


def _draw_fits(axes: Axes, fit: xr.Dataset) -> None:
    """Mark bootstrap samples and best fit in the map."""
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


def _draw_published(axes: Axes, published_constants: pd.DataFrame) -> None:
    """Mark the published range and work of adhesion in the map."""
    of_range = published_constants.loc["range_of_adhesion"]
    work = published_constants.loc["work_of_adhesion"]
    axes.errorbar(
        of_range["value"],
        work["value"] / MILLIJOULE,
        xerr=of_range["uncertainty"],
        yerr=work["uncertainty"] / MILLIJOULE,
        fmt="o",
        color="black",
        mec="white",
        mew=0.5,
        ms=4,
        lw=1.2,
        label="published",
    )
