"""Fig. 3: how the pull-off forces are distributed, published and computed."""

from string import ascii_lowercase

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from hardcontact.adhesion.force_curves import at_range
from hardcontact.figures import style
from hardcontact.figures.fig3_histograms import (
    AT_FIT,
    AT_PUBLISHED,
    COMPUTED_LINE,
    PUBLISHED_LINE,
    Fit,
    Pairs,
    density,
    draw_linear,
    draw_logarithmic,
    linear_edges,
    logarithmic_edges,
    lognormal_density,
)
from hardcontact.figures.marks import MILLIJOULE
from hardcontact.figures.tables import VALUE_COLUMNS, label_surfaces, value_and_bounds
from hardcontact.numbers.statistics import lognormal_shape

__all__ = ["draw", "table"]

CONTACT_MODEL = "plastic"  # the one the paper's conclusions rest on
COLUMNS = [
    "surface", "label", "basis", "origin", "pair", "quantity", "panel", "force_low", "force_high",
    *VALUE_COLUMNS,
]  # fmt: skip


def table(
    adhesion: xr.Dataset,
    inference: xr.Dataset,
    published_constants: pd.DataFrame,
    published_pull_off: pd.DataFrame,
) -> pd.DataFrame:
    """Return the histograms of computed forces and the log-normals, published and computed.

    One row a bin, its edges `force_low` and `force_high` in N and its probability density in 1/N
    (bins of the linear panels "1", of the logarithmic panels "2"); one row a log-normal shape (1),
    median (N), mean (N) and fraction below the force floor, with the interval over scans. `pair` is
    that of range and work of adhesion, "published" or "fitted".
    """
    fit = inference.sel(contact_model=CONTACT_MODEL)
    forces = _forces_at_pairs(adhesion, fit, published_constants)
    published = _published(inference, published_pull_off)
    frames = []
    for surface in map(str, inference["surface"].values):
        of_pairs = {pair: forces[pair][surface] for pair in forces}
        of_surface = (
            _histogram_rows(of_pairs, _fit(published[surface])),
            _published_rows(published[surface]),
            *(_computed_rows(fit.sel(surface=surface, pair=pair)) for pair in forces),
        )
        frames.append(pd.concat(of_surface).assign(surface=surface))
    return label_surfaces(pd.concat(frames, ignore_index=True), inference)[COLUMNS]


@style.print_style()
def draw(
    adhesion: xr.Dataset,
    inference: xr.Dataset,
    published_constants: pd.DataFrame,
    published_pull_off: pd.DataFrame,
) -> Figure:
    """Draw Fig. 3: above on linear, below on logarithmic axes, one column a substrate.

    Forces are taken at the published pair of range and work of adhesion, and at the fitted one.
    """
    fit = inference.sel(contact_model=CONTACT_MODEL)
    surfaces = [str(name) for name in inference["surface"].values]
    colours, floor = style.colours(surfaces), inference.attrs["force_floor"]
    forces = _forces_at_pairs(adhesion, fit, published_constants)
    published = _published(inference, published_pull_off)
    figure = style.create(4.8)
    grid = figure.subplots(2, len(surfaces), squeeze=False)
    for letter, surface, (linear, logarithmic) in zip(
        ascii_lowercase, surfaces, grid.T, strict=False
    ):
        of_pairs = {pair: forces[pair][surface] for pair in forces}
        at_published = fit.sel(surface=surface, pair="published")
        fits = {"published": _fit(published[surface]), "computed": _fit(at_published)}
        draw_linear(linear, of_pairs, fits["published"], floor, colours[surface])
        draw_logarithmic(logarithmic, of_pairs, fits, floor, colours[surface])
        style.label_panel(linear, f"{letter}_1", str(at_published["label"].item()))
        style.label_panel(
            logarithmic, f"{letter}_2", _print_shapes(at_published, fits["published"])
        )
        logarithmic.set_xlabel("pull-off force (µN)")
    grid[0, 0].set_ylabel("probability density (1/µN)")
    grid[1, 0].set_ylabel("probability density (1/µN)")
    figure.legend(
        handles=_legend_handles(_pairs(fit, published_constants), floor),
        loc="outside upper center",
        ncols=3,
    )
    style.mark_basis(figure, inference)
    return figure


def _pairs(fit: xr.Dataset, published_constants: pd.DataFrame) -> dict[str, tuple[float, float]]:
    """Return range (nm) and work of adhesion (J/m2), as published and as fitted."""
    names = "range_of_adhesion", "work_of_adhesion"
    published_range, published_work = (float(published_constants["value"][name]) for name in names)
    fitted_range, fitted_work = (fit[name].item() for name in names)
    return {"published": (published_range, published_work), "fitted": (fitted_range, fitted_work)}


