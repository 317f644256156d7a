"""Elastic contact without plasticity: a rough body is pressed into a half space, or pulled off it.

Some hundred pixels touch: the contact is a dense problem of these pixels. Attraction acts between
all pixels. The half space is flat and periodic and has the effective modulus. Lengths are in nm,
forces in nN, pressures in GPa, energies per area in J/m².
"""

from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray
from scipy.optimize import minimize_scalar
from threadpoolctl import threadpool_limits

from hardcontact.base.job import progress
from hardcontact.contact.contact import Contact
from hardcontact.contact.geometry import (
    Bodies,
    gap_map,
    largest_contact_gap,
    part_around_lowest,
    window_pixels,
)
from hardcontact.contact.smooth_sphere import hertz_contact

Floats = NDArray[np.float64]

PASCAL_PER_GPA = 1e9
NEWTON_PER_NN = 1e-9

#: Side in nm of the window about a contact in which elastic and rigid pull-off are compared.
PULL_OFF_WINDOW = 2500.0
#: Smallest number of pixels along this window.
MIN_WINDOW_PIXELS = 16
#: Largest number of pixels along a side of the map of the pressure in one contact.
PRESSURE_MAP_PIXELS = 64
#: Overlap (nm) that pixels may have: far below the range of adhesion.
MAX_OVERLAP = 1e-6
#: Pixels that may touch first, and at most: the dense matrix then takes 128 MB.
FIRST_PIXELS = 32
MAX_CONTACT_PIXELS = 4000
#: Steps of the active set, which needs about ten.
MAX_ITERATIONS = 200
#: Change of the attraction at which it counts as converged, and step of the load of the wall in the
#: search for pull-off, both relative to the whole attraction.
RELATIVE_RESIDUAL = 1e-9
LOAD_STEP = 1e-6


@dataclass(frozen=True, eq=False)
class HalfSpace:
    """A flat elastic half space with the period of n x n pixels, on whose pixels forces act."""

    #: (n, n // 2 + 1), displacement in nm of a wave of forces of 1 nN a pixel: 2/(E* q) a pressure.
    compliance: Floats

    def displacement(self, forces: Floats) -> Floats:
        """Return the displacement (n, n) in nm into the half space by forces (n, n) in nN.

        Its mean is zero.
        """
        from scipy import fft

        pixels = len(forces)
        return np.asarray(fft.irfft2(self.compliance * fft.rfft2(forces), s=(pixels, pixels)))

    def influence(self, pixels: NDArray[np.int_]) -> Floats:
        """Return the displacements (k, k) in nm of pixels (k, 2) by 1 nN on each of them."""
        rows, columns = (pixels[:, None] - pixels).transpose(2, 0, 1) % len(self.compliance)
        return np.asarray(self._response[rows, columns])

    @cached_property
    def _response(self) -> Floats:
        """Displacement (n, n) in nm by 1 nN on the first pixel."""
        count = len(self.compliance)
        force = np.zeros((count, count))
        force[0, 0] = 1.0
        return self.displacement(force)


def half_space(pixels: int, pixel_size: float, modulus: float) -> HalfSpace:
    """Return the half space of an effective modulus (Pa) on pixels x pixels of a size (nm)."""
    wave_y = 2 * np.pi * np.fft.fftfreq(pixels, pixel_size)
    wave_x = 2 * np.pi * np.fft.rfftfreq(pixels, pixel_size)
    wavevector = np.hypot(wave_y[:, None], wave_x)
    wavevector[0, 0] = np.inf  # The mean displacement is left out.
    return HalfSpace(2 * PASCAL_PER_GPA / (modulus * wavevector * pixel_size**2))


