"""Maps of the pull-off force of all surfaces, and how many contacts and scans a mean needs."""

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
import xarray as xr

from hardcontact.adhesion.all_surfaces import with_names
from hardcontact.adhesion.pull_off import WORK_OF_ADHESION
from hardcontact.contact.smooth_sphere import dmt_pull_off
from hardcontact.insight.scan_maps import (
    SAMPLINGS,
    MapSettings,
    deviation_interval,
    force_maps,
    normal_quantile,
)
from hardcontact.numbers.statistics import student_log_interval, with_interval
from hardcontact.records.dataset import stack
from hardcontact.records.job import progress
from hardcontact.surfaces.height_map import read_height_map

LONG_NAMES = {
    "map_mean": ("N", "mean pull-off force of all positions at W = 1 J/m2"),
    "map_median": ("N", "median pull-off force of all positions at W = 1 J/m2"),
    "contacts_mean": ("N", "mean pull-off force of the array of contacts at W = 1 J/m2"),
    "variation": ("1", "standard deviation over mean of all positions"),
    "contacts_needed": ("1", "contacts for the mean of their scan within the tolerance"),
    "correlation_length": ("nm", "distance at which the correlation falls to 1/e"),
    "correlated_places": ("1", "area of the scan over the integral of the correlation"),
    "between_scans": ("1", "standard deviation of scan means over their mean"),
    "worth_of_scan": ("1", "independent contacts that all positions of a scan are worth"),
    "touched_pixels": ("1", "pixels that touch at some position of the scan"),
    "scans_needed": ("1", "scans for the mean of the surface within the tolerance"),
}
MEANS = ("map_mean", "map_median", "contacts_mean")
OVER_SCANS = (
    "variation",
    "contacts_needed",
    "correlation_length",
    "correlated_places",
    "touched_pixels",
)


def maps_of_surfaces(
    stitched: Iterable[tuple[tuple[str, int], str]],
    settings: MapSettings,
    labels: Mapping[str, str],
    basis: Mapping[str, str],
) -> xr.Dataset:
    """Return all that the figure of force maps shows, from the files of stitched scans.

    These are given as ((surface, scan), file); the variables are those of `maps_of_scans`, with
    ``label`` and ``basis`` (surface).
    """
    files = list(stitched)
    scans = {
        key: force_maps(read_height_map(path), settings)
        for key, path in progress(files, len(files), "scans")
    }
    return with_names(maps_of_scans(scans, settings), {"labels": labels, "basis": basis})


def maps_of_scans(scans: Mapping[tuple[str, int], xr.Dataset], settings: MapSettings) -> xr.Dataset:
    """Return the maps of one scan a surface, and the numbers of all scans with their intervals.

    Of `force_maps` by (surface, scan): ``heights``, ``pull_off_force`` (surface, row, column) and
    ``scan_size`` of the first scan; ``map_mean``, ``map_median``, ``contacts_mean`` (surface, scan,
    rho); ``distribution``, ``array_error`` averaged over scans; the other numbers of LONG_NAMES
    (surface, rho), with intervals: over scans by Student's t on logarithms, of what scatters
    between them by chi-squared. Contacts of one scan have that scan's mean in common:
    ``worth_of_scan`` is their variance, within and between scans, over that between scans.
    """
    pictures = ["heights", "pull_off_force", "scan_size"]
    first = {(surface,): scans[surface, scan] for surface, scan in reversed(list(scans))}
    order = list(dict.fromkeys((surface,) for surface, _ in scans))
    maps = stack({key: first[key][pictures] for key in order}, ["surface"])
    numbers = stack(
        {key: one.drop_vars(pictures) for key, one in scans.items()}, ["surface", "scan"]
    )
    of_scans = numbers[list(MEANS)]
    averaged = numbers[["distribution"]].mean("scan", keep_attrs=True)
    errors: xr.DataArray = (numbers["array_error"] ** 2).mean("scan") ** 0.5
    averaged["array_error"] = errors.assign_attrs(
        units="1", long_name="error of the mean of an array, root mean square over scans"
    )
    variables: dict[str, Any] = {}
    for name in OVER_SCANS:
        variables |= _over_scans(name, numbers, settings)
    variables |= _between_scans(numbers, settings)
    complete = maps.merge(of_scans).merge(averaged).assign(variables)
    complete = complete.assign_coords(sampling=SAMPLINGS)
    for name in MEANS:
        units, long_name = LONG_NAMES[name]
        complete[name].attrs.update(units=units, long_name=long_name)
    return complete.assign_attrs(
        work_of_adhesion=WORK_OF_ADHESION,
        smooth_sphere_force=dmt_pull_off(WORK_OF_ADHESION, settings["radius"]),
        reference_rho=settings["reference_rho"],
        tolerance=settings["tolerance"],
        confidence=settings["confidence"],
        normal_quantile=normal_quantile(settings),
        array_contacts=settings["contact"]["count"] ** 2,
    )


def _bounded(
    name: str, value: xr.DataArray, interval: xr.DataArray, settings: MapSettings
) -> dict[str, Any]:
    """Return a number of LONG_NAMES and its interval."""
    units, long_name = LONG_NAMES[name]
    attributes = {"units": units, "long_name": long_name}
    dimensions = [str(dimension) for dimension in value.dims]
    ends = interval.transpose(*dimensions, "bound").values
    return with_interval(name, dimensions, value.values, ends, attributes, settings["confidence"])


def _over_scans(name: str, numbers: xr.Dataset, settings: MapSettings) -> dict[str, Any]:
    """Return the mean of a number over the scans there are; NaN where it is NaN on one of them."""
    values, present = numbers[name], numbers["map_mean"].isel(rho=0, drop=True).notnull()
    known = ~(values.isnull() & present).any("scan")
    interval = student_log_interval(values, settings["confidence"], "scan")
    return _bounded(name, values.mean("scan").where(known), interval.where(known), settings)


def _between_scans(numbers: xr.Dataset, settings: MapSettings) -> dict[str, Any]:
    """Return how much means of whole scans scatter, what a scan is worth, and the scans needed."""
    means = numbers["map_mean"]
    scatter = means.std("scan", ddof=1) / means.mean("scan")
    counts = means.isel(rho=0).count("scan").values
    ends = np.array(
        [
            deviation_interval(of_surface, int(count), settings["confidence"])
            for of_surface, count in zip(scatter.values, counts, strict=True)
        ]
    )
    interval = xr.DataArray(ends, dims=(*scatter.dims, "bound"))
    error, within = settings["tolerance"] / normal_quantile(settings), numbers["variation"]
    ratio = (within**2).mean("scan")
    reversed_ends = interval.isel(bound=[1, 0])  # the more scans scatter, the less one is worth
    return (
        _bounded("between_scans", scatter, interval, settings)
        | _bounded("scans_needed", (scatter / error) ** 2, (interval / error) ** 2, settings)
        | _bounded(
            "worth_of_scan",
            1 + ratio / scatter**2,
            1 + ratio.drop_vars(list(ratio.coords)) / reversed_ends**2,
            settings,
        )
    )
