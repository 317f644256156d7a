"""Fig. 3: how the pull-off forces are distributed, published and computed."""

from string import ascii_lowercase

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from scipy.stats import lognorm

from hardcontact.adhesion.force_curves import at_range
from hardcontact.figures import style
from hardcontact.figures.tables import VALUE_COLUMNS, label_surfaces, value_and_bounds
from hardcontact.statistics import lognormal_shape

__all__ = ["draw", "table"]

CONTACT_MODEL = "plastic"  # the one the paper's conclusions rest on
LINEAR_BINS = 24
BINS_PER_DECADE = 8
MICRONEWTON = 1e-6
COLUMNS = [
    "surface", "label", "basis", "origin", "quantity", "panel", "force_low", "force_high",
    *VALUE_COLUMNS,
]  # fmt: skip

Fit = tuple[float, float]  # shape and median (N) of a log-normal


def table(
    adhesion: xr.Dataset, inference: xr.Dataset, published_pull_off: pd.DataFrame
) -> pd.DataFrame:
    """Return the histograms of computed forces and the log-normals, published and computed.

    Parameters
    ----------
    adhesion, inference, published_pull_off : xarray.Dataset, pandas.DataFrame
        As `draw` takes them.

    Returns
    -------
    pandas.DataFrame
        One row a bin, its edges `force_low` and `force_high` in N and its probability density in
        1/N (bins of the linear panels "1", of the logarithmic panels "2"); one row a log-normal
        shape (1), median (N), mean (N) and fraction below the force floor, with the interval over
        scans.
    """
    forces = _forces_at_fit(adhesion, inference)
    published = _published(inference, published_pull_off)
    frames = []
    for surface in map(str, inference["surface"].values):
        of_surface = (
            _histogram_rows(forces[surface], _fit(published[surface])),
            _published_rows(published[surface]),
            _computed_rows(inference.sel(surface=surface, contact_model=CONTACT_MODEL)),
        )
        frames.append(pd.concat(of_surface).assign(surface=surface))
    return label_surfaces(pd.concat(frames, ignore_index=True), inference)[COLUMNS]


@style.print_style()
def draw(adhesion: xr.Dataset, inference: xr.Dataset, published_pull_off: pd.DataFrame) -> Figure:
    """Draw Fig. 3: above on linear, below on logarithmic axes, one column a substrate.

    Parameters
    ----------
    adhesion : xarray.Dataset
        With `pull_off_force` (N, at W = attrs["work_of_adhesion"] J/m2), which is taken at the
        fitted range of adhesion and scaled to the fitted work of adhesion.
    inference : xarray.Dataset
        With that range (nm) and work (J/m2), the log-normal fits and the attribute `force_floor`.
    published_pull_off : pandas.DataFrame
        With mean and median force (N) by surface.

    Returns
    -------
    matplotlib.figure.Figure
        The figure.
    """
    surfaces = [str(name) for name in inference["surface"].values]
    forces, colours = _forces_at_fit(adhesion, inference), style.colours(surfaces)
    published = _published(inference, published_pull_off)
    floor = inference.attrs["force_floor"]
    figure = style.create(4.4)
    grid = figure.subplots(2, len(surfaces), squeeze=False)
    for letter, surface, (linear, logarithmic) in zip(
        ascii_lowercase, surfaces, grid.T, strict=False
    ):
        of_surface = inference.sel(surface=surface, contact_model=CONTACT_MODEL)
        fits = {"published": _fit(published[surface]), "computed": _fit(of_surface)}
        _draw_linear(linear, forces[surface], fits["published"], floor, colours[surface])
        _draw_logarithmic(logarithmic, forces[surface], fits, floor, colours[surface])
        style.label_panel(linear, f"{letter}_1", str(of_surface["label"].item()))
        style.label_panel(logarithmic, f"{letter}_2")
        logarithmic.set_xlabel("pull-off force (µN)")
    grid[0, 0].set_ylabel("probability density (1/µN)")
    grid[1, 0].set_ylabel("probability density (1/µN)")
    # Every column has the same entries.
    entries = style.legend_entries(grid[::-1, 0])
    figure.legend(entries.values(), entries.keys(), loc="outside upper center", ncols=4)
    style.mark_basis(figure, inference)
    return figure


def _forces_at_fit(adhesion: xr.Dataset, inference: xr.Dataset) -> dict[str, np.ndarray]:
    """Return all computed forces (N) of each surface at the fitted range and work of adhesion."""
    fit = inference.sel(contact_model=CONTACT_MODEL)
    per_work = adhesion["pull_off_force"].sel(contact_model=CONTACT_MODEL)
    at_fit = at_range(per_work, fit["range_of_adhesion"].item())
    scaled = at_fit * fit["work_of_adhesion"].item() / adhesion.attrs["work_of_adhesion"]
    return {str(name): _finite(scaled.sel(surface=name)) for name in adhesion["surface"].values}


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


def _linear_edges(forces: np.ndarray, published: Fit) -> np.ndarray:
    """Return bin edges (N) from zero to a high quantile of either distribution."""
    shape, median = published
    ends = [np.quantile(forces, 0.97), lognorm.ppf(0.9, shape, scale=median)]
    return np.linspace(0, np.nanmax(ends), LINEAR_BINS + 1)


