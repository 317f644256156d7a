"""Hindcast: roughness that a scan shows is replaced by artificial roughness of its spectrum.

If the force is then another, a random surface cannot continue this roughness beyond the scan. The
scan's own octave and the artificial ones are draws of one distribution if the surface is Gaussian.
"""

from collections.abc import Callable, Mapping
from dataclasses import replace

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from hardcontact.base.dataset import stack
from hardcontact.base.statistics import bounds, with_interval
from hardcontact.base.units import DIMENSIONLESS
from hardcontact.contact.contact import CONTACT_AXES
from hardcontact.contact.pull_off import FORCE
from hardcontact.inference.octaves import ForcesOnSurface
from hardcontact.surfaces.filters import filtered_series
from hardcontact.surfaces.height_map import HeightMap, mirror_stitch
from hardcontact.surfaces.spectrum import SpectrumFunction
from hardcontact.surfaces.synthesis import random_surface

Octave = tuple[float, float]

#: Artificial octaves of a side. A trade: each costs a force sum, and with six the interval is 1.3
#: times as wide as with many.
REALIZATIONS = 6

RATIO = DIMENSIONLESS | {
    "long_name": "mean pull-off force with an artificial octave, relative to that with the scan's"
}
FAILS = DIMENSIONLESS | {"long_name": "1 where artificial roughness changes the force"}


def last_octave(side: str, transition: float, shortest: float, longest: float) -> Octave | None:
    """Return the last octave (nm) that a scan shows before its roughness is continued on a side.

    The roughness is continued beyond the transition; the scan is reliable from `shortest` to
    `longest`. None if it does not show an octave.
    """
    if side == "small":
        end = max(transition, shortest)
        octave = end, 2 * end
    else:
        end = min(transition, longest)
        octave = end / 2, end
    return octave if shortest <= octave[0] and octave[1] <= longest else None


def hindcast_forces(
    stitched: HeightMap,
    octaves: Mapping[str, Octave | None],
    density: SpectrumFunction,
    generator: Callable[[str, int], np.random.Generator],
    forces: ForcesOnSurface,
) -> xr.Dataset:
    """Return the forces (side, contact_y, contact_x) in N on a stitched scan up to an octave.

    ``kept_force`` has the octave of the scan as the last one, ``replaced_force`` (side,
    realization, ...) artificial ones with C_iso `density`; `generator` takes side and realization.
    Both are NaN without an octave.
    """
    sides = {}
    for side, octave in octaves.items():
        if octave is None:
            sides[(side,)] = _side_forces(
                forces(stitched) * np.full((1 + REALIZATIONS, 1, 1), np.nan)
            )
            continue
        kept, rest = _parts_at_octave(stitched, side, octave)
        replaced = [
            forces(
                replace(
                    stitched,
                    heights=rest
                    + _artificial_octave(generator(side, number), stitched, octave, density),
                )
            )
            for number in range(REALIZATIONS)
        ]
        kept_force = forces(replace(stitched, heights=kept))
        sides[(side,)] = _side_forces(np.array([kept_force, *replaced]))
    return stack(sides, ["side"])


def _side_forces(forces: NDArray[np.float64]) -> xr.Dataset:
    """Return the forces of one side; the first are those with the octave of the scan."""
    return xr.Dataset(
        {
            "kept_force": (CONTACT_AXES, forces[0], FORCE),
            "replaced_force": (("realization", *CONTACT_AXES), forces[1:], FORCE),
        }
    )


def _parts_at_octave(
    stitched: HeightMap, side: str, octave: Octave
) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """Return the heights up to an octave as the last one of a side, and those without it."""
    filtered = filtered_series(stitched, "small", list(octave), stitched.pixels)
    from_octave, beyond_octave = (waves.heights.copy() for waves in filtered)
    kept = from_octave if side == "small" else stitched.heights - beyond_octave
    return kept, kept - (from_octave - beyond_octave)


def _artificial_octave(
    rng: np.random.Generator, stitched: HeightMap, octave: Octave, density: SpectrumFunction
) -> NDArray[np.float32]:
    """Return heights of one octave of waves, random on one scan and mirrored like it."""
    longest_wavevector, shortest_wavevector = (2 * np.pi / end for end in octave)

    def octave_density(wavevector: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return C_iso (nm⁴) within the octave, zero outside."""
        is_inside = (shortest_wavevector < wavevector) & (wavevector <= longest_wavevector)
        return np.where(is_inside, density(wavevector), 0.0)

    surface = random_surface(rng, stitched.pixels, stitched.pixel_size, octave_density)
    half = stitched.pixels // 2
    return np.asarray(
        mirror_stitch(replace(surface, heights=surface.heights[:half, :half])).heights
    )


def hindcasts(forces: xr.Dataset, tolerance: float, confidence: float) -> xr.Dataset:
    """Return ``hindcast_ratio`` (side) of mean forces, and ``hindcast_fails``.

    Forces (map, side, ...) come from `hindcast_forces`. The interval is that of one more artificial
    octave, and contains 1 if the scan's is like them. The hindcast fails if it does not, and the
    ratio differs from 1 by more than the tolerance.
    """
    from scipy import special

    dimensions = ["map", *CONTACT_AXES]
    kept = xr.DataArray(np.log(forces["kept_force"].mean(dimensions)))
    replaced = xr.DataArray(np.log(forces["replaced_force"].mean(dimensions)))
    count = replaced.sizes["realization"]
    quantile = special.stdtrit(count - 1, (1 + confidence) / 2)
    half = quantile * replaced.std("realization", ddof=1) * np.sqrt(1 + 1 / count)
    log_ratio = replaced.mean("realization") - kept
    interval = np.exp(np.stack([log_ratio - half, log_ratio + half], axis=-1))
    fails = (np.abs(log_ratio) > half) & (np.abs(log_ratio) > np.log1p(tolerance))
    variables = with_interval(
        "hindcast_ratio", "side", np.exp(log_ratio.values), interval, RATIO, confidence
    )
    return xr.Dataset(
        variables | {"hindcast_fails": ("side", fails.values.astype(int), FAILS)},
        {"side": forces["side"]},
    )


def all_hindcasts(
    maps: Mapping[str, xr.Dataset], tolerance: float, confidence: float
) -> xr.Dataset:
    """Return the `hindcasts` (surface, side) of all measured surfaces."""
    return stack(
        {(surface,): hindcasts(forces, tolerance, confidence) for surface, forces in maps.items()},
        ["surface"],
    )


def widen(force: xr.Dataset, name: str, hindcast_ratio: xr.DataArray) -> xr.Dataset:
    """Return a positive variable whose interval also contains the error of the hindcast.

    The logarithms of the interval's half width and of the ratio add in squares.
    """
    value = force[name]
    log_error = abs(np.log(hindcast_ratio.fillna(1)))
    low, high = bounds(force, name)
    low = value * np.exp(-np.hypot(np.log(value / low), log_error))
    high = value * np.exp(np.hypot(np.log(high / value), log_error))
    interval = force[f"{name}_interval"]
    ends = xr.concat([low, high], interval["bound"]).transpose(*interval.dims)
    return force.assign({f"{name}_interval": ends.assign_attrs(interval.attrs)})
