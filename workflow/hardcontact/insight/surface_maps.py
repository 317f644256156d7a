"""Maps of the pull-off force of all surfaces, and how many contacts and scans a mean needs."""

from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray
from scipy import stats

from hardcontact.adhesion.all_surfaces import Parts, of_first_scans
from hardcontact.adhesion.pull_off import WORK_OF_ADHESION
from hardcontact.contact.smooth_sphere import dmt_pull_off
from hardcontact.insight.scan_maps import SAMPLINGS, MapSettings, normal_quantile
from hardcontact.numbers.statistics import student_log_interval, with_interval
from hardcontact.records.dataset import stack

Floats = NDArray[np.float64]

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
    "variation", "contacts_needed", "correlation_length", "correlated_places", "touched_pixels",
)  # fmt: skip


def maps_of_scans(scans: Parts, settings: MapSettings) -> xr.Dataset:
    """Return the maps of one scan a surface, and the numbers of all scans with their intervals.

    Of `force_maps` by (surface, scan): ``heights``, ``pull_off_force`` (surface, row, column) and
    ``scan_size`` of the first scan; ``map_mean``, ``map_median``, ``contacts_mean`` (surface, scan,
    rho); ``distribution``, ``array_error`` averaged over scans; the other numbers of LONG_NAMES
    (surface, rho), with intervals: over scans by Student's t on logarithms, of what scatters
    between them by chi-squared. Contacts of one scan have that scan's mean in common:
    ``worth_of_scan`` is their variance, within and between scans, over that between scans.
    """
    pictures = ["heights", "pull_off_force", "scan_size"]
    maps = stack(of_first_scans(scans, pictures), ["surface"])
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
    present = numbers["map_mean"].isel(rho=0, drop=True).notnull()
    for name in OVER_SCANS:
        values = numbers[name]
        # Of the scans there are, none may lack it.
        known = ~(values.isnull() & present).any("scan")
        interval = student_log_interval(values, settings["confidence"], "scan").where(known)
        variables |= _bounded(name, values.mean("scan").where(known), interval, settings)
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


def _between_scans(numbers: xr.Dataset, settings: MapSettings) -> dict[str, Any]:
    """Return how much means of whole scans scatter, what a scan is worth, and the scans needed."""
    means = numbers["map_mean"]
    scatter = means.std("scan", ddof=1) / means.mean("scan")
    counts = means.isel(rho=0).count("scan").values[:, None]
    ends = deviation_interval(scatter.values, counts, settings["confidence"])
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


def deviation_interval(deviation: Floats, count: ArrayLike, confidence: float) -> Floats:
    """Return the interval (..., 2) of a standard deviation (...) of normal values, by chi-squared.

    It is that of `count` (...) independent values, with the divisor count - 1; NaN of fewer than
    two.
    """
    freedom = np.asarray(count)[..., None] - 1
    tails = np.array([1 + confidence, 1 - confidence]) / 2
    return np.asarray(deviation[..., None] * np.sqrt(freedom / stats.chi2.ppf(tails, freedom)))