def wall_forces(influence: Floats, gaps: Floats, load: float) -> tuple[Floats, float]:
    """Return the forces (k,) in nN on touching pixels under a load (nN), and their approach (nm).

    Pixels with a force have no gap left, others no force and no overlap: the primal-dual active set
    (Hintermüller, Ito and Kunisch, SIAM J. Optim. 13 (2002) 865). Gaps (k,) are in nm.
    """
    touching = np.ones(len(gaps), bool)
    for _ in range(MAX_ITERATIONS):
        count = np.count_nonzero(touching)
        system = np.pad(influence[np.ix_(touching, touching)], (0, 1), constant_values=1.0)
        system[-1, -1] = 0.0
        *solution, approach = np.linalg.solve(system, np.append(-gaps[touching], load))
        forces = np.zeros(len(gaps))
        forces[touching] = solution
        # The last unknown raises all gaps; minus this is the approach of the bodies.
        left = gaps + influence @ forces + approach
        now_touching = np.where(touching, forces > 0, left < 0)
        if np.array_equal(now_touching, touching):
            return forces, -approach
        touching = now_touching if now_touching.any() else gaps == gaps.min()
    raise ValueError(f"expected an elastic contact in equilibrium, found none of {count} pixels")


class Wall(NamedTuple):
    """The forces in nN with which one body keeps another from overlapping."""

    forces: Floats  #: (n, n)
    gap: Floats  #: (n, n) in nm that is left.


def press(body: HalfSpace, gap: Floats, load: float) -> Wall:
    """Press a body of a gap (n, n) in nm at any approach onto a half space by a load (nN).

    The lowest pixels touch first; pixels that would overlap join them. Raises ValueError if more
    than MAX_CONTACT_PIXELS do.
    """
    is_candidate = gap <= largest_contact_gap(gap, FIRST_PIXELS)
    while True:
        pixels = np.argwhere(is_candidate)
        _refuse(len(pixels) > MAX_CONTACT_PIXELS, f"more than {MAX_CONTACT_PIXELS} touching pixels")
        forces, approach = wall_forces(body.influence(pixels), gap[is_candidate], load)
        all_forces = np.zeros_like(gap)
        all_forces[is_candidate] = forces
        gap_left = gap + body.displacement(all_forces) - approach
        overlaps = gap_left < -MAX_OVERLAP
        if not overlaps.any():
            return Wall(all_forces, gap_left)
        # Few pixels under the whole load sink in so far that most others overlap.
        lowest = np.where(is_candidate, np.inf, gap_left)
        added = min(int((overlaps & ~is_candidate).sum()), len(pixels))
        is_candidate |= lowest <= largest_contact_gap(lowest, added)


def pressure_at_load(gap: Floats, pixel_size: float, modulus: float, load: float) -> Floats:
    """Return the pressure (n, n) in Pa of elastic contact without adhesion.

    The gap (n, n) at any approach and the pixel size are in nm, the effective modulus in Pa and the
    load in N. Raises ValueError if too many pixels touch.
    """
    body = half_space(len(gap), pixel_size, modulus)
    return press(body, gap, load / NEWTON_PER_NN).forces / pixel_size**2 * PASCAL_PER_GPA


def adhesive_pull_off(
    gap: Floats, pixel_size: float, modulus: float, work_of_adhesion: float, rho: float
) -> tuple[float, float]:
    """Return the pull-off forces (N) of one window, rigid and elastic.

    Elastic: the largest attraction less the force of the wall, over all forces of the wall (the
    paper, elastic analysis). Lengths are in nm, the effective modulus in Pa, the work of adhesion
    in J/m². Raises ValueError if attraction stretches soft bodies by over rho/10.
    """
    rigid_gap = gap - gap.min()
    strength = work_of_adhesion / rho * pixel_size**2
    rigid_attraction = strength * np.exp(-rigid_gap / rho)
    body = half_space(len(gap), pixel_size, modulus)
    elongation = body.displacement(rigid_attraction).max()
    _refuse(elongation > rho / 10, f"bodies stretched by {elongation:.2g} nm")
    attraction = rigid_attraction

    def force(wall_load: float) -> float:
        """Return minus the total attraction (nN) where the wall carries a load (nN)."""
        nonlocal attraction
        while True:
            wall = press(body, rigid_gap - body.displacement(attraction), wall_load)
            last = attraction
            # The wall leaves no overlap but that of the tolerance.
            attraction = strength * np.exp(-np.maximum(wall.gap, 0) / rho)
            if np.abs(attraction - last).sum() < RELATIVE_RESIDUAL * attraction.sum():
                return wall_load - float(attraction.sum())

    rigid = float(rigid_attraction.sum())
    optimum = minimize_scalar(
        force, bounds=(0, rigid), method="bounded", options={"xatol": LOAD_STEP * rigid}
    )
    return rigid * NEWTON_PER_NN, -optimum.fun * NEWTON_PER_NN


