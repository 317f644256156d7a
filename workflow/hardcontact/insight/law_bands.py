"""The critical band of every law of attraction, from forces of filtered masters by range."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.adhesion.named_surfaces import Described, with_names
from hardcontact.adhesion.sampling import Sampling
from hardcontact.insight.interaction_laws import LAWS, Law
from hardcontact.insight.law_forces import law_forces
from hardcontact.records.dataset import stack
from hardcontact.scales.critical_band import critical_band
from hardcontact.scales.cutoffs import last_cutoff
from hardcontact.statistics import jackknife_interval, with_interval

__all__ = ["bands_of_law", "edge_factors", "stacked_law_forces"]


def stacked_law_forces(
    scans: Mapping[tuple[Any, ...], xr.Dataset],
    sides: Mapping[str, Mapping[tuple[Any, ...], xr.Dataset]],
    described: Described,
) -> tuple[xr.Dataset, xr.Dataset]:
    """Return what `compare_laws` takes from the files of single scans.

    Parameters
    ----------
    scans : mapping of tuple to xarray.Dataset
        (surface, scan) -> `law_forces.scan_range_forces`.
    sides : mapping of str to such a mapping
        Side -> (surface, scan) -> `law_forces.filtered_range_forces` of its master.
    described : Described
        Labels and bases.

    Returns
    -------
    forces, masters : xarray.Dataset
        Each scan is one realization of its masters.
    """
    forces = stack(scans, ["surface", "scan"])
    surfaces = [str(surface) for surface in forces.surface.values]
    by_side = {(*key, side): part for side, parts in sides.items() for key, part in parts.items()}
    masters = stack(
        dict(sorted(by_side.items(), key=lambda one: surfaces.index(str(one[0][0])))),
        ["surface", "realization", "side"],
    )
    ends = masters.unfiltered_wavelength.mean("realization")
    return with_names(forces, described), masters.assign(unfiltered_wavelength=ends)


def _scales(law: Law, length: float, masters: xr.Dataset) -> xr.Dataset:
    """Return what `critical_band` takes, of one law at one length."""
    filtered, unfiltered = (
        xr.apply_ufunc(
            lambda one: law_forces(law, [length], masters.rho.values, one)[..., 0],
            masters[name],
            input_core_dims=[["rho"]],
        )
        for name in ("pull_off_force", "unfiltered_pull_off_force")
    )
    return xr.Dataset(
        {"ratio": filtered / unfiltered, "unfiltered_wavelength": masters.unfiltered_wavelength}
    )


def bands_of_law(
    law: Law, lengths: pd.Series, masters: xr.Dataset, tolerance: float, sampling: Sampling
) -> xr.Dataset:
    """Return ratio curves and critical wavelengths of one law at several lengths.

    Parameters
    ----------
    law : Law
        Any of the laws.
    lengths : pandas.Series
        Its ranges in nm, by case.
    masters : xarray.Dataset
        As from `stacked_law_forces`.
    tolerance : float
        Relative change of the force that ends the band.
    sampling : Sampling
        Of the intervals.

    Returns
    -------
    xarray.Dataset
        `scale_ratio` and `critical_wavelength` of `critical_band` with intervals, over case.
    """
    bands = [
        critical_band(_scales(law, length, masters), tolerance, sampling) for length in lengths
    ]
    kept = ["scale_ratio", "critical_wavelength"]
    names = [name for one in kept for name in (one, f"{one}_interval")]
    return xr.concat([band[names] for band in bands], lengths.index)


def edge_factors(
    lengths: Mapping[str, float], masters: xr.Dataset, tolerance: float, sampling: Sampling
) -> dict[str, Any]:
    """Return the edges of every law over those of Eq. 1.

    Parameters
    ----------
    lengths : mapping of str to float
        Range in nm of each law, by its name.
    masters : xarray.Dataset
        As from `stacked_law_forces`.
    tolerance : float
        Relative change of the force that ends the band.
    sampling : Sampling
        Its confidence is that of the interval, by the jackknife over realizations.

    Returns
    -------
    dict
        ``edge_factor`` (law, side, group) and its interval. A curve that never leaves counts as
        its last cutoff.
    """
    left_out = [masters.drop_isel(realization=n) for n in range(masters.sizes["realization"])]
    factors, *without = (
        _edge_factors(lengths, part, tolerance, sampling)
        for part in (masters, *(left_out if len(left_out) > 1 else []))
    )
    interval = jackknife_interval(
        factors, np.reshape(without, (-1, *factors.shape)), sampling.confidence
    )
    return with_interval(
        "edge_factor",
        [str(dimension) for dimension in factors.dims],
        factors.values,
        interval,
        {"units": "1", "long_name": "edge of the band over that of Eq. 1"},
        sampling.confidence,
    )


def _edge_factors(
    lengths: Mapping[str, float], masters: xr.Dataset, tolerance: float, sampling: Sampling
) -> xr.DataArray:
    """Return the factors (law, side, group) of some realizations."""
    edges = []
    for law in LAWS:
        scales = _scales(law, lengths[law.name], masters)
        band = critical_band(scales, tolerance, replace(sampling, samples=0))
        edges.append(band.critical_wavelength.fillna(_last_cutoffs(scales)))
    stacked = xr.concat(edges, pd.Index([law.name for law in LAWS], name="law"))
    ratio: xr.DataArray = stacked / edges[0]
    return ratio.transpose("law", "side", "group")


def _last_cutoffs(scales: xr.Dataset) -> xr.DataArray:
    """Return the cutoff (side,) farthest from no filter."""
    sides = scales.side.values.tolist()
    last = [last_cutoff(scales.ratio.sel(side=side), side) for side in sides]
    return xr.DataArray(last, {"side": sides})
