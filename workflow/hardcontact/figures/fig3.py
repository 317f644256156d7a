"""Fig. 3: how the pull-off forces are distributed, published and computed."""

from string import ascii_lowercase
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from scipy.stats import lognorm

from hardcontact.adhesion.force_curves import at_range
from hardcontact.figures import marks, style, tables
from hardcontact.numbers.printing import print_formatted
from hardcontact.numbers.statistics import lognormal_shape

CONTACT_MODEL = "plastic"  # the one the paper's conclusions rest on
LINEAR_BINS = 24
BINS_PER_DECADE = 8
AT_PUBLISHED: dict[str, Any] = {"color": "0.4", "alpha": 0.55}
AT_FIT: dict[str, Any] = {"edgecolor": "0.2", "linewidth": 1.2}
PUBLISHED_LINE: dict[str, Any] = {"color": style.PUBLISHED, "lw": 1.0}
COMPUTED_LINE: dict[str, Any] = {"color": style.PUBLISHED, "lw": 1.0, "ls": "--"}
COLUMNS = [
    "surface", "label", "basis", "origin", "pair", "quantity", "panel", "force_low", "force_high",
    *tables.VALUE_COLUMNS,
]  # fmt: skip

Fit = tuple[float, float]  # shape and median (N) of a log-normal
Pairs = dict[str, np.ndarray]  # forces (N) of one surface by pair, "published" and "fitted"


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
    return tables.label_surfaces(pd.concat(frames, ignore_index=True), inference)[COLUMNS]


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
        _draw_linear(linear, of_pairs, fits["published"], floor, colours[surface])
        _draw_logarithmic(logarithmic, of_pairs, fits, floor, colours[surface])
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
        of_surfaces = {str(name): scaled.sel(surface=name) for name in adhesion["surface"].values}
        # A surface with fewer scans than others has NaN in place of theirs.
        forces[pair] = {
            name: values.values[np.isfinite(values.values)] for name, values in of_surfaces.items()
        }
    return forces


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
    linear, logarithmic = _linear_edges(of_pairs, published), _logarithmic_edges(of_pairs)
    shown = [("published", "1", "", linear, _lognormal_density(published, linear))]
    for pair, forces in of_pairs.items():
        shown.append(("computed", "1", pair, linear, _density(forces, linear)))
        shown.append(("computed", "2", pair, logarithmic, _density(forces, logarithmic)))
    rows = pd.concat(
        pd.DataFrame({"force_low": edges[:-1], "force_high": edges[1:], "value": values}).assign(
            origin=origin, panel=panel, pair=pair
        )
        for origin, panel, pair, edges, values in shown
    )
    return rows.assign(quantity="probability_density", unit="1/N")


def _published_rows(published: pd.Series) -> pd.DataFrame:
    """Return the published numbers of one surface, one row each."""
    units = {
        "lognormal_shape": "1",
        "lognormal_median": "N",
        "mean_force": "N",
        "median_force": "N",
    }
    rows = pd.DataFrame(
        {"quantity": name, "unit": unit, "value": published[name]} for name, unit in units.items()
    )
    return rows.assign(origin="published", pair="")


def _computed_rows(of_surface: xr.Dataset) -> pd.DataFrame:
    """Return the numbers that describe the forces of one surface at one pair, one row each."""
    quantities = {
        "lognormal_shape": ("lognormal_shape", "1"),
        "lognormal_median": ("lognormal_median", "N"),
        "mean_force": ("force_mean", "N"),
        "median_force": ("force_median", "N"),
        "censored_fraction": ("censored_fraction", "1"),
    }
    rows = pd.DataFrame(
        {"quantity": name, "unit": unit, **tables.value_and_bounds(of_surface, variable)}
        for name, (variable, unit) in quantities.items()
    )
    return rows.assign(origin="computed", pair=str(of_surface["pair"].item()))


def _print_shapes(at_published: xr.Dataset, published: Fit) -> str:
    """Return the shape of both log-normals, the computed one with its interval."""
    computed = tables.value_and_bounds(at_published, "lognormal_shape")
    here = print_formatted(computed, ".2f")
    return f"published $s$ = {published[0]:.2f}\nhere {here}"


def _legend_handles(pairs: dict[str, tuple[float, float]], floor: float) -> list[Line2D | Patch]:
    """Return one entry for each kind of area and line, with the pairs of range and work."""
    printed = {
        pair: f"{pair} ρ = {rho:.3g} nm, $W$ = {work / marks.MILLIJOULE:.3g} mJ/m²"
        for pair, (rho, work) in pairs.items()
    }
    return [
        Patch(label=f"computed, {printed['published']}", lw=0, **AT_PUBLISHED),
        Patch(label=f"computed, {printed['fitted']}", fill=False, **AT_FIT),
        Line2D([], [], label="published log-normal", **PUBLISHED_LINE),
        Line2D([], [], label="log-normal of the forces at the published pair", **COMPUTED_LINE),
        Patch(color="0.85", label=f"below {floor * 1e9:.0f} nN"),
    ]