def _logarithmic_edges(forces: np.ndarray) -> np.ndarray:
    """Return bin edges (N) evenly spaced in the logarithm that hold every force."""
    first, last = np.log10(forces.min()), np.log10(forces.max())
    steps = np.arange(np.floor(first * BINS_PER_DECADE), np.ceil(last * BINS_PER_DECADE) + 2)
    return 10 ** (steps / BINS_PER_DECADE)


def _density(forces: np.ndarray, edges: np.ndarray) -> np.ndarray:
    """Return the density (1/N) in each bin; forces beyond the bins count in the total."""
    density: np.ndarray = np.histogram(forces, edges)[0] / (forces.size * np.diff(edges))
    return density


def _lognormal_density(fit: Fit, edges: np.ndarray) -> np.ndarray:
    """Return the log-normal's mean probability density (1/N) in each bin."""
    shape, median = fit
    density: np.ndarray = np.diff(lognorm.cdf(edges, shape, scale=median)) / np.diff(edges)
    return density


def _histogram_rows(forces: np.ndarray, published: Fit) -> pd.DataFrame:
    linear, logarithmic = _linear_edges(forces, published), _logarithmic_edges(forces)
    shown = [
        ("1", "computed", linear, _density(forces, linear)),
        ("1", "published", linear, _lognormal_density(published, linear)),
        ("2", "computed", logarithmic, _density(forces, logarithmic)),
    ]
    return pd.concat(
        pd.DataFrame(
            {
                "panel": panel,
                "origin": origin,
                "quantity": "probability_density",
                "unit": "1/N",
                "force_low": edges[:-1],
                "force_high": edges[1:],
                "value": density,
            }
        )
        for panel, origin, edges, density in shown
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
        {"origin": "published", "quantity": name, "unit": unit, "value": published[name]}
        for name, unit in units.items()
    )


def _computed_rows(of_surface: xr.Dataset) -> pd.DataFrame:
    """Return the numbers that describe the computed forces of one surface, one row each."""
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
            "quantity": name,
            "unit": unit,
            **value_and_bounds(of_surface, variable),
        }
        for name, (variable, unit) in quantities.items()
    )


def _draw_linear(axes: Axes, forces: np.ndarray, published: Fit, floor: float, colour: str) -> None:
    """Draw the computed histogram and the published log-normal over the same bins."""
    edges = _linear_edges(forces, published)
    _draw_histogram(axes, _density(forces, edges), edges, colour)
    axes.stairs(
        _lognormal_density(published, edges) * MICRONEWTON,
        edges / MICRONEWTON,
        color=style.PUBLISHED,
        lw=1.0,
        label="published log-normal",
    )
    _shade_floor(axes, 0, floor)
    axes.set_xlim(0, edges[-1] / MICRONEWTON)
    axes.set_ylim(bottom=0)
    axes.locator_params(nbins=4)


def _draw_logarithmic(
    axes: Axes, forces: np.ndarray, fits: dict[str, Fit], floor: float, colour: str
) -> None:
    """Draw the computed histogram and both log-normals on logarithmic axes."""
    edges = _logarithmic_edges(forces)
    density = _density(forces, edges)
    _draw_histogram(axes, density, edges, colour)
    ends = np.nanmin([edges[0], floor / 3]), np.nanmax([edges[-1], *_upper_ends(fits)])
    line = np.geomspace(*ends, 200)
    for origin, dashes in (("published", "-"), ("computed", "--")):
        shape, median = fits[origin]
        axes.plot(
            line / MICRONEWTON,
            lognorm.pdf(line, shape, scale=median) * MICRONEWTON,
            dashes,
            color=style.PUBLISHED,
            lw=1.0,
            label=f"{origin} log-normal",
        )
    bars = density[density > 0] * MICRONEWTON
    axes.set(xscale="log", yscale="log", xlim=np.divide(ends, MICRONEWTON))
    # The bars set the scale: a log-normal falls without end, and a narrow one has a high peak.
    axes.set_ylim(bars.min() / 3, bars.max() * 10)
    _shade_floor(axes, ends[0], floor)


def _draw_histogram(axes: Axes, density: np.ndarray, edges: np.ndarray, colour: str) -> None:
    axes.stairs(
        density * MICRONEWTON,
        edges / MICRONEWTON,
        fill=True,
        color=colour,
        alpha=0.6,
        label="computed forces",
    )


def _upper_ends(fits: dict[str, Fit]) -> list[float]:
    """Return the force (N) that one in a thousand exceeds, for each log-normal."""
    return [lognorm.ppf(0.999, shape, scale=median) for shape, median in fits.values()]


def _shade_floor(axes: Axes, low: float, floor: float) -> None:
    """Shade the forces the experiment could not resolve."""
    axes.axvspan(
        low / MICRONEWTON,
        floor / MICRONEWTON,
        color="0.85",
        zorder=0,
        label=f"below {floor * 1e9:.0f} nN",
    )
