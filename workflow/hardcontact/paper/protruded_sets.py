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
from hardcontact.base.units import DIMENSIONLESS, NEWTON, NM
from hardcontact.contact.force_curves import interpolate_to_ranges
from hardcontact.contact.geometry import bodies
from hardcontact.contact.pull_off import pull_off_forces, range_axis
from hardcontact.inference.fit import fit_mean_forces
from hardcontact.inference.published_fit import PublishedFit
from hardcontact.paper.pool import PoolSources
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
    "protrusion_density": {"units": "um-2"}, "protrusion_height": DIMENSIONLESS,
    "protrusion_width": NM,
}  # fmt: skip


def published_roughness(
    table1: pd.DataFrame, constants: pd.DataFrame, coating: str
) -> PublishedRoughness:
    """Return the roughness of a coating, and the largest rms height of the sphere."""
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
    """Compute the forces between sphere and coating if the `protruded_body` has protrusions.

    Forces depend on the gap alone. Protrusions of the sphere are therefore added to the heights of
    the coating, at random positions on each scan, as if each scan met another sphere. They are the
    same for all coatings. A coating with protrusions of its own is scaled back to its rms height.
    Plastic forces (draw, rho, contact) on a smooth sphere are in N at 1 J/m².
    """
    draw_datasets = [
        _protruded_forces(number, scan_count, sources, roughness, protruded_body)
        for number in progress(draw_numbers, len(draw_numbers), "protruded surfaces")
    ]
    axis = pd.Index(list(draw_numbers), name="draw")
    return xr.concat(draw_datasets, axis).assign_attrs(surface=sources.surface)


def _protruded_forces(
    draw_number: int,
    scan_count: int,
    sources: PoolSources,
    roughness: PublishedRoughness,
    protruded_body: str,
) -> xr.Dataset:
    """Return forces and protrusions of one draw."""
    is_on_sphere = protruded_body != sources.surface
    rng = generator(sources.seed, protruded_body, draw_number, "protrusions")
    protrusions = sample_protrusions(rng, roughness, is_on_sphere)
    scan_rngs = [
        generator(sources.seed, sources.surface, draw_number, scan_number, "protruded scan")
        for scan_number in range(1, scan_count + 1)
    ]
    scans = [level(sample_scan(rng, sources.spectrum, sources.grid)) for rng in scan_rngs]
    forces = []
    unprotruded_forces = []
    for rng, scan, rms_height in zip(scan_rngs, scans, _set_heights(scans, sources), strict=True):
        scan = _scale_scan(scan, rms_height)
        if is_on_sphere:
            protruded_scan = add_protrusions(rng, scan, protrusions, roughness.rms_height)
        else:
            protruded_scan = level(add_protrusions(rng, scan, protrusions, rms_height))
            protruded_scan = _scale_scan(protruded_scan, rms_height)
        forces.append(_scan_forces(protruded_scan, sources))
        unprotruded_forces.append(_scan_forces(scan, sources))
    force_ratio = np.mean(forces, axis=(0, 2)) / np.mean(unprotruded_forces, axis=(0, 2))
    return xr.Dataset(
        {
            "pull_off_force": (("rho", "contact"), np.concatenate(forces, axis=1), NEWTON),
            "mean_force_ratio": ("rho", force_ratio, DIMENSIONLESS),
            **{
                name: ((), value, unit)
                for (name, unit), value in zip(PROTRUSION_UNITS.items(), protrusions, strict=True)
            },
        },
        range_axis(sources.ranges),
    )


def _set_heights(scans: Sequence[HeightMap], sources: PoolSources) -> Floats:
    """Return the rms heights (scan,) in nm of scans as those of a set of the pool."""
    targets = sources.targets
    rms_heights = np.array([scan.heights.std() for scan in scans])
    heights = scale_rms_heights(rms_heights, targets.means["rms_height"], targets.rms_height_std)
    # With six scans or more, a height may be below the smallest rms height of the pool.
    return np.asarray(np.maximum(heights, sources.rms_heights[0]))


def _scale_scan(scan: HeightMap, rms_height: float) -> HeightMap:
    """Return the scan with another rms height (nm)."""
    return replace(scan, heights=rms_height / scan.heights.std() * scan.heights)


def _scan_forces(scan: HeightMap, sources: PoolSources) -> Floats:
    """Return the plastic forces (rho, contact) of a smooth sphere on a scan, in N at 1 J/m²."""
    contact_bodies = bodies(mirror_stitch(scan), None, sources.contact)
    forces = pull_off_forces(contact_bodies, [sources.contact], sources.ranges)
    return np.reshape(forces[0], (len(sources.ranges), -1))