def _linear_edges(of_pairs: Pairs, published: Fit) -> np.ndarray:
    """Return bin edges (N) from zero to a high quantile of each distribution."""
    shape, median = published
    ends = [np.quantile(forces, 0.97) for forces in of_pairs.values()]
    return np.linspace(
        0, np.nanmax([*ends, lognorm.ppf(0.9, shape, scale=median)]), LINEAR_BINS + 1
    )


def _logarithmic_edges(of_pairs: Pairs) -> np.ndarray:
    """Return bin edges (N) evenly spaced in the logarithm that hold every force."""
    every = np.concatenate(list(of_pairs.values()))
    first, last = np.log10(every.min()), np.log10(every.max())
    steps = np.arange(np.floor(first * BINS_PER_DECADE), np.ceil(last * BINS_PER_DECADE) + 2)
    return 10 ** (steps / BINS_PER_DECADE)


def _density(forces: np.ndarray, edges: np.ndarray) -> np.ndarray:
    """Return the density (1/N) in each bin; forces beyond the bins count in the total."""
    densities: np.ndarray = np.histogram(forces, edges)[0] / (forces.size * np.diff(edges))
    return densities


def _lognormal_density(fit: Fit, edges: np.ndarray) -> np.ndarray:
    """Return the log-normal's mean probability density (1/N) in each bin."""
    shape, median = fit
    densities: np.ndarray = np.diff(lognorm.cdf(edges, shape, scale=median)) / np.diff(edges)
    return densities


def _draw_linear(axes: Axes, of_pairs: Pairs, published: Fit, floor: float, colour: str) -> None:
    """Draw the computed histograms and the published log-normal over the same bins, in µN.

    Forces are in N; those below the floor (N) the experiment could not resolve.
    """
    edges = _linear_edges(of_pairs, published)
    _draw_histograms(axes, of_pairs, edges, colour)
    axes.stairs(
        _lognormal_density(published, edges) * marks.MICRONEWTON,
        edges / marks.MICRONEWTON,
        **PUBLISHED_LINE,
    )
    _shade_floor(axes, 0, floor)
    axes.set_xlim(0, edges[-1] / marks.MICRONEWTON)
    axes.set_ylim(bottom=0)
    axes.locator_params(nbins=4)


def _draw_logarithmic(
    axes: Axes, of_pairs: Pairs, fits: dict[str, Fit], floor: float, colour: str
) -> None:
    """Draw the computed histograms and both log-normals (NaN: none) on logarithmic axes, in µN."""
    edges = _logarithmic_edges(of_pairs)
    _draw_histograms(axes, of_pairs, edges, colour)
    exceeded = [lognorm.ppf(0.999, shape, scale=median) for shape, median in fits.values()]
    ends = np.nanmin([edges[0], floor / 3]), np.nanmax([edges[-1], *exceeded])
    line = np.geomspace(*ends, 200)
    for origin, look in (("published", PUBLISHED_LINE), ("computed", COMPUTED_LINE)):
        shape, median = fits[origin]
        curve = lognorm.pdf(line, shape, scale=median) * marks.MICRONEWTON
        axes.plot(line / marks.MICRONEWTON, curve, **look)
    densities = np.concatenate([_density(forces, edges) for forces in of_pairs.values()])
    bars = densities[densities > 0] * marks.MICRONEWTON
    axes.set(xscale="log", yscale="log", xlim=np.divide(ends, marks.MICRONEWTON))
    # The bars set the scale: a log-normal falls without end, and a narrow one has a high peak.
    axes.set_ylim(bars.min() / 3, bars.max() * 10)
    _shade_floor(axes, ends[0], floor)


def _draw_histograms(axes: Axes, of_pairs: Pairs, edges: np.ndarray, colour: str) -> None:
    """Fill the histogram at the published pair, and outline that at the fitted one."""
    printed = {
        pair: _density(forces, edges) * marks.MICRONEWTON for pair, forces in of_pairs.items()
    }
    of_surface: dict[str, dict[str, Any]] = {
        "published": {**AT_PUBLISHED, "color": colour, "fill": True},
        "fitted": {**AT_FIT, "edgecolor": colour},
    }
    for pair, look in of_surface.items():
        axes.stairs(printed[pair], edges / marks.MICRONEWTON, **look)


def _shade_floor(axes: Axes, low: float, floor: float) -> None:
    """Shade the forces the experiment could not resolve."""
    axes.axvspan(low / marks.MICRONEWTON, floor / marks.MICRONEWTON, color="0.85", zorder=0)
