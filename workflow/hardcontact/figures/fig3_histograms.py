"""Histograms of the pull-off forces of one surface, for Fig. 3: their bins, and how they look."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from scipy.stats import lognorm

from hardcontact.figures import style

__all__ = [
    "AT_FIT",
    "AT_PUBLISHED",
    "COMPUTED_LINE",
    "PUBLISHED_LINE",
    "Fit",
    "Pairs",
    "density",
    "draw_linear",
    "draw_logarithmic",
    "linear_edges",
    "logarithmic_edges",
    "lognormal_density",
]

LINEAR_BINS = 24
BINS_PER_DECADE = 8
MICRONEWTON = 1e-6
AT_PUBLISHED: dict[str, Any] = {"color": "0.4", "alpha": 0.55}
AT_FIT: dict[str, Any] = {"edgecolor": "0.2", "linewidth": 1.2}
PUBLISHED_LINE: dict[str, Any] = {"color": style.PUBLISHED, "lw": 1.0}
COMPUTED_LINE: dict[str, Any] = {"color": style.PUBLISHED, "lw": 1.0, "ls": "--"}

Fit = tuple[float, float]  # shape and median (N) of a log-normal
Pairs = dict[str, np.ndarray]  # forces (N) of one surface by pair, "published" and "fitted"


def linear_edges(of_pairs: Pairs, published: Fit) -> np.ndarray:
    """Return bin edges (N) from zero to a high quantile of each distribution."""
    shape, median = published
    ends = [np.quantile(forces, 0.97) for forces in of_pairs.values()]
    return np.linspace(
        0, np.nanmax([*ends, lognorm.ppf(0.9, shape, scale=median)]), LINEAR_BINS + 1
    )


def logarithmic_edges(of_pairs: Pairs) -> np.ndarray:
    """Return bin edges (N) evenly spaced in the logarithm that hold every force."""
    every = np.concatenate(list(of_pairs.values()))
    first, last = np.log10(every.min()), np.log10(every.max())
    steps = np.arange(np.floor(first * BINS_PER_DECADE), np.ceil(last * BINS_PER_DECADE) + 2)
    return 10 ** (steps / BINS_PER_DECADE)


def density(forces: np.ndarray, edges: np.ndarray) -> np.ndarray:
    """Return the density (1/N) in each bin; forces beyond the bins count in the total."""
    densities: np.ndarray = np.histogram(forces, edges)[0] / (forces.size * np.diff(edges))
    return densities


def lognormal_density(fit: Fit, edges: np.ndarray) -> np.ndarray:
    """Return the log-normal's mean probability density (1/N) in each bin."""
    shape, median = fit
    densities: np.ndarray = np.diff(lognorm.cdf(edges, shape, scale=median)) / np.diff(edges)
    return densities


def draw_linear(axes: Axes, of_pairs: Pairs, published: Fit, floor: float, colour: str) -> None:
    """Draw the computed histograms and the published log-normal over the same bins, in µN.

    Forces are in N; those below the floor (N) the experiment could not resolve.
    """
    edges = linear_edges(of_pairs, published)
    _draw_histograms(axes, of_pairs, edges, colour)
    axes.stairs(
        lognormal_density(published, edges) * MICRONEWTON, edges / MICRONEWTON, **PUBLISHED_LINE
    )
    _shade_floor(axes, 0, floor)
    axes.set_xlim(0, edges[-1] / MICRONEWTON)
    axes.set_ylim(bottom=0)
    axes.locator_params(nbins=4)


def draw_logarithmic(
    axes: Axes, of_pairs: Pairs, fits: dict[str, Fit], floor: float, colour: str
) -> None:
    """Draw the computed histograms and both log-normals (NaN: none) on logarithmic axes, in µN."""
    edges = logarithmic_edges(of_pairs)
    _draw_histograms(axes, of_pairs, edges, colour)
    ends = np.nanmin([edges[0], floor / 3]), np.nanmax([edges[-1], *_upper_ends(fits)])
    line = np.geomspace(*ends, 200)
    for origin, look in (("published", PUBLISHED_LINE), ("computed", COMPUTED_LINE)):
        shape, median = fits[origin]
        curve = lognorm.pdf(line, shape, scale=median) * MICRONEWTON
        axes.plot(line / MICRONEWTON, curve, **look)
    densities = np.concatenate([density(forces, edges) for forces in of_pairs.values()])
    bars = densities[densities > 0] * MICRONEWTON
    axes.set(xscale="log", yscale="log", xlim=np.divide(ends, MICRONEWTON))
    # The bars set the scale: a log-normal falls without end, and a narrow one has a high peak.
    axes.set_ylim(bars.min() / 3, bars.max() * 10)
    _shade_floor(axes, ends[0], floor)


def _draw_histograms(axes: Axes, of_pairs: Pairs, edges: np.ndarray, colour: str) -> None:
    """Fill the histogram at the published pair, and outline that at the fitted one."""
    printed = {pair: density(forces, edges) * MICRONEWTON for pair, forces in of_pairs.items()}
    of_surface: dict[str, dict[str, Any]] = {
        "published": {**AT_PUBLISHED, "color": colour, "fill": True},
        "fitted": {**AT_FIT, "edgecolor": colour},
    }
    for pair, look in of_surface.items():
        axes.stairs(printed[pair], edges / MICRONEWTON, **look)


def _upper_ends(fits: dict[str, Fit]) -> list[float]:
    """Return the force (N) that one in a thousand exceeds, for each log-normal."""
    return [lognorm.ppf(0.999, shape, scale=median) for shape, median in fits.values()]


def _shade_floor(axes: Axes, low: float, floor: float) -> None:
    """Shade the forces the experiment could not resolve."""
    axes.axvspan(low / MICRONEWTON, floor / MICRONEWTON, color="0.85", zorder=0)
