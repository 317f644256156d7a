"""Sets with rare protrusions on one coating or on the sphere: forces, fits of range and work.

All scans of a coating have protrusions of the same density, height and width. A draw is one random
choice of these three numbers.
"""

from collections.abc import Iterable, Sequence
from dataclasses import replace

import numpy as np
import pandas as pd
import xarray as xr
from numpy.typing import NDArray

from hardcontact.base.job import progress
from hardcontact.base.random import generator
from hardcontact.base.units import DIMENSIONLESS, NEWTON
from hardcontact.contact.force_curves import interpolate_to_ranges
from hardcontact.contact.geometry import bodies
from hardcontact.contact.pull_off import pull_off_forces, range_axis
from hardcontact.inference.fit import fit_mean_forces
from hardcontact.inference.published_fit import PublishedFit
from hardcontact.paper.pool import PoolSettings, PoolSources
from hardcontact.surfaces.conditioning import scale_rms_heights
from hardcontact.surfaces.height_map import HeightMap, level, mirror_stitch
from hardcontact.surfaces.protrusions import PublishedRoughness, add_protrusions, sample_protrusions
from hardcontact.surfaces.substitute_scans import sample_scan
from hardcontact.surfaces.substitute_spectra import rows_of_surface

#: Largest factor between computed and published force of a set that agrees. It holds for the mean
#: and the median force of the protruded surface, at the best range and work of adhesion of the set.
MAX_FORCE_FACTOR = 2.0
Floats = NDArray[np.float64]
#: Units of the fields of `Protrusions`, as variables of a dataset.
PROTRUSION_UNITS = {
    "protrusion_density": "um-2",
    "protrusion_height": "1",
    "protrusion_width": "nm",
}


def published_roughness(
    table1: pd.DataFrame, constants: pd.DataFrame, coating: str
) -> PublishedRoughness:
    """Return the published roughness of a coating and of the sphere.

    table1, constants: from `published.table1` and `published.constants`.
    Returns rms height, rms slope and largest rms slope of the coating, and the largest rms height
        of the sphere.
    """
    rows = rows_of_surface(table1, coating)
    slope = float(rows["value"]["afm_rms_slope"])
    return PublishedRoughness(
        rms_height=float(rows["value"]["afm_rms_height"]),
        rms_slope=slope,
        max_rms_slope=slope + float(rows["uncertainty"]["afm_rms_slope"]),
        max_sphere_rms_height=float(constants["value"]["sphere_rms_height_upper_bound"]),
    )


def compute_protruded_forces(
    draw_numbers: Sequence[int],
    scan_count: int,
    sources: PoolSources,
    roughness: PublishedRoughness,
    protruded_body: str,
) -> xr.Dataset:
    """Compute the forces between sphere and coating if either of them has protrusions.

    Forces depend on the gap alone. Protrusions of the sphere are therefore added to the heights of
    the coating, at random positions on each scan, as if each scan met another sphere. A coating
    with protrusions of its own is scaled back to its rms height.

    draw_numbers: numbers of the draws. Each draw has other protrusions.
    scan_count: number of scans of the coating in each draw. Their rms heights are scaled to the
        mean and the standard deviation of the targets; those below the smallest rms height of the
        pool are raised to it.
    sources: spectrum and targets of the coating without protrusions.
    roughness: published roughness, which limits protrusions.
    protruded_body: name of the body with protrusions: the coating or the sphere. Protrusions of the
        sphere are the same for all coatings.
    Returns ``pull_off_force`` (draw, rho, contact) in N at 1 J/m², plastic, of a smooth sphere at
        all contacts on all scans; ``mean_force_ratio`` (draw, rho), the mean force relative to the
        mean force without protrusions; ``protrusion_density`` (1/µm²), ``protrusion_height`` (rms
        heights) and ``protrusion_width`` (nm) by draw.
    """
    draw_datasets = [
        _protruded_forces(number, scan_count, sources, roughness, protruded_body)
        for number in progress(draw_numbers, len(draw_numbers), "protruded surfaces")
    ]
    axis = pd.Index(list(draw_numbers), name="draw")
    return xr.concat(draw_datasets, axis).assign_attrs(surface=sources.settings["surface"])


