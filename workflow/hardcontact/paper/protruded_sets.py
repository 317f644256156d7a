"""Sets in which one surface has rare protrusions: forces, and fits of range and work of adhesion.

All scans of a surface have protrusions of one density, height and width. Another draw of these
makes another surface, a variant.
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

#: A set agrees if the mean and the median force of the protruded surface are within this factor of
#: the published forces. Both are taken at the range and work of adhesion that fit the set best.
FACTOR = 2.0
NEWTON = {"units": "N"}
#: Units of the fields of `Protrusions`.
PROTRUSION_UNITS = {"density": "um-2", "height": "1", "width": "nm"}


def compute_protruded(numbers: Sequence[int], scans: int, sources: PoolSources) -> xr.Dataset:
    """Compute the forces of a smooth sphere on several protruded surfaces.

    Parameters
    ----------
    numbers : sequence of int
        Numbers of the surfaces.
    scans : int
        Scans of each surface. Their rms heights get the mean and the deviation of the targets.
    sources : PoolSources
        Spectrum and targets of the surface without protrusions.

    Returns
    -------
    xarray.Dataset
        ``pull_off_force`` (variant, rho, contact) in N at 1 J/m², plastic, of all contacts on all
        scans; ``density`` (1/µm²), ``height`` (rms heights) and ``width`` (nm) over variant.
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
    # With six scans or more a height may lie below the least height of the forces.
    wanted = group_heights(np.array(rms_heights), targets.means["rms_height"], targets.deviation)
    weights = height_weights(heights, np.maximum(wanted, heights[0]))
    by_scan = [
        log_force.dot(xr.DataArray(weight, dims="rms_height_of_force"))
        for log_force, weight in zip(log_forces, weights, strict=True)
    ]
    forces: xr.DataArray = xr.apply_ufunc(np.exp, xr.concat(by_scan, "scan"))
    forces = forces.stack(contact=["scan", "contact_y", "contact_x"])
    values = {name: ((), getattr(protrusions, name), {"units": unit})
              for name, unit in PROTRUSION_UNITS.items()}  # fmt: skip
    force = forces.transpose("rho", "contact").drop_vars(
        ["contact", *forces.indexes["contact"].names]
    )
    return xr.Dataset({"pull_off_force": force.assign_attrs(NEWTON), **values})


def judge_protruded(
    protruded: xr.Dataset, surface: str, sets: xr.Dataset, measured: Published
) -> xr.Dataset:
    """Fit range and work of adhesion to every set, with every protruded surface put into it.

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
        The `fitted_pairs` over (variant, set). At the fitted pair ``mean_force`` and
        ``median_force`` (variant, set) of the protruded surface in N; ``agrees`` (variant, set) is
        1 if both are within FACTOR of the published forces. At the published pair
        ``mean_at_published`` and ``median_at_published`` (variant) in N and
        ``spread_at_published`` (variant), the standard deviation of ln F. The fields of
        `Protrusions` (variant).
    """
    factor = sets["sphere_factor"].sel(surface=surface, drop=True)
    forces = (protruded["pull_off_force"] * factor).transpose("variant", "contact", "rho")
    published, ranges = measured.forces, forces["rho"].values
    curves = sets["mean_force"].where(sets["surface"] != surface, forces.mean("contact"))
    fits = fitted_pairs(curves.transpose("variant", "set", ...), published["mean_force"])
    shape = tuple(fits.sizes.values())
    means, medians = np.empty(shape), np.empty(shape)
    for row in range(len(forces)):
        fit = fits.isel(variant=row)
        at_fit = on_fine_grid(forces.values[row], ranges, fit["range_of_adhesion"].values)
        at_fit = at_fit * fit["work_of_adhesion"].values  # (contact, set)
        means[row] = at_fit.mean(axis=0)
        medians[row] = np.median(at_fit, axis=0)
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
    ).assign(protruded[list(PROTRUSION_UNITS)])


def none_protruded(ranges: np.ndarray) -> xr.Dataset:
    """Return the result of `compute_protruded` for no surface; ranges of adhesion (rho,) in nm."""
    forces = np.empty((0, len(ranges), 1))
    return xr.Dataset(
        {
            "pull_off_force": (("variant", "rho", "contact"), forces, NEWTON),
            **{name: ("variant", [], {"units": unit}) for name, unit in PROTRUSION_UNITS.items()},
        },
        {"variant": np.arange(0), "rho": ranges},
    )
