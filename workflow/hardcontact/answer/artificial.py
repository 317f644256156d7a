"""Wavelengths at which no scan is reliable: roughness there is artificial."""

from collections.abc import Iterable

import numpy as np
import xarray as xr

#: Kinds of measurement, and the description of a substitute in the place of one; where a surface
#: has fewer than another its datasets are padded.
KINDS = ("map", "profile", "description")
#: What is known of each measurement in nm.
LENGTHS = ("size", "pixel_size", "shortest_reliable", "longest_reliable", "tip_radius")


def measurements(of_surface: xr.Dataset) -> xr.Dataset:
    """Return the spectra of one surface without what only pads them along `measurement`."""
    return of_surface.isel(measurement=np.isin(of_surface["kind"].values.astype(str), KINDS))


def reliable_measurements(of_surface: xr.Dataset) -> xr.Dataset:
    """Return the spectra of one surface without measurements that are reliable nowhere."""
    known = measurements(of_surface)
    return known.isel(measurement=(known["reliable"].values == 1).any(axis=1))


def artificial_bands(of_surface: xr.Dataset) -> list[tuple[float, float]]:
    """Return the bands of wavelengths that no measurement of a surface reaches reliably.

    Each is its shortest and longest wavelength (nm), growing: from 0 to the shortest that is
    measured, gaps between scans, and from the longest that is measured to infinity.
    """
    known = reliable_measurements(of_surface)
    ends = zip(known["shortest_reliable"].values, known["longest_reliable"].values, strict=True)
    reached = float(of_surface["shortest_measured"])
    bands = [(0.0, reached)]
    for shortest, longest in sorted((float(low), float(high)) for low, high in ends):
        if shortest > reached:
            bands.append((reached, shortest))
        reached = max(reached, longest)
    return [*bands, (float(of_surface["longest_measured"]), np.inf)]


def share_inside(low: float, high: float, bands: Iterable[tuple[float, float]]) -> float:
    """Return how much of an interval of wavelengths lies in any of the bands, in the logarithm.

    Ends (nm) are above zero, bands (nm) disjoint. It is from 0 to 1, of a single wavelength 0 or 1.
    """
    bands = list(bands)
    if low == high:
        return float(any(first < low < last for first, last in bands))
    overlaps = (
        np.log(min(high, last) / max(low, first))
        for first, last in bands
        if min(high, last) > max(low, first)
    )
    return float(sum(overlaps) / np.log(high / low))


def place_of_edge(of_side: xr.Dataset, bands: list[tuple[float, float]]) -> str:
    """Return whether an edge or its bound lies inside artificial bands, its interval partly."""
    edge = float(of_side["edge"].fillna(of_side["edge_bound"]))
    if share_inside(edge, edge, bands):
        return "inside"
    low, high = of_side["edge_interval"].fillna(edge).values
    return "partly" if share_inside(low, high, bands) else "outside"


def measurement_name(one: xr.Dataset) -> str:
    """Return the file of a measurement and, if it is a container, the dataset in it."""
    path, dataset = (str(one[name].item()) for name in ("path", "dataset"))
    return f"{path}: {dataset}" if dataset else path


def single(known: xr.Dataset) -> list[xr.Dataset]:
    """Return each of several measurements by itself."""
    return [known.isel(measurement=place) for place in range(known.sizes["measurement"])]
