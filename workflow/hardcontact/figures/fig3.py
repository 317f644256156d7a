"""Fig. 3: how the pull-off forces are distributed, published and computed."""

from string import ascii_lowercase

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from scipy.stats import lognorm

from hardcontact.figures import style

__all__ = ["draw", "table"]

CONTACT_MODEL = "plastic"  # the one the paper's conclusions rest on
LINEAR_BINS = 24
BINS_PER_DECADE = 8
MICRONEWTON = 1e-6
COLUMNS = [
    "surface",
    "label",
    "basis",
    "origin",
    "quantity",
    "panel",
    "force_low",
    "force_high",
    "value",
    "low",
    "high",
    "unit",
]


def table(adhesion: xr.Dataset, inference: xr.Dataset) -> pd.DataFrame:
    """Return the histograms of computed forces and the log-normals, published and computed.

    One row a bin, its edges `force_low` and `force_high` in N and its probability density in 1/N
    (bins of the linear panels "1", of the logarithmic panels "2"); one row a log-normal shape (1),
    median (N), mean (N) and fraction below the force floor, with the 95 % interval over scans.
    """
    forces = _forces_at_fit(adhesion, inference)
    return pd.concat(
        [
            frame.assign(
                surface=surface,
                label=str(inference["label"].sel(surface=surface).item()),
                basis=str(inference["basis"].sel(surface=surface).item()),
            )
            for surface in inference["surface"].values
            for frame in (
                _histogram_rows(forces[surface], _fits(inference, surface)),
                _lognormal_rows(inference.sel(surface=surface, contact_model=CONTACT_MODEL)),
            )
        ],
        ignore_index=True,
    )[COLUMNS]


@style.print_style()
def draw(adhesion: xr.Dataset, inference: xr.Dataset) -> Figure:
    """Draw Fig. 3: above on linear, below on logarithmic axes, one column a substrate.

    `pull_off_force` (N, at W = attrs["work_of_adhesion"] J/m2) is taken at the fitted range of
    adhesion (nm) and scaled to the fitted work of adhesion (J/m2).
    """
    surfaces = [str(name) for name in inference["surface"].values]
    forces, colours = _forces_at_fit(adhesion, inference), style.colours(surfaces)
    floor = inference.attrs["force_floor"]
    figure = style.create(4.4)
    grid = figure.subplots(2, len(surfaces), squeeze=False)
    for letter, surface, (linear, logarithmic) in zip(
        ascii_lowercase, surfaces, grid.T, strict=False
    ):
        fits = _fits(inference, surface)
        _draw_linear(linear, forces[surface], fits, floor, colours[surface])
        _draw_logarithmic(logarithmic, forces[surface], fits, floor, colours[surface])
        label = str(inference["label"].sel(surface=surface).item())
        style.label_panel(linear, f"{letter}_1", label)
        style.label_panel(logarithmic, f"{letter}_2")
        logarithmic.set_xlabel("pull-off force (µN)")
    grid[0, 0].set_ylabel("probability density (1/µN)")
    grid[1, 0].set_ylabel("probability density (1/µN)")
    figure.legend(*_legend_entries(grid), loc="outside upper center", ncols=4)
    style.mark_basis(figure, inference)
    return figure


def _forces_at_fit(adhesion: xr.Dataset, inference: xr.Dataset) -> dict[str, np.ndarray]:
    """Return all computed forces (N) of each surface at the fitted range and work of adhesion."""
    fit = inference.sel(contact_model=CONTACT_MODEL)
    per_work = adhesion["pull_off_force"].sel(contact_model=CONTACT_MODEL)
    # near straight lines in log-log: interpolate there
    logarithm = np.log(per_work).assign_coords(rho=np.log(adhesion["rho"]))
    at_range = np.exp(logarithm.interp(rho=np.log(fit["range_of_adhesion"].item())))
    scaled = at_range * fit["work_of_adhesion"].item() / adhesion.attrs["work_of_adhesion"]
    return {str(name): _finite(scaled.sel(surface=name)) for name in adhesion["surface"].values}


def _finite(values: xr.DataArray) -> np.ndarray:
    """Return the values flat, without the gaps of surfaces that have fewer scans than others."""
    return values.values[np.isfinite(values.values)]


def _fits(inference: xr.Dataset, surface: str) -> dict[str, tuple[float, float]]:
    """Return shape and median (N) of the published and of the computed log-normal."""
    of_surface = inference.sel(surface=surface, contact_model=CONTACT_MODEL)
    pairs = {
        "published": ("published_lognormal_shape", "published_lognormal_median"),
        "computed": ("lognormal_shape", "lognormal_median"),
    }
    return {
        origin: (of_surface[shape].item(), of_surface[median].item())
        for origin, (shape, median) in pairs.items()
    }


