"""Labels and bases of surfaces in the datasets of the chapter on what decides the band."""

import xarray as xr

from hardcontact.adhesion.all_surfaces import Described

__all__ = ["with_names"]


def with_names(dataset: xr.Dataset, described: Described) -> xr.Dataset:
    """Return a dataset with the label and the basis of every surface of it."""
    surfaces = dataset["surface"].values.tolist()
    return dataset.assign(
        label=("surface", [described["labels"][surface] for surface in surfaces]),
        basis=("surface", [described["basis"][surface] for surface in surfaces]),
    )
