"""Marks of the same look in several figures: published range and fit, minima of the error."""

from typing import Any

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.patches import Patch

from hardcontact.figures.tables import SHARE_OF_SETS
from hardcontact.numbers.printing import print_share

#: What a cutoff of each side of the band does, above its panel.
REMOVED = {
    "small": "roughness below the cutoff removed",
    "large": "roughness above the cutoff removed",
}
BAND_OF_SETS = 0.2  # opacity
MICRONEWTON = 1e-6
MILLIJOULE = 1e-3
FIT = "#6A3D9A"  # of no surface
FIT_STAR: dict[str, Any] = {"marker": "*", "color": FIT, "mec": "white", "mew": 0.6, "ms": 11}
PUBLISHED_RANGE: dict[str, Any] = {"color": "0.25", "lw": 1.0, "ls": (0, (4, 2))}


def draw_published_range(axes: Axes, published_constants: pd.DataFrame) -> None:
    """Draw the published range of adhesion (nm), which the study's numbers stand at, as a line."""
    axes.axvline(published_constants["value"]["range_of_adhesion"], **PUBLISHED_RANGE, zorder=1)


def draw_published_fit(axes: Axes, published_constants: pd.DataFrame) -> None:
    """Mark the published range (nm) and work of adhesion (mJ/m2) with their uncertainties."""
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
        ms=5,
        lw=1.4,
        zorder=5,
        label="published fit",
    )


def fill_sets(axes: Axes, along: xr.DataArray | np.ndarray, spread: xr.Dataset, color: str) -> None:
    """Fill a band between `low` and `high` over the sets of substitutes."""
    axes.fill_between(along, spread["low"], spread["high"], color=color, alpha=BAND_OF_SETS, lw=0)


def sets_handle() -> Patch:
    """Return the entry of such bands in a legend."""
    share = print_share(SHARE_OF_SETS)
    return Patch(color="0.3", alpha=BAND_OF_SETS, lw=0, label=f"{share} of all sets of substitutes")


def draw_fit(axes: Axes, fit: xr.Dataset, height: str, unit: float = 1) -> None:
    """Mark the best fit of the study with a star, and the other minima of its error with rings.

    Along x the range of adhesion (nm), along y the `height`, "work" or "error", in `unit`.
    """
    best = {"work": "work_of_adhesion", "error": "best_error"}[height]
    others = fit["minimum_range"].values != fit["range_of_adhesion"].item()
    look: dict[str, Any] = {"ls": "none", "zorder": 6}
    axes.plot(
        fit["range_of_adhesion"],
        fit[best] / unit,
        label="best fit of the study",
        **FIT_STAR,
        **look,
    )
    axes.plot(
        fit["minimum_range"][others],
        fit[f"minimum_{height}"][others] / unit,
        "o",
        mfc="white",
        mec=FIT,
        mew=1.4,
        ms=5,
        label="other minimum of it",
        **look,
    )


def reach(curve: xr.Dataset) -> np.ndarray:
    """Return how far `low` and `high` lie from `value`, (2, ...), as error bars take it."""
    distance: np.ndarray = abs(curve[["low", "high"]].to_array() - curve["value"]).values
    return distance
