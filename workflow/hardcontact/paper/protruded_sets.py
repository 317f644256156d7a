"""Sets in which the scans of one surface have rare protrusions, and what they say of adhesion.

A surface has the same protrusions on all of its scans; another draw of them makes another surface.
"""

from collections.abc import Sequence

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.base.job import progress
from hardcontact.base.random import generator
from hardcontact.contact.force_curves import on_fine_grid
from hardcontact.paper.inference import PLASTIC, Published
from hardcontact.paper.leave_one_out import fitted_pairs
from hardcontact.paper.pool import PoolSources, forces_at_heights, height_weights
from hardcontact.surfaces.conditioning import group_heights
from hardcontact.surfaces.height_map import level
from hardcontact.surfaces.protrusions import draw_protrusions, with_protrusions
from hardcontact.surfaces.substitute_scans import drawn_scan

#: A set agrees where mean and median force of the protruded surface lie within this factor of the
#: published ones, at the range and work of adhesion that fit the set best.
FACTOR = 2.0
NEWTON = {"units": "N"}
#: Of protrusions, with their units.
OF_PROTRUSIONS = {"density": "um-2", "height": "1", "width": "nm"}


def compute_protruded(numbers: Sequence[int], scans: int, sources: PoolSources) -> xr.Dataset:
    """Return the forces of some protruded surfaces, each with so many scans, on a smooth sphere.

    Parameters
    ----------
    numbers : sequence of int
        Of the surfaces.
    scans : int
        Of each surface. Their rms heights get the mean and the deviation of the targets.
    sources : PoolSources
        Of the surface without protrusions.

    Returns
    -------
    xarray.Dataset
        Over variant: ``pull_off_force`` (rho, contact) in N at 1 J/m² of all contacts on all scans,
        plastic, and ``density`` (1/µm²), ``height`` (rms heights) and ``width`` (nm).
    """
    surfaces = [
        _protruded_surface(number, scans, sources)
        for number in progress(numbers, len(numbers), "protruded surfaces")
    ]
    return xr.concat(surfaces, pd.Index(list(numbers), name="variant"))


def _protruded_surface(number: int, scans: int, sources: PoolSources) -> xr.Dataset:
    """Return forces and protrusions of one surface."""
    density, targets, heights, settings = sources
    seed, surface = settings["seed"], settings["surface"]
    protrusions = draw_protrusions(generator(seed, surface, number, "protrusions"))
    log_forces, rms_heights = [], []
    for scan_number in range(1, scans + 1):
        rng = generator(seed, surface, number, scan_number, "protruded scan")
        scan = level(drawn_scan(rng, density, settings["scan"]))
        protruded = with_protrusions(rng, scan, protrusions)
        computed = forces_at_heights(protruded, heights, settings["contact"], settings["ranges"])
        log_forces.append(computed["log_force"].sel(contact_model=PLASTIC, drop=True))
        rms_heights.append(computed["rms_height"].item())
    # With more scans than five a height of a group may lie below those computed.
    wanted = group_heights(np.array(rms_heights), targets.means["rms_height"], targets.deviation)
    weights = height_weights(heights, np.maximum(wanted, heights[0]))
    by_scan = [
        log_force.dot(xr.DataArray(weight, dims="rms_height_of_force"))
        for log_force, weight in zip(log_forces, weights, strict=True)
    ]
    forces: xr.DataArray = xr.apply_ufunc(np.exp, xr.concat(by_scan, "scan"))
    forces = forces.stack(contact=["scan", "contact_y", "contact_x"])
    values = {name: ((), getattr(protrusions, name), {"units": unit})
              for name, unit in OF_PROTRUSIONS.items()}  # fmt: skip
    force = forces.transpose("rho", "contact").drop_vars(
        ["contact", *forces.indexes["contact"].names]
    )
    return xr.Dataset({"pull_off_force": force.assign_attrs(NEWTON), **values})


def judge_protruded(
    protruded: xr.Dataset, surface: str, sets: xr.Dataset, measured: Published
) -> xr.Dataset:
    """Fit range and work of adhesion to each set with each protruded surface in place of its own.

    Parameters
    ----------
    protruded : xarray.Dataset
        Of `compute_protruded`.
    surface : str
        The surface that has protrusions.
    sets : xarray.Dataset
        ``mean_force`` (set, surface, rho) and ``sphere_factor`` (surface, rho) of plastic contact,
        as in sets.nc.
    measured : Published
        Published forces, range and work of adhesion.

    Returns
    -------
    xarray.Dataset
        Over (variant, set): ``range_of_adhesion`` (nm), ``work_of_adhesion`` (J/m²),
        ``best_error``, and at this pair ``mean_force`` and ``median_force`` (N) of the protruded
        surface; ``agrees`` is 1 where both lie within FACTOR of the published ones. Over variant,
        at the published pair: ``mean_at_published``, ``median_at_published`` and
        ``spread_at_published``, the standard deviation of ln F; and density, height and width of
        the protrusions.
    """
    factor = sets["sphere_factor"].sel(surface=surface, drop=True)
    forces = (protruded["pull_off_force"] * factor).transpose("variant", "contact", "rho")
    published, ranges = measured.forces, forces["rho"].values
    curves = sets["mean_force"].where(sets["surface"] != surface, forces.mean("contact"))
    fits = fitted_pairs(curves.transpose("variant", "set", ...), published["mean_force"])
    shape = tuple(fits.sizes.values())
    means, medians = np.empty(shape), np.empty(shape)
    for place in range(len(forces)):
        fit = fits.isel(variant=place)
        at_fit = on_fine_grid(forces.values[place], ranges, fit["range_of_adhesion"].values)
        at_fit = at_fit * fit["work_of_adhesion"].values  # (contact, set)
        means[place], medians[place] = at_fit.mean(axis=0), np.median(at_fit, axis=0)
    agrees = np.ones(shape, bool)
    for name, values in (("mean_force", means), ("median_force", medians)):
        agrees &= abs(np.log(values / published[name][surface])) <= np.log(FACTOR)
    rho, work = measured.pair
    at_published = on_fine_grid(forces.values, ranges, np.array([rho]))[..., 0] * work
    return fits.assign(
        mean_force=(("variant", "set"), means, NEWTON),
        median_force=(("variant", "set"), medians, NEWTON),
        agrees=(("variant", "set"), agrees.astype("int8")),
        mean_at_published=("variant", at_published.mean(axis=1), NEWTON),
        median_at_published=("variant", np.median(at_published, axis=1), NEWTON),
        spread_at_published=("variant", np.log(at_published).std(axis=1), {"units": "1"}),
    ).assign(protruded[list(OF_PROTRUSIONS)])


def none_protruded(ranges: np.ndarray) -> xr.Dataset:
    """Return what `compute_protruded` gives of no surface at ranges of adhesion (rho,) in nm."""
    forces = np.empty((0, len(ranges), 1))
    return xr.Dataset(
        {
            "pull_off_force": (("variant", "rho", "contact"), forces, NEWTON),
            **{name: ("variant", [], {"units": unit}) for name, unit in OF_PROTRUSIONS.items()},
        },
        {"variant": np.arange(0), "rho": ranges},
    )
