"""Wavelengths at which no scan is reliable: roughness there is artificial, and what rests on it."""

from collections.abc import Iterable

import numpy as np
import xarray as xr

from hardcontact.band.critical_band import computed_cutoffs
from hardcontact.report.datasets import Datasets

#: Kinds of measurement, and the description of a substitute in the place of one; where a surface
#: has fewer than another its datasets are padded.
KINDS = ("map", "profile", "description")
#: Share of a change from which on it counts as measured, or the rest of it as artificial.
NEARLY_ALL = 0.9
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


def reaches(low: float, high: float, bands: Iterable[tuple[float, float]]) -> bool:
    """Return whether wavelengths from low to high (nm) lie in any band; no number lies in none."""
    return any(first < high and low < last for first, last in bands)


def parts_of_change(
    of: Datasets, side: str, shortest: float = 0.0, longest: float = np.inf
) -> tuple[float, float]:
    """Return by how much reliable and artificial wavelengths of one surface change the force.

    Both are sums of |d ln F| over the wavelengths (nm) between the ends, as roughness is removed
    from the `side` on, where F is linear between cutoffs in logarithms.
    """
    at_side = of.edges.sel(side=side)
    cutoffs = computed_cutoffs(at_side["scale_ratio"])
    logarithm = np.log(at_side["scale_ratio"].sel(cutoff_wavelength=cutoffs).values)
    none_removed = 0 if side == "small" else len(cutoffs)
    end = of.force["continued_end"].sel(side=side).item()
    wavelength = np.insert(cutoffs, none_removed, end)
    logarithm = np.insert(logarithm, none_removed, 0.0)
    bands = artificial_bands(of.spectra)
    inside = max(shortest, wavelength[0]), min(longest, wavelength[-1])
    ends = np.unique(np.clip([*wavelength, *inside, *np.ravel(bands)], *inside))
    change = np.abs(np.diff(np.interp(np.log(ends), np.log(wavelength), logarithm)))
    middle = np.sqrt(ends[1:] * ends[:-1])
    artificial = np.any([(low < middle) & (middle < high) for low, high in bands], axis=0)
    return float(change[~artificial].sum()), float(change[artificial].sum())


def reliable_share(parts: tuple[float, float]) -> float:
    """Return the share of a change that `parts_of_change` finds reliable, NaN if there is none."""
    return parts[0] / sum(parts) if sum(parts) > 0 else np.nan


def share_at_edge(of: Datasets, side: str) -> float:
    """Return which share of the change at an edge is reliable; NaN of an open one."""
    edge = of.edges["edge"].sel(side=side).item()
    ends = (0.0, edge) if side == "small" else (edge, np.inf)
    return np.nan if np.isnan(edge) else reliable_share(parts_of_change(of, side, *ends))


def place_of_edge(of: Datasets, side: str) -> str:
    """Return whether an edge rests on artificial roughness.

    "inside" is an edge, or its bound, at an artificial wavelength, and one of whose change as good
    as all comes from such, "partly" one of whose change some does, "interval" one whose interval
    alone reaches such wavelengths, "outside" any other.
    """
    of_side, bands = of.edges.sel(side=side), artificial_bands(of.spectra)
    edge, share = float(of_side["edge"].fillna(of_side["edge_bound"])), share_at_edge(of, side)
    if reaches(edge, edge, bands) or share < 1 - NEARLY_ALL:
        return "inside"
    if share < NEARLY_ALL:
        return "partly"
    low, high = of_side["edge_interval"].fillna(edge).values
    return "interval" if reaches(low, high, bands) else "outside"


def measurement_name(one: xr.Dataset) -> str:
    """Return the file of a measurement and, if it is a container, the dataset in it."""
    path, dataset = (str(one[name].item()) for name in ("path", "dataset"))
    return f"{path}: {dataset}" if dataset else path


def single(known: xr.Dataset) -> list[xr.Dataset]:
    """Return each of several measurements by itself."""
    return [known.isel(measurement=place) for place in range(known.sizes["measurement"])]
