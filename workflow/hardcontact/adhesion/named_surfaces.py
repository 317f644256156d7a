"""Labels and bases of surfaces in datasets of several."""

from collections.abc import Mapping
from typing import TypedDict

import xarray as xr

__all__ = ["Described", "with_names"]


class Described(TypedDict):
    """Label of each surface, and whether it was measured or is a substitute."""

    labels: Mapping[str, str]
    basis: Mapping[str, str]


def with_names(dataset: xr.Dataset, described: Described) -> xr.Dataset:
    """Return a dataset with the label and the basis of every surface of it."""
    surfaces = dataset["surface"].values.tolist()
    return dataset.assign(
        label=("surface", [described["labels"][surface] for surface in surfaces]),
        basis=("surface", [described["basis"][surface] for surface in surfaces]),
    )