def fit_protruded_sets(
    draw_datasets: Iterable[xr.Dataset], surface: str, sets: xr.Dataset, published: PublishedFit
) -> xr.Dataset:
    """Fit range and work of adhesion to every set, with the protrusions of every draw.

    The forces with protrusions replace the forces of the sets (sets.nc, plastic) on this surface.
    The mean forces on other surfaces are multiplied by the ratio of forces with and without
    protrusions. ``agrees`` (draw, set) is 1 if mean and median force of the surface at the fitted
    pair are within MAX_FORCE_FACTOR of the published forces.
    """
    draws = _stack_draws(draw_datasets)
    coating = draws[surface]
    sphere_factor = sets["sphere_factor"].sel(surface=surface, drop=True)
    forces = coating["pull_off_force"] * sphere_factor
    forces = forces.transpose("draw", "contact", "rho")
    force_ratio = xr.concat(
        [draws_on_surface["mean_force_ratio"] for draws_on_surface in draws.values()],
        pd.Index(list(draws), name="surface"),
    )
    curves = sets["mean_force"] * force_ratio.reindex(surface=sets["surface"], fill_value=1.0)
    curves = curves.where(sets["surface"] != surface, forces.mean("contact"))
    fits = fit_mean_forces(curves.transpose("draw", "set", ...), published.forces["mean_force"])
    fitted_forces = _forces_at_fits(forces, fits)
    mean = fitted_forces.mean(axis=1)
    median = np.median(fitted_forces, axis=1)
    measured = published.forces.loc[surface]
    errors = [np.log(mean / measured["mean_force"]), np.log(median / measured["median_force"])]
    agrees = np.abs(errors).max(axis=0) <= np.log(MAX_FORCE_FACTOR)
    return fits.assign(
        mean_force_at_fit=(("draw", "set"), mean, NEWTON),
        median_force_at_fit=(("draw", "set"), median, NEWTON),
        agrees=(("draw", "set"), agrees.astype("int8")),
    ).merge(_statistics_at_published_pair(forces, published).merge(coating[list(PROTRUSION_UNITS)]))


def _stack_draws(draw_datasets: Iterable[xr.Dataset]) -> dict[str, xr.Dataset]:
    """Return the datasets of all draws by surface."""
    draws: dict[str, list[xr.Dataset]] = {}
    for draw_dataset in draw_datasets:
        draws.setdefault(draw_dataset.attrs["surface"], []).append(draw_dataset)
    return {name: xr.concat(surface_draws, "draw") for name, surface_draws in draws.items()}


def _forces_at_fits(forces: xr.DataArray, fits: xr.Dataset) -> Floats:
    """Return forces (draw, contact, set) in N at the fitted pairs (draw, set).

    The forces (draw, contact, rho) are in N at 1 J/m².
    """
    ranges = forces["rho"].values
    fitted_forces = np.empty((*forces.shape[:2], fits.sizes["set"]))
    for draw, draw_forces in enumerate(forces.values):
        fit = fits.isel(draw=draw)
        at_ranges = interpolate_to_ranges(draw_forces, ranges, fit["range_of_adhesion"].values)
        fitted_forces[draw] = at_ranges * fit["work_of_adhesion"].values
    return fitted_forces


def _statistics_at_published_pair(forces: xr.DataArray, published: PublishedFit) -> xr.Dataset:
    """Return mean, median and scatter of forces (draw, contact, rho) at the published pair."""
    rho, work = published.pair
    curves = interpolate_to_ranges(forces.values, forces["rho"].values, np.array([rho]))
    pair_forces = curves[..., 0] * work
    return xr.Dataset(
        {
            "mean_force_at_published": ("draw", pair_forces.mean(axis=1), NEWTON),
            "median_force_at_published": ("draw", np.median(pair_forces, axis=1), NEWTON),
            "log_force_std_at_published": ("draw", np.log(pair_forces).std(axis=1), DIMENSIONLESS),
        },
        {"draw": forces["draw"]},
    )


def empty_protruded_forces(surface: str, ranges: np.ndarray) -> xr.Dataset:
    """Return the dataset of `compute_protruded_forces` without any draw; ranges are in nm."""
    forces = np.empty((0, len(ranges), 1))
    return xr.Dataset(
        {
            "pull_off_force": (("draw", "rho", "contact"), forces, NEWTON),
            "mean_force_ratio": (("draw", "rho"), forces[..., 0], DIMENSIONLESS),
            **{name: ("draw", [], unit) for name, unit in PROTRUSION_UNITS.items()},
        },
        {"draw": np.arange(0), "rho": ranges},
        {"surface": surface},
    )
