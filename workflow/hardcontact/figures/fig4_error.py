"""Panels d and e of Fig. 4: mean relative error against the range, and the work, of adhesion."""

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm

from hardcontact.figures import style, tables
from hardcontact.numbers.printing import print_formatted

UNITS = {"range_of_adhesion": "nm", "work_of_adhesion": "J/m2"}
MINIMA = {"range": ("d", "nm"), "work": ("e", "J/m2"), "error": ("d", "1")}  # panel, unit
FAIR = 0.7  # the map shows the works of adhesion whose error gets below this somewhere
ON_MAP: style.Look = {"frameon": True, "facecolor": "0.6", "framealpha": 0.9}
MODELS: dict[str, style.Look] = {
    "plastic": {"color": "black", "ls": "-"},
    "rigid": {"color": "0.45", "ls": "--"},
}


def error_rows(
    inference: xr.Dataset, sets: xr.Dataset, model: str, published_constants: pd.DataFrame
) -> pd.DataFrame:
    """Return what panels d and e show but for the map itself, ranges in nm and works in J/m2.

    `x` is the range of adhesion (nm) that `value` belongs to.
    """
    fit, of_sets = inference.sel(contact_model=model), sets.sel(contact_model=model)
    error, known = inference["error_of_range"], fit.dropna("minimum", subset=["minimum_range"])
    samples = {"x": fit["sampled_range"], "value": fit["sampled_work"]}
    best_of_sets = {"x": of_sets["range_of_adhesion"], "value": of_sets["best_error"]}
    shown = [
        *(
            ("d", f"least_error_{name}", "1", {"x": error["rho_fine"], "value": of_model})
            for name in _models(inference)
            for of_model in [error.sel(contact_model=name)]
        ),
        ("d", "best_error_of_set", "1", best_of_sets),
        ("e", "sampled_work", "J/m2", samples),
        *(
            (panel, f"minimum_{name}", unit, {"x": rho, "value": known[f"minimum_{name}"][place]})
            for place, rho in enumerate(known["minimum_range"])
            for name, (panel, unit) in MINIMA.items()
        ),
        *(("e", name, unit, tables.value_and_bounds(fit, name)) for name, unit in UNITS.items()),
        ("d", "best_error", "1", tables.value_and_bounds(fit, "best_error")),
        *(
            ("e", f"error_region_{name}", MINIMA[name][1], {"low": low, "high": high})
            for name in ("range", "work")
            for low, high in [fit[f"region_{name}"].values]
        ),
    ]
    computed = [
        pd.DataFrame({end: np.atleast_1d(numbers) for end, numbers in values.items()}).assign(
            panel=panel, origin="computed", quantity=quantity, unit=unit
        )
        for panel, quantity, unit, values in shown
    ]
    rows = pd.concat([*computed, tables.published_rows(published_constants, UNITS, "e")])
    return rows.dropna(subset=["value", "low", "high"], how="all")


def draw_least_error(axes: Axes, inference: xr.Dataset, sets: xr.Dataset, model: str) -> None:
    """Draw the error, least over W, against rho (nm), and the best fit of each set."""
    fit, of_sets = inference.sel(contact_model=model), sets.sel(contact_model=model)
    threshold = inference.attrs["error_threshold"]
    of_set: style.Look = {"color": "0.6", "ms": 4, "mew": 0, "alpha": 0.8}
    best_fits = of_sets["range_of_adhesion"], of_sets["best_error"]
    axes.plot(*best_fits, ".", label="best fit of a set", **of_set)
    for name in _models(inference):
        curve = inference["error_of_range"].sel(contact_model=name)
        axes.plot(curve["rho_fine"], curve, lw=1.2, label=f"{name} contact", **MODELS[name])
    best = tables.value_and_bounds(fit, "best_error")
    axes.plot([fit["range_of_adhesion"]] * 2, [best["low"], best["high"]], color="black", lw=1.0)
    style.draw_fit(axes, fit, "error")
    axes.axhline(threshold, color="0.6", lw=0.8, zorder=0)
    text, place = f"paper: below {threshold:g}", axes.get_yaxis_transform()
    axes.text(0.02, threshold, text, transform=place, va="bottom", **style.NOTE)
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
    rho, work = fit["rho_fine"].values, fit["work"].values / style.MILLIJOULE
    norm = LogNorm(vmax=max(1.0, 3 * error.min().item()))
    image = axes.pcolormesh(rho, work, error.values, norm=norm, cmap="cividis", **style.PIXELS)
    threshold = fit.attrs["error_threshold"]
    if (error < threshold).any():
        axes.contour(rho, work, error.values, levels=[threshold], colors="white", linewidths=1.0)
        axes.plot([], [], color="white", lw=1.0, label=f"error < {threshold:g}")
    axes.plot([], [], "o", color="white", ms=2.5, label="samples of the scans")
    samples = fit["sampled_range"], fit["sampled_work"] / style.MILLIJOULE
    axes.plot(*samples, ".", color="white", ms=2, alpha=0.6, mew=0, rasterized=True)
    style.draw_published_fit(axes, published_constants)
    axes.legend(loc="lower left", **ON_MAP)  # panel d names the marks of the fit
    style.draw_fit(axes, fit, "work", style.MILLIJOULE)
    axes.set(xscale="log", yscale="log", ylabel="work of adhesion $W$ (mJ/m²)")
    fair = work[error.min("rho_fine").values < FAIR]
    shown = [*fair, published_constants["value"]["work_of_adhesion"] / style.MILLIJOULE]
    axes.set_ylim(max(work[0], min(shown) / 1.5), min(work[-1], max(shown) * 1.5))
    style.label_logarithmic(axes.yaxis, at=(1,))
    bar = axes.figure.colorbar(image, ax=axes, label="mean relative error", pad=0.02, extend="max")
    style.label_logarithmic(bar.ax.yaxis)
    style.label_panel(axes, "e")


def _models(inference: xr.Dataset) -> list[str]:
    """Return the contact models drawn, those computed of MODELS."""
    return [name for name in MODELS if name in inference["contact_model"]]
