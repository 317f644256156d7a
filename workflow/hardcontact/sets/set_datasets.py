"""The datasets of one set of scans, shaped as those of the study that claims are about.

A set takes scans of a pool and gives each its height, from which its forces follow.
"""

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from hardcontact.numbers.interpolation import height_weights
from hardcontact.numbers.random import generator
from hardcontact.numbers.statistics import Sampling, student_log_samples
from hardcontact.scales.critical_band import critical_band
from hardcontact.surfaces.conditioning import group_heights
from hardcontact.surfaces.roughness_table import averages
from hardcontact.surfaces.topography import METRICS

Floats = NDArray[np.float64]

#: Metrics that do not change with the height of a scan.
SHAPES = ("skewness", "kurtosis")

#: How often a set is drawn in search of one with the heights asked for.
TRIES = 1000

#: Scans of one set, by substrate.
Drawn = Mapping[str, xr.Dataset]


def draw_scans(pool: xr.Dataset, rng: np.random.Generator, scans: int) -> xr.Dataset:
    """Draw a set of scans of one substrate from its pool, without replacement.

    A set of which a height would be below those of the pool is drawn again: with six scans or more
    it could be negative; ValueError if none is found. METRICS and `number` in the pool are over
    scan, which counts from 1; `pull_off_force` (scan, contact_model, rho, contact_y, contact_x) in
    N is that on a smooth sphere.
    """
    known = pool["rms_height_of_force"].values
    for _ in range(TRIES):
        drawn = pool.isel(scan=rng.choice(pool.sizes["scan"], scans, replace=False))
        heights = group_heights(
            drawn["rms_height"].values,
            pool.attrs["mean_rms_height"],
            pool.attrs["rms_height_deviation"],
        )
        if heights.min() >= known.min() * (1 - 1e-9):
            return _at_heights(drawn, heights)
    raise ValueError(
        f"expected sets of {scans} scans with rms heights of {pool.attrs['mean_rms_height']:.3g} "
        f"+- {pool.attrs['rms_height_deviation']:.3g} nm, found none above {known.min():.3g} nm in "
        f"{TRIES} tries"
    )


def _at_heights(drawn: xr.Dataset, heights: Floats) -> xr.Dataset:
    """Return scans of a pool with their forces and metrics at other rms heights (scan,) in nm."""
    factor = heights / drawn["rms_height"].values
    weights = height_weights(drawn["rms_height_of_force"].values, heights)
    log_forces = np.einsum("na,na...->n...", weights, drawn["log_force"].values)
    axes = ("scan", "contact_model", "rho", "contact_y", "contact_x")
    metrics = {
        name: ("scan", drawn[name].values * (1.0 if name in SHAPES else factor), drawn[name].attrs)
        for name in METRICS
    }
    return xr.Dataset(
        {
            **metrics,
            "pull_off_force": (axes, np.exp(log_forces), {"units": "N"}),
            "number": ("scan", drawn["scan"].values),
        },
        {"scan": np.arange(1, len(heights) + 1), **{name: drawn[name] for name in axes[1:]}},
    )


def with_sampled_mean(forces: xr.DataArray, rng: np.random.Generator) -> xr.DataArray:
    """Return the forces of measured scans times one sample of what their mean may be.

    Other scans of the surface would have another mean force; the scans that there are keep their
    distribution over contacts, and a single scan is left as it is. Forces (scan, sphere_scan,
    contact_model, rho, contact_y, contact_x) are in N.
    """
    axes = ("scan", "contact_model", "rho")
    means = forces.mean([dim for dim in forces.dims if dim not in axes]).transpose(*axes)
    if means.sizes["scan"] < 2:
        return forces
    sample = student_log_samples(rng, means.values, 1)[0]
    factor = xr.DataArray(sample, dims=axes[1:]) / means.mean("scan").drop_vars(axes[1:])
    return (forces * factor).transpose(*forces.dims)


class Sources(NamedTuple):
    """What all sets are made from."""

    topography: xr.Dataset  #: Of the study.
    adhesion: xr.Dataset  #: Of the study.
    #: Of `pool.compute_pool`, by substrate; a substrate without one keeps its scans.
    pools: Mapping[str, xr.Dataset]
    #: (contact_model, surface, rho) force on the rough sphere over that on a smooth one, of
    #: substrates with a pool.
    sphere_factor: xr.DataArray
    masters: xr.Dataset  #: Of `all_surfaces.stacked_forces` at one load.


class Draw(NamedTuple):
    """Which of all sets it is."""

    seed: int  #: The seed of the study.
    number: int  #: Of the set.

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
    """Return METRICS, their averages, and all that scans do not enter, as topography.nc has them.

    Surfaces without drawn scans keep those of the study.
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

    Forces of drawn scans are those on a smooth sphere times what its roughness changes. Other
    substrates keep their scans and get another mean.
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

    `realizations` masters of each are drawn from `all_surfaces.stacked_forces` at one load; as
    band.nc, without labels.
    """
    parts = []
    for surface in masters["surface"].values.tolist():
        known = masters["ratio"].sel(surface=surface).dropna("realization", how="all")
        chosen = draw.generator(surface, "masters").choice(known.realization, realizations)
        ratio = known.sel(realization=chosen).assign_coords(realization=range(realizations))
        parts.append(ratio.drop_vars("surface"))
    ratio = xr.concat(parts, masters["surface"])
    return critical_band(masters.drop_dims("realization").assign(ratio=ratio), tolerance, sampling)
