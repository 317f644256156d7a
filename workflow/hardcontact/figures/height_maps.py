"""Pictures of height maps, with colour bar and scale bar."""

import math

import numpy as np
from matplotlib import rcParams
from matplotlib.axes import Axes

__all__ = ["draw_map"]


def draw_map(axes: Axes, heights: np.ndarray, size: float) -> None:
    """Draw heights (nm) of a square scan of the given size (nm), with colour bar and scale bar."""
    small = rcParams["xtick.labelsize"]
    image = axes.imshow(heights - heights.mean(), cmap="viridis", extent=(0, size, 0, size))
    bar = axes.figure.colorbar(image, ax=axes, shrink=0.9, pad=0.02)
    bar.ax.set_title("nm", fontsize=small, loc="left", pad=3)
    axes.set(xticks=[], yticks=[])
    length = _round_length(size / 4)
    start = 0.06 * size
    # A white bar with a dark edge is visible on every colour of the map.
    axes.plot([start, start + length], [start, start], color="black", lw=4, solid_capstyle="butt")
    axes.plot([start, start + length], [start, start], color="white", lw=2, solid_capstyle="butt")
    axes.text(
        start + length / 2,
        start + 0.03 * size,
        _print_length(length),
        fontsize=small,
        ha="center",
        va="bottom",
        bbox={"facecolor": "white", "edgecolor": "none", "alpha": 0.7, "pad": 1},
    )


def _round_length(length: float) -> float:
    """Return the largest 1, 2 or 5 times a power of ten that is not longer than `length`."""
    decade = 10.0 ** math.floor(math.log10(length))
    return max(step * decade for step in (1, 2, 5) if step * decade <= length)


def _print_length(length: float) -> str:
    return f"{length:g} nm" if length < 1000 else f"{length / 1000:g} µm"
