"""The datasets of one set of scans, shaped as those of the study that claims are about."""

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
import xarray as xr

from hardcontact.adhesion.sampling import Sampling
from hardcontact.random import generator
from hardcontact.scales.critical_band import critical_band
from hardcontact.sets.drawing import draw_scans, with_sampled_mean
from hardcontact.surfaces.roughness_table import averages
from hardcontact.surfaces.topography import METRICS

__all__ = ["Draw", "Sources", "drawn_scans", "set_adhesion", "set_band", "set_topography"]

#: Scans of one set, by substrate.
Drawn = Mapping[str, xr.Dataset]


class Sources(NamedTuple):
    """What all sets are made from.

    Attributes
    ----------
    topography, adhesion : xarray.Dataset
        Of the study.
    pools : mapping of str to xarray.Dataset
        Of `pool.compute_pool`, by substrate; a substrate without one keeps its scans.
    sphere_factor : xarray.DataArray
        (contact_model, surface, rho) force on the rough sphere over that on a smooth one, of
        substrates with a pool.
    masters : xarray.Dataset
        Of `all_surfaces.stacked_ratios`.
    """

    topography: xr.Dataset
    adhesion: xr.Dataset
    pools: Mapping[str, xr.Dataset]
    sphere_factor: xr.DataArray
    masters: xr.Dataset


class Draw(NamedTuple):
    """Which of all sets it is.

    Attributes
    ----------
    seed : int
        The seed of the study.
    number : int
        Of the set.
    """

    seed: int
    number: int

    def generator(self, surface: str, purpose: str) -> np.random.Generator:
        """Return the random generator for one purpose on one surface."""
        return generator(self.seed, surface, self.number, "set", purpose)


def drawn_scans(sources: Sources, draw: Draw) -> dict[str, xr.Dataset]:
    """Return the scans of a set by substrate, of those with a pool; as many as the study has."""
    return {
        surface: draw_scans(
            pool,
            draw.generator(surface, "scans"),
            int(sources.topography["rms_height"].sel(surface=surface).count()),
        )
        for surface, pool in sources.pools.items()
    }


def set_topography(study: xr.Dataset, drawn: Drawn, confidence: float) -> xr.Dataset:
    """Return the topography of a set: METRICS, their averages, and all that scans do not enter.

    Parameters
    ----------
    study : xarray.Dataset
        As topography.nc.
    drawn : mapping of str to xarray.Dataset
        Of `drawn_scans`; other surfaces keep their scans.
    confidence : float
        Of the intervals.

    Returns
    -------
    xarray.Dataset
        Over surface and scan.
    """
    parts = [
        drawn[name] if name in drawn else study.sel(surface=name, drop=True)
        for name in study["surface"].values
    ]
    scans = xr.concat([part[list(METRICS)] for part in parts], study["surface"], join="outer")
    constant = [name for name in study if str(name).startswith("all_scales_")]
    named = study[[*constant, "label", "basis", "calibrated_to_table1"]]
    return xr.merge([named, scans, averages(scans, confidence)], combine_attrs="override")


def set_adhesion(sources: Sources, drawn: Drawn, draw: Draw) -> xr.Dataset:
    """Return the pull-off forces of a set, as adhesion.nc has them.

    Forces of drawn scans are those on a smooth sphere times what its roughness changes.

    Parameters
    ----------
    sources : Sources
        What all sets are made from.
    drawn : mapping of str to xarray.Dataset
        Of `drawn_scans`; other substrates keep their scans and get another mean.
    draw : Draw
        Which of all sets it is.

    Returns
    -------
    xarray.Dataset
        ``pull_off_force`` (surface, scan, sphere_scan, contact_model, rho, contact_y, contact_x).
    """
    study, parts = sources.adhesion, []
    for surface in study["surface"].values.tolist():
        if surface in drawn:
            factor = sources.sphere_factor.sel(surface=surface, drop=True)
            forces = (drawn[surface]["pull_off_force"] * factor).expand_dims(sphere_scan=[1])
        else:
            own = study["pull_off_force"].sel(surface=surface, drop=True)
            own = own.dropna("scan", how="all").dropna("sphere_scan", how="all")
            forces = with_sampled_mean(own, draw.generator(surface, "mean force"))
        parts.append(forces)
    stacked = xr.concat(parts, study["surface"], join="outer")
    return study[["label", "basis", "contact_pixels"]].assign(
        pull_off_force=stacked.transpose(*study["pull_off_force"].dims)
    )


def set_band(
    masters: xr.Dataset, realizations: int, tolerance: float, sampling: Sampling, draw: Draw
) -> xr.Dataset:
    """Return the critical band of some masters of each substrate, drawn with replacement.

    Parameters
    ----------
    masters : xarray.Dataset
        Of `all_surfaces.stacked_ratios`.
    realizations : int
        Masters of each substrate in a set.
    tolerance : float
        Relative change of the force that counts.
    sampling : Sampling
        Without samples.
    draw : Draw
        Which of all sets it is.

    Returns
    -------
    xarray.Dataset
        As band.nc, without labels.
    """
    parts = []
    for surface in masters["surface"].values.tolist():
        known = masters["ratio"].sel(surface=surface).dropna("realization", how="all")
        chosen = draw.generator(surface, "masters").choice(known.realization, realizations)
        ratio = known.sel(realization=chosen).assign_coords(realization=range(realizations))
        parts.append(ratio.drop_vars("surface"))
    ratio = xr.concat(parts, masters["surface"])
    return critical_band(masters.drop_dims("realization").assign(ratio=ratio), tolerance, sampling)