def _forces_at_pairs(
    adhesion: xr.Dataset, fit: xr.Dataset, published_constants: pd.DataFrame
) -> dict[str, dict[str, np.ndarray]]:
    """Return all computed forces (N) by pair and surface."""
    per_work = adhesion["pull_off_force"].sel(contact_model=CONTACT_MODEL)
    forces = {}
    for pair, (rho, work) in _pairs(fit, published_constants).items():
        scaled = at_range(per_work, rho) * work / adhesion.attrs["work_of_adhesion"]
        forces[pair] = {
            str(name): _finite(scaled.sel(surface=name)) for name in adhesion["surface"].values
        }
    return forces


def _finite(values: xr.DataArray) -> np.ndarray:
    """Return the values flat, without NaN where a surface has fewer scans than others."""
    flat: np.ndarray = values.values[np.isfinite(values.values)]
    return flat


def _published(inference: xr.Dataset, published_pull_off: pd.DataFrame) -> dict[str, pd.Series]:
    """Return published mean and median (N) by surface, with shape and median of a log-normal."""
    forces = published_pull_off.reindex(inference["surface"].values)
    shape = lognormal_shape(forces["mean_force"], forces["median_force"])
    forces = forces.assign(lognormal_shape=shape, lognormal_median=forces["median_force"])
    return {str(surface): numbers for surface, numbers in forces.iterrows()}


def _fit(numbers: pd.Series | xr.Dataset) -> Fit:
    """Return the log-normal among the published or the computed numbers of one surface."""
    return float(numbers["lognormal_shape"]), float(numbers["lognormal_median"])


def _histogram_rows(of_pairs: Pairs, published: Fit) -> pd.DataFrame:
    """Return the histograms of one surface, a row a bin, and the published log-normal."""
    linear, logarithmic = linear_edges(of_pairs, published), logarithmic_edges(of_pairs)
    shown = [("published", "1", "published", linear, lognormal_density(published, linear))]
    for pair, forces in of_pairs.items():
        shown.append(("computed", "1", pair, linear, density(forces, linear)))
        shown.append(("computed", "2", pair, logarithmic, density(forces, logarithmic)))
    return pd.concat(
        pd.DataFrame(
            {
                "panel": panel,
                "origin": origin,
                "pair": pair if origin == "computed" else "",
                "quantity": "probability_density",
                "unit": "1/N",
                "force_low": edges[:-1],
                "force_high": edges[1:],
                "value": densities,
            }
        )
        for origin, panel, pair, edges, densities in shown
    )


def _published_rows(published: pd.Series) -> pd.DataFrame:
    """Return the published numbers of one surface, one row each."""
    units = {
        "lognormal_shape": "1",
        "lognormal_median": "N",
        "mean_force": "N",
        "median_force": "N",
    }
    return pd.DataFrame(
        {
            "origin": "published",
            "pair": "",
            "quantity": name,
            "unit": unit,
            "value": published[name],
        }
        for name, unit in units.items()
    )


def _computed_rows(of_surface: xr.Dataset) -> pd.DataFrame:
    """Return the numbers that describe the forces of one surface at one pair, one row each."""
    quantities = {
        "lognormal_shape": ("lognormal_shape", "1"),
        "lognormal_median": ("lognormal_median", "N"),
        "mean_force": ("force_mean", "N"),
        "median_force": ("force_median", "N"),
        "censored_fraction": ("censored_fraction", "1"),
    }
    return pd.DataFrame(
        {
            "origin": "computed",
            "pair": str(of_surface["pair"].item()),
            "quantity": name,
            "unit": unit,
            **value_and_bounds(of_surface, variable),
        }
        for name, (variable, unit) in quantities.items()
    )


def _print_shapes(at_published: xr.Dataset, published: Fit) -> str:
    """Return the shape of both log-normals, the computed one with its interval."""
    computed = value_and_bounds(at_published, "lognormal_shape")
    here = style.print_interval(computed, ".2f")
    return f"published $s$ = {published[0]:.2f}\nhere {here}"


def _legend_handles(pairs: dict[str, tuple[float, float]], floor: float) -> list[Line2D | Patch]:
    """Return one entry for each kind of area and line, with the pairs of range and work."""
    printed = {
        pair: f"{pair} ρ = {rho:.3g} nm, $W$ = {work / MILLIJOULE:.3g} mJ/m²"
        for pair, (rho, work) in pairs.items()
    }
    return [
        Patch(label=f"computed, {printed['published']}", lw=0, **AT_PUBLISHED),
        Patch(label=f"computed, {printed['fitted']}", fill=False, **AT_FIT),
        Line2D([], [], label="published log-normal", **PUBLISHED_LINE),
        Line2D([], [], label="log-normal of the forces at the published pair", **COMPUTED_LINE),
        Patch(color="0.85", label=f"below {floor * 1e9:.0f} nN"),
    ]
