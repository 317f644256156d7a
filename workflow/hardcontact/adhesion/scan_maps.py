"""Maps of the rigid pull-off force on scans, and how many contacts and scans their mean needs."""

from collections.abc import Iterable, Mapping
from typing import Any, TypedDict

import numpy as np
import xarray as xr
from scipy import stats

from hardcontact.adhesion.force_maps import at_every_pixel, rigid_pull_off
from hardcontact.adhesion.map_statistics import (
    array_error,
    contacts_for_error,
    correlation,
    deviation_interval,
    variation,
)
from hardcontact.adhesion.pull_off import FORCE, WORK_OF_ADHESION
from hardcontact.adhesion.smooth_sphere import dmt_pull_off
from hardcontact.contact.geometry import ContactArray, bodies
from hardcontact.records.dataset import stack
from hardcontact.records.log import progress
from hardcontact.statistics import student_log_interval, with_interval
from hardcontact.surfaces.height_map import HeightMap, read_height_map

__all__ = ["MapSettings", "force_maps", "maps_of_scans", "maps_of_surfaces"]

#: Contacts along an edge of the arrays whose error is computed.
COUNTS = (1, 2, 3, 4, 5, 6, 8, 10, 12, 14, 17, 20, 28, 40, 57, 80)

#: Edges of the classes of forces, over the force of a smooth sphere on a plane.
CLASSES = np.geomspace(1e-6, 1e2, 161)

#: How the contacts on a scan lie.
SAMPLINGS = ["random", "array"]

LONG_NAMES = {
    "map_mean": ("N", "mean pull-off force of all positions at W = 1 J/m2"),
    "map_median": ("N", "median pull-off force of all positions at W = 1 J/m2"),
    "contacts_mean": ("N", "mean pull-off force of the array of contacts at W = 1 J/m2"),
    "variation": ("1", "standard deviation over mean of all positions"),
    "contacts_needed": ("1", "contacts for the mean of their scan within the tolerance"),
    "correlation_length": ("nm", "distance at which the correlation falls to 1/e"),
    "correlated_places": ("1", "area of the scan over the integral of the correlation"),
    "between_scans": ("1", "standard deviation of scan means over their mean"),
    "scans_needed": ("1", "scans for the mean of the surface within the tolerance"),
}
MEANS = ("map_mean", "map_median", "contacts_mean")
OVER_SCANS = ("variation", "contacts_needed", "correlation_length", "correlated_places")


class MapSettings(TypedDict):
    """How maps are made and what is asked of them.

    Attributes
    ----------
    radius : float
        Of the smooth sphere in nm.
    contact : ContactArray
        Analysis window, and the array of contacts beside the map.
    ranges : list of float
        Ranges of adhesion in nm.
    reference_rho : float
        That of the maps that are kept, one of the ranges.
    tolerance : float
        Relative error of a mean.
    confidence : float
        Probability that the mean is within the tolerance, and of the intervals.
    """

    radius: float
    contact: ContactArray
    ranges: list[float]
    reference_rho: float
    tolerance: float
    confidence: float


def maps_of_surfaces(
    stitched: Iterable[tuple[tuple[str, int], str]],
    settings: MapSettings,
    labels: Mapping[str, str],
    basis: Mapping[str, str],
) -> xr.Dataset:
    """Return all that the figure of force maps shows, from the files of stitched scans.

    Parameters
    ----------
    stitched : iterable of tuple
        ((surface, scan), file of the mirror-stitched scan).
    settings : MapSettings
        Sphere, contacts, ranges and the error asked for.
    labels, basis : mapping of str to str
        Of each surface.

    Returns
    -------
    xarray.Dataset
        As `maps_of_scans`, with ``label`` and ``basis`` (surface).
    """
    files = list(stitched)
    scans = {
        key: force_maps(read_height_map(path), settings)
        for key, path in progress(files, len(files), "scans")
    }
    maps = maps_of_scans(scans, settings)
    return maps.assign(
        {
            name: ("surface", [of_surface[str(surface)] for surface in maps["surface"].values])
            for name, of_surface in (("label", labels), ("basis", basis))
        }
    )


