"""Stack datasets of single scans into datasets of all surfaces, with the names of surfaces."""

from collections.abc import Mapping
from typing import Any, TypedDict

import xarray as xr

from hardcontact.base.dataset import stack

#: Datasets by their labels: the surface first.
DatasetsByLabels = Mapping[tuple[Any, ...], xr.Dataset]


class NamedSurfaces(TypedDict):
    """Label of each surface, and whether it was measured or is a substitute."""

    labels: Mapping[str, str]
    source: Mapping[str, str]


def add_names(dataset: xr.Dataset, named_surfaces: NamedSurfaces) -> xr.Dataset:
    """Return a dataset with the label and the source of each of its surfaces."""
    surfaces = dataset["surface"].values.tolist()
    return dataset.assign(
        label=("surface", [named_surfaces["labels"][surface] for surface in surfaces]),
        source=("surface", [named_surfaces["source"][surface] for surface in surfaces]),
    )


def stack_pull_off_forces(scans: DatasetsByLabels, named_surfaces: NamedSurfaces) -> xr.Dataset:
    """Stack the pull-off forces of all surfaces, scans, contact models and ranges.

    `scans` has the dataset of `pull_off_with_checks` by (surface, scan).
    Returns the same variables over (surface, scan, ...); ``contact_pixel_count`` (contact_model) is
    the largest of all scans.
    """
    dimensions = ["surface", "scan"]
    forces = stack(scans, dimensions)
    largest = forces["contact_pixel_count"].max([*dimensions, "sphere_scan"], keep_attrs=True)
    return add_names(forces.assign(contact_pixel_count=largest), named_surfaces)


def stack_elastic_contacts(scans: DatasetsByLabels) -> xr.Dataset:
    """Stack the elastic contacts on all scans of one surface.

    `scans` has the dataset of `solve_elastic_contacts` by (scan,). Returns the same variables over
    (scan, ...); ``pressure`` (y, x) in Pa shows one contact on the first scan.
    """
    numbers = {key: scan.drop_vars(["pressure", "y", "x"]) for key, scan in scans.items()}
    return stack(numbers, ["scan"]).assign(pressure=next(iter(scans.values()))["pressure"])
