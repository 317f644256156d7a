"""Sets with rare protrusions on one coating or on the sphere: forces, fits of range and work.

All scans of a coating meet protrusions of one density, height and width. Another draw of these
makes another variant.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

import numpy as np
import pandas as pd
import xarray as xr
from numpy.typing import NDArray

from hardcontact.base.job import progress
from hardcontact.base.random import generator
from hardcontact.contact.force_curves import on_fine_grid
from hardcontact.contact.geometry import bodies
from hardcontact.contact.pull_off import plastic_forces, range_axis
from hardcontact.paper.inference import Published
from hardcontact.paper.leave_one_out import fitted_pairs
from hardcontact.paper.pool import PoolSettings, PoolSources
from hardcontact.surfaces.conditioning import group_heights
from hardcontact.surfaces.height_map import HeightMap, level, mirror_stitch
from hardcontact.surfaces.protrusions import Roughness, add_protrusions, draw_protrusions
from hardcontact.surfaces.substitute_scans import drawn_scan
from hardcontact.surfaces.substitute_spectra import rows_of_surface

#: A set agrees if the mean and the median force of the protruded surface are within this factor of
#: the published forces. Both are taken at the range and work of adhesion that fit the set best.
FACTOR = 2.0
Floats = NDArray[np.float64]
NEWTON = {"units": "N"}
#: Units of the fields of `Protrusions`.
PROTRUSION_UNITS = {"density": "um-2", "height": "1", "width": "nm"}


def published_roughness(
    table1: pd.DataFrame, constants: pd.DataFrame, coating: str, definitions: Mapping[str, str]
) -> Roughness:
    """Return what is published of the roughness of a coating and of the sphere.

    `table1` and `constants` are those of `published`; `definitions` are the meaning of ``slope``
    and ``curvature`` in Table 1.
    """
    rows = rows_of_surface(table1, coating, **definitions)
    slope = float(rows["value"]["afm_rms_slope"])
    return Roughness(
        float(rows["value"]["afm_rms_height"]),
        slope,
        slope + float(rows["uncertainty"]["afm_rms_slope"]),
        float(constants["value"]["sphere_rms_height_upper_bound"]),
    )


def compute_protruded(
    numbers: Sequence[int], scans: int, sources: PoolSources, roughness: Roughness, bearer: str
) -> xr.Dataset:
    """Compute the forces between sphere and coating where one of them has protrusions.

    Forces depend on the gap alone. Protrusions of the sphere are therefore added to the heights of
    the coating, at random places of each scan, as of many spheres. The coating with protrusions of
    its own keeps its rms height.

    Parameters
    ----------
    numbers : sequence of int
        Numbers of the variants, which have other protrusions each.
    scans : int
        Scans of the coating in each variant. Their rms heights get the mean and the deviation of
        the targets.
    sources : PoolSources
        Spectrum and targets of the coating without protrusions.
    roughness : Roughness
        Published roughness, which limits protrusions.
    bearer : str
        Name of what has the protrusions: the coating itself or the sphere. Those of the sphere are
        the same for all coatings.

    Returns
    -------
    xarray.Dataset
        ``pull_off_force`` (variant, rho, contact) in N at 1 J/m², plastic, of a smooth sphere at
        all contacts on all scans; ``mean_change`` (variant, rho), the mean force relative to that
        without protrusions; ``density`` (1/µm²), ``height`` (rms heights) and ``width`` (nm) over
        variant.
    """
    variants = [
        _protruded_forces(number, scans, sources, roughness, bearer)
        for number in progress(numbers, len(numbers), "protruded surfaces")
    ]
    axis = pd.Index(list(numbers), name="variant")
    return xr.concat(variants, axis).assign_attrs(surface=sources.settings["surface"])


def _protruded_forces(
    number: int, scans: int, sources: PoolSources, roughness: Roughness, bearer: str
) -> xr.Dataset:
    """Return forces and protrusions of one variant."""
    density, targets, heights, settings = sources
    seed, coating = settings["seed"], settings["surface"]
    on_sphere = bearer != coating
    protrusions = draw_protrusions(
        generator(seed, bearer, number, "protrusions"), roughness, on_sphere
    )
    generators = [
        generator(seed, coating, number, scan_number, "protruded scan")
        for scan_number in range(1, scans + 1)
    ]
    drawn = [level(drawn_scan(rng, density, settings["scan"])) for rng in generators]
    rms_heights = np.array([scan.heights.std() for scan in drawn])
    wanted = group_heights(rms_heights, targets.means["rms_height"], targets.deviation)
    # With six scans or more a height may lie below the least height of the forces of sets.
    wanted = np.maximum(wanted, heights[0])
    forces, unprotruded_forces = [], []
    for rng, scan, rms_height in zip(generators, drawn, wanted, strict=True):
        scan = _scaled(scan, rms_height)
        if on_sphere:
            protruded = add_protrusions(rng, scan, protrusions, roughness.rms_height)
        else:
            protruded = level(add_protrusions(rng, scan, protrusions, rms_height))
            protruded = _scaled(protruded, rms_height)
        forces.append(_forces(protruded, settings))
        unprotruded_forces.append(_forces(scan, settings))
    change = np.mean(forces, axis=(0, 2)) / np.mean(unprotruded_forces, axis=(0, 2))
    values = {name: ((), getattr(protrusions, name), {"units": unit})
              for name, unit in PROTRUSION_UNITS.items()}  # fmt: skip
    return xr.Dataset(
        {
            "pull_off_force": (("rho", "contact"), np.concatenate(forces, axis=1), NEWTON),
            "mean_change": ("rho", change, {"units": "1"}),
            **values,
        },
        range_axis(settings["ranges"]),
    )


def _scaled(scan: HeightMap, rms_height: float) -> HeightMap:
    """Return a scan of a rms height (nm)."""
    return replace(scan, heights=rms_height / scan.heights.std() * scan.heights)


def _forces(scan: HeightMap, settings: PoolSettings) -> Floats:
    """Return the plastic forces (rho, contact) of a smooth sphere on a scan, in N at 1 J/m²."""
    contact, ranges = settings["contact"], settings["ranges"]
    pair = bodies(mirror_stitch(scan), None, contact)
    return np.reshape(plastic_forces(pair, [contact], ranges)[0], (len(ranges), -1))


def judge_protruded(
    chunks: Iterable[xr.Dataset], surface: str, sets: xr.Dataset, measured: Published
) -> xr.Dataset:
    """Fit range and work of adhesion to every set, with the protrusions of every variant.

    The forces on the surface take the place of those of the sets. The mean forces on others change
    by the factor that they have with protrusions.

    Parameters
    ----------
    chunks : iterable of xarray.Dataset
        Of `compute_protruded`: the same variants of each surface whose forces change.
    surface : str
        The surface that agrees or not.
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
    by_surface: dict[str, list[xr.Dataset]] = {}
    for chunk in chunks:
        by_surface.setdefault(chunk.attrs["surface"], []).append(chunk)
    protruded = {name: xr.concat(parts, "variant") for name, parts in by_surface.items()}
    factor = sets["sphere_factor"].sel(surface=surface, drop=True)
    forces = protruded[surface]["pull_off_force"] * factor
    forces = forces.transpose("variant", "contact", "rho")
    published, ranges = measured.forces, forces["rho"].values
    changes = [variants["mean_change"] for variants in protruded.values()]
    change = xr.concat(changes, pd.Index(list(protruded), name="surface"))
    curves = sets["mean_force"] * change.reindex(surface=sets["surface"], fill_value=1.0)
    curves = curves.where(sets["surface"] != surface, forces.mean("contact"))
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
    ).assign(protruded[surface][list(PROTRUSION_UNITS)])


def none_protruded(surface: str, ranges: np.ndarray) -> xr.Dataset:
    """Return the result of `compute_protruded` for no variant; ranges of adhesion (rho,) in nm."""
    forces = np.empty((0, len(ranges), 1))
    return xr.Dataset(
        {
            "pull_off_force": (("variant", "rho", "contact"), forces, NEWTON),
            "mean_change": (("variant", "rho"), forces[..., 0], {"units": "1"}),
            **{name: ("variant", [], {"units": unit}) for name, unit in PROTRUSION_UNITS.items()},
        },
        {"variant": np.arange(0), "rho": ranges},
        {"surface": surface},
    )