def force_maps(stitched: HeightMap, settings: MapSettings) -> xr.Dataset:
    """Return the map of one scan, its mean and spread, and the errors of means of contacts.

    Parameters
    ----------
    stitched : HeightMap
        The scan beside its mirror images.
    settings : MapSettings
        Sphere, contacts, ranges and the error asked for.

    Returns
    -------
    xarray.Dataset
        ``heights`` and ``pull_off_force`` (row, column) of the scan, the latter at the reference
        range; by ``rho`` the numbers named in LONG_NAMES that one scan has, ``array_error``
        (rho, contacts) and ``distribution`` (rho, sample, relative_force).
    """
    ranges = settings["ranges"]
    pair = bodies(stitched, None, settings["radius"], settings["contact"])
    scan = stitched.pixels // 2
    everywhere = rigid_pull_off(at_every_pixel(pair, scan), ranges)
    contacts = rigid_pull_off(pair, ranges)
    reference = everywhere[list(ranges).index(settings["reference_rho"])]
    numbers = [_numbers(forces, stitched.pixel_size, settings) for forces in everywhere]
    smooth = dmt_pull_off(WORK_OF_ADHESION, settings["radius"])
    distributions = [
        [_distribution(sample / smooth) for sample in samples]
        for samples in zip(everywhere, contacts, strict=True)
    ]
    axes = ("row", "column")
    heights = stitched.heights[:scan, :scan].astype("float32")
    return xr.Dataset(
        {
            "heights": (axes, heights, {"units": "nm", "long_name": "surface height"}),
            "pull_off_force": (axes, reference.astype("float32"), FORCE),
            "scan_size": ((), scan * stitched.pixel_size, {"units": "nm"}),
            "map_mean": ("rho", everywhere.mean(axis=(1, 2))),
            "map_median": ("rho", np.median(everywhere, axis=(1, 2))),
            "contacts_mean": ("rho", contacts.mean(axis=(1, 2))),
            "distribution": (
                ("rho", "sample", "relative_force"),
                distributions,
                {"units": "1", "long_name": "share of the forces per decade"},
            ),
            **{
                name: (("rho", *dimensions), [of_range[name] for of_range in numbers])
                for name, dimensions in {
                    "variation": (),
                    "correlation_length": (),
                    "correlated_places": (),
                    "array_error": ("contacts",),
                    "contacts_needed": ("sampling",),
                }.items()
            },
        },
        {
            "rho": ("rho", ranges, {"units": "nm", "long_name": "range of adhesion"}),
            "row": range(scan),
            "column": range(scan),
            "sample": ["all positions", "array of contacts"],
            "sampling": SAMPLINGS,
            "contacts": np.square(_counts(scan)),
            "relative_force": np.sqrt(CLASSES[1:] * CLASSES[:-1]),
        },
    )


def _counts(pixels: int) -> np.ndarray:
    """Return the contacts along the edges of arrays that fit on a scan two pixels apart."""
    return np.array([count for count in COUNTS if 2 * count <= pixels])


def _normal_quantile(settings: MapSettings) -> float:
    """Return the standard deviations that a mean keeps within with the confidence asked for."""
    return float(stats.norm.ppf((1 + settings["confidence"]) / 2))


def _numbers(forces: np.ndarray, pixel_size: float, settings: MapSettings) -> dict[str, Any]:
    """Return the numbers of one map (n, n) in N."""
    counts, error = _counts(len(forces)), settings["tolerance"] / _normal_quantile(settings)
    errors = np.array([array_error(forces, int(count)) for count in counts])
    length, area = correlation(forces, pixel_size)
    spread = variation(forces)
    return {
        "variation": spread,
        "correlation_length": length,
        "correlated_places": forces.size * pixel_size**2 / area,
        "array_error": errors,
        "contacts_needed": [
            max(1.0, (spread / error) ** 2),
            contacts_for_error(counts**2, errors, error),
        ],
    }


def _distribution(relative: np.ndarray) -> np.ndarray:
    """Return the share of forces (over that of a smooth sphere) per decade in each of CLASSES."""
    number, _ = np.histogram(relative, CLASSES)
    return number / relative.size / np.diff(np.log10(CLASSES))


def maps_of_scans(scans: Mapping[tuple[str, int], xr.Dataset], settings: MapSettings) -> xr.Dataset:
    """Return the maps of one scan a surface, and the numbers of all scans with their intervals.

    Parameters
    ----------
    scans : mapping of tuple to xarray.Dataset
        (surface, scan) -> `force_maps`.
    settings : MapSettings
        As there.

    Returns
    -------
    xarray.Dataset
        ``heights``, ``pull_off_force`` (surface, row, column) and ``scan_size`` of the first scan;
        ``map_mean``, ``map_median``, ``contacts_mean`` (surface, scan, rho); ``distribution``,
        ``array_error`` averaged over scans; the other numbers of LONG_NAMES (surface, rho), with
        intervals: over scans by Student's t on logarithms, of what scatters between them by
        chi-squared.
    """
    pictures = ["heights", "pull_off_force", "scan_size"]
    first = {(surface,): scans[surface, scan] for surface, scan in reversed(list(scans))}
    order = list(dict.fromkeys((surface,) for surface, _ in scans))
    maps = stack({key: first[key][pictures] for key in order}, ["surface"])
    numbers = stack(
        {key: one.drop_vars(pictures) for key, one in scans.items()}, ["surface", "scan"]
    )
    of_scans = numbers[list(MEANS)]
    averaged = numbers[["distribution", "array_error"]].mean("scan", keep_attrs=True)
    averaged["array_error"].attrs.update(units="1", long_name="error of the mean of an array")
    variables: dict[str, Any] = {}
    for name in OVER_SCANS:
        values = numbers[name]
        interval = student_log_interval(values, settings["confidence"], "scan")
        mean = values.mean("scan", skipna=False)
        variables |= _bounded(name, mean, interval.where(mean.notnull()), settings)
    variables |= _between_scans(numbers["map_mean"], settings)
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
        normal_quantile=_normal_quantile(settings),
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


def _between_scans(means: xr.DataArray, settings: MapSettings) -> dict[str, Any]:
    """Return how much means (surface, scan, rho) of whole scans scatter, and the scans needed."""
    deviation = means.std("scan", ddof=1) / means.mean("scan")
    counts = means.isel(rho=0).count("scan").values
    ends = np.array(
        [
            deviation_interval(of_surface, int(count), settings["confidence"])
            for of_surface, count in zip(deviation.values, counts, strict=True)
        ]
    )
    interval = xr.DataArray(ends, dims=(*deviation.dims, "bound"))
    error = settings["tolerance"] / _normal_quantile(settings)
    return _bounded("between_scans", deviation, interval, settings) | _bounded(
        "scans_needed", (deviation / error) ** 2, (interval / error) ** 2, settings
    )