def _protruded_forces(
    draw_number: int,
    scan_count: int,
    sources: PoolSources,
    roughness: PublishedRoughness,
    protruded_body: str,
) -> xr.Dataset:
    """Return forces and protrusions of one draw."""
    spectrum, targets, pool_rms_heights, settings = sources
    seed = settings["seed"]
    coating = settings["surface"]
    sphere_is_protruded = protruded_body != coating
    protrusion_rng = generator(seed, protruded_body, draw_number, "protrusions")
    protrusions = sample_protrusions(protrusion_rng, roughness, sphere_is_protruded)
    scan_rngs = [
        generator(seed, coating, draw_number, scan_number, "protruded scan")
        for scan_number in range(1, scan_count + 1)
    ]
    unscaled_scans = [level(sample_scan(rng, spectrum, settings["scan"])) for rng in scan_rngs]
    rms_heights = np.array([scan.heights.std() for scan in unscaled_scans])
    target_rms_heights = scale_rms_heights(
        rms_heights, targets.means["rms_height"], targets.rms_height_std
    )
    # With six scans or more, a target may be below the smallest rms height of the pool.
    target_rms_heights = np.maximum(target_rms_heights, pool_rms_heights[0])
    forces = []
    unprotruded_forces = []
    for rng, scan, rms_height in zip(scan_rngs, unscaled_scans, target_rms_heights, strict=True):
        scan = _scale_scan(scan, rms_height)
        if sphere_is_protruded:
            protruded_scan = add_protrusions(rng, scan, protrusions, roughness.rms_height)
        else:
            protruded_scan = level(add_protrusions(rng, scan, protrusions, rms_height))
            protruded_scan = _scale_scan(protruded_scan, rms_height)
        forces.append(_scan_forces(protruded_scan, settings))
        unprotruded_forces.append(_scan_forces(scan, settings))
    force_ratio = np.mean(forces, axis=(0, 2)) / np.mean(unprotruded_forces, axis=(0, 2))
    values = {
        name: ((), getattr(protrusions, name.removeprefix("protrusion_")), {"units": unit})
        for name, unit in PROTRUSION_UNITS.items()
    }
    return xr.Dataset(
        {
            "pull_off_force": (("rho", "contact"), np.concatenate(forces, axis=1), NEWTON),
            "mean_force_ratio": ("rho", force_ratio, DIMENSIONLESS),
            **values,
        },
        range_axis(settings["ranges"]),
    )


def _scale_scan(scan: HeightMap, rms_height: float) -> HeightMap:
    """Return the scan with another rms height (nm)."""
    return replace(scan, heights=rms_height / scan.heights.std() * scan.heights)


def _scan_forces(scan: HeightMap, settings: PoolSettings) -> Floats:
    """Return the plastic forces (rho, contact) of a smooth sphere on a scan, in N at 1 J/m²."""
    contact = settings["contact"]
    ranges = settings["ranges"]
    contact_bodies = bodies(mirror_stitch(scan), None, contact)
    return np.reshape(pull_off_forces(contact_bodies, [contact], ranges)[0], (len(ranges), -1))


