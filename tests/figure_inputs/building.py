"""What the inputs of figures are built from."""

from typing import Any

import numpy as np
import xarray as xr
from intervals import between_multiples
from numpy.typing import ArrayLike
from paper_numbers import LABELS, SUBSTRATES


def generator() -> np.random.Generator:
    """Return new random numbers, the same each time."""
    return np.random.default_rng(1)


def named(surfaces: list[str] = SUBSTRATES, labels: list[str] = LABELS) -> xr.Dataset:
    """Return substitute surfaces with their labels."""
    basis = ["substitute"] * len(surfaces)
    return xr.Dataset(
        {"label": ("surface", labels), "basis": ("surface", basis)}, {"surface": surfaces}
    )


def bounded(
    name: str,
    dimensions: str | tuple[str, ...],
    value: ArrayLike,
    low: float = 0.8,
    high: float = 1.2,
    unit: str = "1",
) -> dict[str, Any]:
    """Return a variable and an interval between two multiples of it."""
    return between_multiples(name, dimensions, value, (low, high), 0.9, units=unit)
