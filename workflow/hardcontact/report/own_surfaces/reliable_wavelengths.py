"""The wavelengths at which the user's scans are reliable, and how much of the force they decide.

At all other wavelengths roughness is artificial: random, with an extrapolated spectrum.
"""

from collections.abc import Iterable

import numpy as np
import xarray as xr

from hardcontact.inference.edges import computed_cutoffs
from hardcontact.inference.octaves import octaves_within
from hardcontact.report.own_surfaces.datasets import Datasets, drop_padding

#: Smallest share of a change that counts as the whole change: a choice.
NEARLY_ALL = 0.9


def reliable_scans(spectra: xr.Dataset) -> xr.Dataset:
    """Return the spectra of one surface without measurements that are reliable nowhere."""
    measurements = drop_padding(spectra)
    return measurements.isel(measurement=(measurements["reliable"].values == 1).any(axis=1))


def artificial_bands(spectra: xr.Dataset) -> list[tuple[float, float]]:
    """Return the bands of wavelengths at which no measurement of a surface is reliable.

    A band is its shortest and its longest wavelength (nm). The first begins at 0, the last ends at
    infinity; between them lie gaps between scans.
    """
    scans = reliable_scans(spectra)
    ends = (scans[name].values.tolist() for name in ("shortest_reliable", "longest_reliable"))
    longest_covered = float(spectra["shortest_measured"])
    bands = [(0.0, longest_covered)]
    for shortest, longest in sorted(zip(*ends, strict=True)):
        if shortest > longest_covered:
            bands.append((longest_covered, shortest))
        longest_covered = max(longest_covered, longest)
    return [*bands, (float(spectra["longest_measured"]), np.inf)]


def overlaps_any(low: float, high: float, bands: Iterable[tuple[float, float]]) -> bool:
    """Return whether wavelengths from low to high (nm) overlap a band; False if either is NaN."""
    return any(shortest < high and low < longest for shortest, longest in bands)


def shown_octaves(data: Datasets) -> np.ndarray:
    """Return a mask (octave,) of the octaves at whose middle a scan of one surface is reliable."""
    octaves = data.sensitivity["octave"].values
    hidden = [octaves_within(octaves, *band) for band in artificial_bands(data.spectra)]
    return np.asarray(np.logical_not(hidden).all(axis=0))


def reliable_and_artificial_change(
    data: Datasets, side: str, shortest: float = 0.0, longest: float = np.inf
) -> tuple[float, float]:
    """Return how much reliable and how much artificial wavelengths of one surface change the force.

    Roughness is removed on the `side`. A change is the sum of |d ln F| between `shortest` and
    `longest` (nm); ln F is interpolated linearly over the logarithm of the cutoff.
    """
    side_edges = data.edges.sel(side=side)
    cutoffs = computed_cutoffs(side_edges["filtered_force_ratio"])
    log_ratio = np.log(side_edges["filtered_force_ratio"].sel(cutoff_wavelength=cutoffs).values)
    # At the end of the extrapolated spectrum nothing is removed, and the ratio is one.
    end_index = 0 if side == "short" else len(cutoffs)
    end = data.force["extrapolation_end"].sel(side=side).item()
    wavelength = np.insert(cutoffs, end_index, end)
    log_ratio = np.insert(log_ratio, end_index, 0.0)
    bands = artificial_bands(data.spectra)
    limits = max(shortest, wavelength[0]), min(longest, wavelength[-1])
    ends = np.unique(np.clip([*wavelength, *limits, *np.ravel(bands)], *limits))
    change = np.abs(np.diff(np.interp(np.log(ends), np.log(wavelength), log_ratio)))
    middle = np.sqrt(ends[1:] * ends[:-1])
    artificial = np.any([(low < middle) & (middle < high) for low, high in bands], axis=0)
    return float(change[~artificial].sum()), float(change[artificial].sum())


def reliable_share(changes: tuple[float, float]) -> float:
    """Return the share of the first of both changes, NaN without any change."""
    return changes[0] / sum(changes) if sum(changes) > 0 else np.nan


def measured_share_at_edge(data: Datasets, side: str) -> float:
    """Return the share of reliable wavelengths in the change at an edge, NaN for an open edge."""
    edge = data.edges["edge"].sel(side=side).item()
    ends = (0.0, edge) if side == "short" else (edge, np.inf)
    if np.isnan(edge):
        return np.nan
    return reliable_share(reliable_and_artificial_change(data, side, *ends))


def edge_source(data: Datasets, side: str) -> str:
    """Return whether an edge rests on artificial roughness, as the source of its number.

    "artificial": the edge, or its bound, lies at an artificial wavelength, or artificial roughness
    causes more than 90 % of the change. "partly_artificial": it causes 10 to 90 % of the change.
    "interval_artificial": only the interval reaches artificial wavelengths. Otherwise "measured".
    """
    side_edges = data.edges.sel(side=side)
    bands = artificial_bands(data.spectra)
    edge = float(side_edges["edge"].fillna(side_edges["edge_bound"]))
    share = measured_share_at_edge(data, side)
    if overlaps_any(edge, edge, bands) or share < 1 - NEARLY_ALL:
        return "artificial"
    if share < NEARLY_ALL:
        return "partly_artificial"
    low, high = side_edges["edge_interval"].fillna(edge).values
    return "interval_artificial" if overlaps_any(low, high, bands) else "measured"