def _refuse(failed: bool, reason: str) -> None:
    """Raise ValueError with the reason if `failed`."""
    if failed:
        raise ValueError(f"expected an elastic contact in equilibrium, found {reason}")


ELASTIC_UNITS = {
    "contact_area": "nm2",
    "share_above_hardness": "1",
    "peak_pressure": "Pa",
    "mean_pressure": "Pa",
    "rigid_pull_off_force": "N",
    "elastic_pull_off_force": "N",
}


def elastic_contacts_of_pair(
    bodies: Bodies,
    contact: Contact,
    contact_indices: NDArray[np.int_],
    modulus: float,
    pull_off_window: float,
) -> xr.Dataset:
    """Solve some contacts of a pair of scans with elasticity, without plasticity.

    The indices (contact, 2) are row and column in the array; the effective modulus is in Pa, the
    side of the pull-off window about the lowest gap in nm. Returns ELASTIC_UNITS (contact), and
    ``pressure`` (y, x) in Pa of the first. Raises ValueError if no equilibrium is found.
    """
    geometry = bodies.geometry
    pixel_size = bodies.geometry.pixel_size
    period_pixels = min(bodies.substrate.pixels, geometry.window)
    pull_off_pixels = window_pixels(pull_off_window, pixel_size)
    pull_off_pixels = min(max(pull_off_pixels, MIN_WINDOW_PIXELS), period_pixels)
    contact_rows: list[tuple[float, ...]] = []
    pressure_maps = []
    # More threads take twice the processor time and give the same numbers.
    with threadpool_limits(1, "blas"):
        for index in progress(contact_indices, len(contact_indices), "elastic contacts"):
            gap = gap_map(bodies, index)
            period_gap = part_around_lowest(gap, period_pixels)
            window_gap = part_around_lowest(gap, pull_off_pixels)
            pressure = pressure_at_load(period_gap, pixel_size, modulus, contact.preload)
            rigid, elastic = adhesive_pull_off(
                window_gap, pixel_size, modulus, contact.work, contact.range
            )
            contact_pressure = pressure[pressure > 0]
            contact_rows.append(
                (
                    contact_pressure.size * pixel_size**2,
                    float(np.mean(contact_pressure > contact.hardness)),
                    contact_pressure.max(),
                    contact_pressure.mean(),
                    rigid,
                    elastic,
                )
            )
            # The highest pressure is the lowest negative pressure.
            pressure_maps.append(
                -part_around_lowest(-pressure, min(PRESSURE_MAP_PIXELS, period_pixels))
            )
    variables: dict[str, Any] = {
        name: ("contact", list(values), {"units": unit})
        for (name, unit), values in zip(
            ELASTIC_UNITS.items(), zip(*contact_rows, strict=True), strict=True
        )
    }
    pressure_attributes = {"units": "Pa", "long_name": "pressure in one contact"}
    pixels = len(pressure_maps[0])
    position = (np.arange(pixels) - pixels // 2) * pixel_size
    from_peak = {"units": "nm", "long_name": "position from the peak"}
    return xr.Dataset(
        variables | {"pressure": (("y", "x"), pressure_maps[0], pressure_attributes)},
        {
            "contact_y": ("contact", contact_indices[:, 0]),
            "contact_x": ("contact", contact_indices[:, 1]),
            "y": ("y", position, from_peak),
            "x": ("x", position, from_peak),
        },
        {
            "hardness": contact.hardness,
            "preload": contact.preload,
            "effective_modulus": modulus,
            "rho": contact.range,
            "work_of_adhesion": contact.work,
            "window": pull_off_pixels * pixel_size,
            "sphere_radius": geometry.radius,
            "hertz_peak_pressure": hertz_contact(
                contact.preload, geometry.radius, modulus
            ).peak_pressure,
        },
    )