def _linear_edges(forces: np.ndarray, fits: dict[str, tuple[float, float]]) -> np.ndarray:
    """Return bin edges (N) from zero to where little of either distribution is left."""
    shape, median = fits["published"]
    ends = [np.quantile(forces, 0.97), lognorm.ppf(0.9, shape, scale=median)]
    return np.linspace(0, np.nanmax(ends), LINEAR_BINS + 1)


def _logarithmic_edges(forces: np.ndarray) -> np.ndarray:
    """Return bin edges (N) evenly spaced in the logarithm that hold every force."""
    first, last = np.log10(forces.min()), np.log10(forces.max())
    steps = np.arange(np.floor(first * BINS_PER_DECADE), np.ceil(last * BINS_PER_DECADE) + 2)
    return 10 ** (steps / BINS_PER_DECADE)


def _density(forces: np.ndarray, edges: np.ndarray) -> np.ndarray:
    """Return the density (1/N) in each bin; forces beyond the bins count in the total."""
    return np.histogram(forces, edges)[0] / (forces.size * np.diff(edges))


def _lognormal_density(fit: tuple[float, float], edges: np.ndarray) -> np.ndarray:
    """Return the log-normal's mean probability density (1/N) in each bin."""
    shape, median = fit
    return np.diff(lognorm.cdf(edges, shape, scale=median)) / np.diff(edges)


def _histogram_rows(forces: np.ndarray, fits: dict[str, tuple[float, float]]) -> pd.DataFrame:
    linear, logarithmic = _linear_edges(forces, fits), _logarithmic_edges(forces)
    shown = [
        ("1", "computed", linear, _density(forces, linear)),
        ("1", "published", linear, _lognormal_density(fits["published"], linear)),
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


def _lognormal_rows(of_surface: xr.Dataset) -> pd.DataFrame:
    """Return the numbers that describe the distributions of one surface, one row each."""
    quantities = [
        ("published", "lognormal_shape", "published_lognormal_shape", "1"),
        ("published", "lognormal_median", "published_lognormal_median", "N"),
        ("published", "mean_force", "published_mean_force", "N"),
        ("published", "median_force", "published_median_force", "N"),
        ("computed", "lognormal_shape", "lognormal_shape", "1"),
        ("computed", "lognormal_median", "lognormal_median", "N"),
        ("computed", "mean_force", "force_mean", "N"),
        ("computed", "median_force", "force_median", "N"),
        ("computed", "censored_fraction", "censored_fraction", "1"),
    ]
    return pd.DataFrame(
        {
            "origin": origin,
            "quantity": quantity,
            "unit": unit,
            "value": of_surface[name].item(),
            "low": _bound(of_surface, f"{name}_low"),
            "high": _bound(of_surface, f"{name}_high"),
        }
        for origin, quantity, name, unit in quantities
    )


def _bound(of_surface: xr.Dataset, name: str) -> float:
    return of_surface[name].item() if name in of_surface else np.nan


def _draw_linear(
    axes: Axes, forces: np.ndarray, fits: dict[str, tuple[float, float]], floor: float, colour: str
) -> None:
    """Draw the computed histogram and the published log-normal over the same bins."""
    edges = _linear_edges(forces, fits)
    _draw_histogram(axes, forces, edges, colour)
    axes.stairs(
        _lognormal_density(fits["published"], edges) * MICRONEWTON,
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
    axes: Axes, forces: np.ndarray, fits: dict[str, tuple[float, float]], floor: float, colour: str
) -> None:
    """Draw the computed histogram and both log-normals on logarithmic axes."""
    edges = _logarithmic_edges(forces)
    _draw_histogram(axes, forces, edges, colour)
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
    bars = _density(forces, edges)
    bars = bars[bars > 0] * MICRONEWTON
    axes.set(xscale="log", yscale="log", xlim=np.divide(ends, MICRONEWTON))
    # The bars set the scale: the log-normals fall without end, and a narrow one towers.
    axes.set_ylim(bars.min() / 3, bars.max() * 10)
    _shade_floor(axes, ends[0], floor)


def _draw_histogram(axes: Axes, forces: np.ndarray, edges: np.ndarray, colour: str) -> None:
    axes.stairs(
        _density(forces, edges) * MICRONEWTON,
        edges / MICRONEWTON,
        fill=True,
        color=colour,
        alpha=0.6,
        label="computed forces",
    )


def _upper_ends(fits: dict[str, tuple[float, float]]) -> list[float]:
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


def _legend_entries(grid: np.ndarray) -> tuple[list, list[str]]:
    """Return handles and labels of one column, each once: every column holds the same."""
    entries = {}
    for axes in grid[::-1, 0]:
        for handle, label in zip(*axes.get_legend_handles_labels(), strict=True):
            entries.setdefault(label, handle)
    return list(entries.values()), list(entries)
