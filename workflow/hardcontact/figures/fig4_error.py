"""Panels d and e of Fig. 4: mean relative error against the range, and the work, of adhesion."""

from typing import Any

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm

from hardcontact.figures import marks, style, tables
from hardcontact.numbers.printing import print_formatted

UNITS = {"range_of_adhesion": "nm", "work_of_adhesion": "J/m2"}
MINIMUM_UNITS = {"range": "nm", "work": "J/m2", "error": "1"}
FAIR = 0.7  # the map shows the works of adhesion whose error gets below this somewhere
ON_MAP: dict[str, Any] = {"frameon": True, "facecolor": "0.6", "framealpha": 0.9}
MODELS: dict[str, dict[str, Any]] = {
    "plastic": {"color": "black", "ls": "-"},
    "rigid": {"color": "0.45", "ls": "--"},
}


def error_rows(
    inference: xr.Dataset, sets: xr.Dataset, model: str, published_constants: pd.DataFrame
) -> pd.DataFrame:
    """Return what panels d and e show but for the map itself, ranges in nm and works in J/m2.

    `x` is the range of adhesion (nm) that `value` belongs to.
    """
    fit = inference.sel(contact_model=model)
    fine = inference["error_of_range"]
    curves = [
        _rows("d", f"least_error_{name}", fine["rho_fine"], fine.sel(contact_model=name), "1")
        for name in _models(inference)
    ]
    of_sets = sets.sel(contact_model=model)
    clouds = [
        _rows("d", "best_error_of_set", of_sets["range_of_adhesion"], of_sets["best_error"], "1"),
        _rows("e", "sampled_work", fit["sampled_range"], fit["sampled_work"], "J/m2"),
    ]
    numbers = [*_minimum_rows(fit), *_fit_rows(fit), *_region_rows(fit)]
    computed = pd.concat([*curves, *clouds, pd.DataFrame(numbers)]).assign(origin="computed")
    published = tables.published_rows(published_constants, UNITS, "e")
    return pd.concat([computed, published], ignore_index=True)


def draw_least_error(axes: Axes, inference: xr.Dataset, sets: xr.Dataset, model: str) -> None:
    """Draw the error, least over W, against rho (nm), and the best fit of each set."""
    fit, of_sets = inference.sel(contact_model=model), sets.sel(contact_model=model)
    threshold = inference.attrs["error_threshold"]
    axes.plot(
        of_sets["range_of_adhesion"],
        of_sets["best_error"],
        ".",
        color="0.6",
        ms=4,
        mew=0,
        alpha=0.8,
        label="best fit of a set",
    )
    for name in _models(inference):
        curve = inference["error_of_range"].sel(contact_model=name)
        axes.plot(curve["rho_fine"], curve, lw=1.2, label=f"{name} contact", **MODELS[name])
    best = tables.value_and_bounds(fit, "best_error")
    axes.plot([fit["range_of_adhesion"]] * 2, [best["low"], best["high"]], color="black", lw=1.0)
    marks.draw_fit(axes, fit, "error")
    axes.axhline(threshold, color="0.6", lw=0.8, zorder=0)
    axes.text(
        0.02,
        threshold,
        f"paper: below {threshold:g}",
        transform=axes.get_yaxis_transform(),
        fontsize=7,
        color="0.35",
        va="bottom",
    )
    axes.set(xscale="log", yscale="log", ylabel="mean relative error, least over $W$")
    errors = [*of_sets["best_error"].values, best["low"], fit["best_error"].item(), threshold]
    axes.set_ylim(bottom=np.nanmin(errors) / 5)  # leaves room for the legend
    style.label_logarithmic(axes.yaxis, at=(1, 2, 5))
    axes.legend(loc="lower left", ncols=2, frameon=True, framealpha=1, edgecolor="white")
    over = " over scans" if np.isfinite(best["low"]) else ""
    style.label_panel(axes, "d", f"smallest error {print_formatted(best, '.2g')}{over}")


def draw_error_map(axes: Axes, fit: xr.Dataset, published_constants: pd.DataFrame) -> None:
    """Map the mean relative error over rho (nm) and W (mJ/m2), with fit and published values."""
    error = fit["mean_relative_error"].transpose("work", "rho_fine")
    rho, work = fit["rho_fine"].values, fit["work"].values / marks.MILLIJOULE
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
        axes.contour(rho, work, error.values, levels=[threshold], colors="white", linewidths=1.0)
        axes.plot([], [], color="white", lw=1.0, label=f"error < {threshold:g}")
    axes.plot([], [], "o", color="white", ms=2.5, label="samples of the scans")
    axes.plot(
        fit["sampled_range"],
        fit["sampled_work"] / marks.MILLIJOULE,
        ".",
        color="white",
        ms=2,
        alpha=0.6,
        mew=0,
        rasterized=True,
    )
    marks.draw_published_fit(axes, published_constants)
    axes.legend(loc="lower left", **ON_MAP)  # panel d names the marks of the fit
    marks.draw_fit(axes, fit, "work", marks.MILLIJOULE)
    axes.set(xscale="log", yscale="log", ylabel="work of adhesion $W$ (mJ/m²)")
    fair = work[error.min("rho_fine").values < FAIR]
    shown = [*fair, published_constants["value"]["work_of_adhesion"] / marks.MILLIJOULE]
    axes.set_ylim(max(work[0], min(shown) / 1.5), min(work[-1], max(shown) * 1.5))
    style.label_logarithmic(axes.yaxis, at=(1,))
    bar = axes.figure.colorbar(image, ax=axes, label="mean relative error", pad=0.02, extend="max")
    style.label_logarithmic(bar.ax.yaxis)
    style.label_panel(axes, "e")


def _models(inference: xr.Dataset) -> list[str]:
    """Return the contact models drawn, those computed of MODELS."""
    return [name for name in MODELS if name in inference["contact_model"]]


def _rows(
    panel: str, quantity: str, ranges: xr.DataArray, values: xr.DataArray, unit: str
) -> pd.DataFrame:
    """Return one row a sample, a set or a point of a curve."""
    rows = pd.DataFrame({"x": ranges.values, "value": values.values})
    return rows.assign(panel=panel, quantity=quantity, unit=unit)


def _minimum_rows(fit: xr.Dataset) -> list[dict[str, Any]]:
    """Return range, work and error of each minimum that there is."""
    known = fit.dropna("minimum", subset=["minimum_range"])
    return [
        {
            "panel": "e" if name == "work" else "d",
            "quantity": f"minimum_{name}",
            "x": known["minimum_range"].values[place],
            "value": known[f"minimum_{name}"].values[place],
            "unit": unit,
        }
        for place in range(known.sizes["minimum"])
        for name, unit in MINIMUM_UNITS.items()
    ]


def _fit_rows(fit: xr.Dataset) -> list[dict[str, Any]]:
    rows = [
        {"panel": "e", "quantity": name, "unit": unit, **tables.value_and_bounds(fit, name)}
        for name, unit in UNITS.items()
    ]
    error = {"panel": "d", "quantity": "best_error", "unit": "1"}
    return [*rows, {**error, **tables.value_and_bounds(fit, "best_error")}]


def _region_rows(fit: xr.Dataset) -> list[dict[str, Any]]:
    """Return the ranges and works of adhesion between which the error is below the threshold."""
    rows = []
    for name, unit in (("range", "nm"), ("work", "J/m2")):
        ends = dict(zip(("low", "high"), fit[f"region_{name}"].values.tolist(), strict=True))
        rows.append({"panel": "e", "quantity": f"error_region_{name}", "unit": unit, **ends})
    return rows