def fit_protruded_sets(
    draw_datasets: Iterable[xr.Dataset], surface: str, sets: xr.Dataset, published: PublishedFit
) -> xr.Dataset:
    """Fit range and work of adhesion to every set, with the protrusions of every draw.

    The forces with protrusions replace the forces of the sets on this surface. The mean forces on
    other surfaces are multiplied by the ratio of the forces with and without protrusions.

    draw_datasets: from `compute_protruded_forces`: the same draws for each surface whose forces
        change.
    surface: the surface whose mean and median force decide whether a set agrees.
    sets: sets.nc for plastic contact: ``mean_force`` (set, surface, rho) and ``sphere_factor``
        (surface, rho).
    published: published forces, range and work of adhesion.
    Returns the `fit_mean_forces` by (draw, set). At the fitted pair ``mean_force_at_fit`` and
        ``median_force_at_fit`` (draw, set) of the coating in N; ``agrees`` (draw, set) is 1 if both
        are within the factor MAX_FORCE_FACTOR of the published forces. At the published pair
        ``mean_force_at_published`` and ``median_force_at_published`` (draw) in N and
        ``log_force_std_at_published`` (draw), the standard deviation of ln F. The variables of
        PROTRUSION_UNITS (draw).
    """
    draws_by_surface: dict[str, list[xr.Dataset]] = {}
    for draw_dataset in draw_datasets:
        draws_by_surface.setdefault(draw_dataset.attrs["surface"], []).append(draw_dataset)
    forces_by_surface = {
        name: xr.concat(surface_draws, "draw") for name, surface_draws in draws_by_surface.items()
    }
    sphere_factor = sets["sphere_factor"].sel(surface=surface, drop=True)
    forces = forces_by_surface[surface]["pull_off_force"] * sphere_factor
    forces = forces.transpose("draw", "contact", "rho")
    ranges = forces["rho"].values
    force_ratios = [draws["mean_force_ratio"] for draws in forces_by_surface.values()]
    force_ratio = xr.concat(force_ratios, pd.Index(list(forces_by_surface), name="surface"))
    curves = sets["mean_force"] * force_ratio.reindex(surface=sets["surface"], fill_value=1.0)
    curves = curves.where(sets["surface"] != surface, forces.mean("contact"))
    fits = fit_mean_forces(curves.transpose("draw", "set", ...), published.forces["mean_force"])
    shape = tuple(fits.sizes.values())
    means = np.empty(shape)
    medians = np.empty(shape)
    for draw, draw_forces in enumerate(forces.values):
        fit = fits.isel(draw=draw)
        fitted_forces = interpolate_to_ranges(draw_forces, ranges, fit["range_of_adhesion"].values)
        fitted_forces = fitted_forces * fit["work_of_adhesion"].values  # (contact, set)
        means[draw] = fitted_forces.mean(axis=0)
        medians[draw] = np.median(fitted_forces, axis=0)
    agrees = np.ones(shape, bool)
    for name, values in (("mean_force", means), ("median_force", medians)):
        agrees &= abs(np.log(values / published.forces[name][surface])) <= np.log(MAX_FORCE_FACTOR)
    rho, work = published.pair
    published_pair_forces = (
        interpolate_to_ranges(forces.values, ranges, np.array([rho]))[..., 0] * work
    )
    return fits.assign(
        mean_force_at_fit=(("draw", "set"), means, NEWTON),
        median_force_at_fit=(("draw", "set"), medians, NEWTON),
        agrees=(("draw", "set"), agrees.astype("int8")),
        mean_force_at_published=("draw", published_pair_forces.mean(axis=1), NEWTON),
        median_force_at_published=("draw", np.median(published_pair_forces, axis=1), NEWTON),
        log_force_std_at_published=(
            "draw",
            np.log(published_pair_forces).std(axis=1),
            DIMENSIONLESS,
        ),
    ).assign(forces_by_surface[surface][list(PROTRUSION_UNITS)])


def empty_protruded_forces(surface: str, ranges: np.ndarray) -> xr.Dataset:
    """Return the dataset of `compute_protruded_forces` without any draw.

    ranges: ranges of adhesion (rho,) in nm.
    Returns as from `compute_protruded_forces`; the dimension draw has the length zero.
    """
    forces = np.empty((0, len(ranges), 1))
    return xr.Dataset(
        {
            "pull_off_force": (("draw", "rho", "contact"), forces, NEWTON),
            "mean_force_ratio": (("draw", "rho"), forces[..., 0], DIMENSIONLESS),
            **{name: ("draw", [], {"units": unit}) for name, unit in PROTRUSION_UNITS.items()},
        },
        {"draw": np.arange(0), "rho": ranges},
        {"surface": surface},
    )
