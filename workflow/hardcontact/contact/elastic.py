"""Elastic contact with the solvers of ContactMechanics and Adhesion, without plasticity.

A rough body of height -gap is pressed into, or pulled off, a flat periodic half space of the
effective modulus. The solvers get lengths in nm, forces in nN, pressures in GPa, energies per area
in J/m².
"""

from typing import Any

import numpy as np
import xarray as xr
from Adhesion.Interactions import Exponential
from Adhesion.System import BoundedSmoothContactSystem
from ContactMechanics import PeriodicFFTElasticHalfSpace
from ContactMechanics.Systems import NonSmoothContactSystem
from numpy.typing import NDArray
from scipy.optimize import minimize_scalar
from SurfaceTopography import Topography
from threadpoolctl import threadpool_limits

from hardcontact.base.job import progress
from hardcontact.contact.contact import Contact
from hardcontact.contact.geometry import (
    Bodies,
    gap_map,
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
#: Overlap or open gap (nm) that pixels in contact may have.
MAX_OVERLAP = 1e-4
#: Residual force on a pixel at which the solver stops, relative to the largest adhesive force on
#: one. Twice this is accepted.
RELATIVE_RESIDUAL = 1e-4


def pressure_at_load(gap: Floats, pixel_size: float, modulus: float, load: float) -> Floats:
    """Return the pressure (n, n) in Pa of elastic contact without adhesion.

    Constrained conjugate gradients (Polonsky and Keer, Wear 231 (1999) 206). The gap (n, n) at any
    approach and the pixel size are in nm, the effective modulus in Pa and the load in N. Raises
    ValueError if the solver returned no solution.
    """
    # The solver finds no contact if all heights are below zero, so the heights are centred.
    body, half_space = _body_and_half_space(gap.mean() - gap, pixel_size, modulus)
    system = NonSmoothContactSystem(half_space, body)
    solution = system.minimize_proxy(external_force=load / NEWTON_PER_NN, pentol=MAX_OVERLAP / 2)
    _refuse(not solution.success, solution.message)
    _refuse(solution.nit < 2, f"{solution.nit} iterations")
    # `jac` is the force in nN on each pixel, positive in compression.
    pressure = solution.jac / pixel_size**2 * PASCAL_PER_GPA
    in_contact = pressure > 0
    gap_left = system.compute_gap(solution.x, solution.offset)
    carried = solution.jac.sum() * NEWTON_PER_NN
    _refuse(abs(carried / load - 1) > 1e-6, f"a load of {carried:.3g} N")
    _refuse(pressure.min() < 0, f"a tension of {-pressure.min():.3g} Pa")
    _refuse(gap_left.min() < -MAX_OVERLAP, f"an overlap of {-gap_left.min():.2g} nm")
    _refuse(
        gap_left[in_contact].max() > MAX_OVERLAP,
        f"pressure across {gap_left[in_contact].max():.2g} nm",
    )
    _refuse(
        in_contact.all() or pressure.max() > modulus,
        f"{in_contact.mean():.0%} of all pixels in contact, peak pressure {pressure.max():.3g} Pa",
    )
    return np.asarray(pressure)


def adhesive_pull_off(
    gap: Floats, pixel_size: float, modulus: float, work_of_adhesion: float, rho: float
) -> tuple[float, float]:
    """Return the pull-off forces (N) of one window, rigid and elastic.

    Elastic: the largest attraction in equilibrium while the bodies part (the paper, elastic
    analysis). Lengths are in nm, the effective modulus in Pa, the work of adhesion in J/m². Raises
    ValueError if no equilibrium was reached, or if attraction stretches soft bodies by over rho/10.
    """
    heights = gap.min() - gap
    attraction = work_of_adhesion / rho * pixel_size**2 * np.exp(heights / rho)
    body, half_space = _body_and_half_space(heights, pixel_size, modulus)
    system = BoundedSmoothContactSystem(half_space, Exponential(work_of_adhesion, rho), body)
    # The attraction between rigid bodies displaces the surface nearly as much as that between
    # elastic ones.
    displacement = half_space.evaluate_disp(attraction)
    elongation = -displacement.min()
    _refuse(elongation > rho / 10, f"bodies stretched by {elongation:.2g} nm")
    iterations = 0

    def force(offset: float) -> float:
        """Return the total force (nN) at an offset (nm), negative for attraction."""
        nonlocal displacement, iterations
        solution = system.minimize_proxy(
            offset=offset,
            initial_displacements=np.maximum(displacement, heights + offset),
            options={"ftol": 0, "gtol": RELATIVE_RESIDUAL * attraction.max(), "maxiter": 5000},
        )
        displacement, iterations = system.disp, iterations + solution.nit
        _check_equilibrium(solution, system, attraction.max())
        # Attraction less the reaction of the wall: residual forces on free pixels do not count.
        reaction = system.force[system.gap <= 0].sum()
        return float(system.interaction_force.sum() - reaction)

    # Pull-off is near the offset at which the bodies just touch with the surface still displaced.
    optimum = minimize_scalar(
        force, bounds=(-1.5 * elongation, 0), method="bounded", options={"xatol": elongation / 6}
    )
    _refuse(not optimum.success or iterations < 2, f"{optimum.message}, {iterations} iterations")
    rigid = attraction.sum() * NEWTON_PER_NN
    return rigid, -optimum.fun * NEWTON_PER_NN


def _body_and_half_space(heights: Floats, pixel_size: float, modulus: float) -> tuple[Any, Any]:
    """Return a rigid body and a half space of the same period; heights: (n, n) nm, modulus: Pa."""
    size = tuple(pixels * pixel_size for pixels in heights.shape)
    body = Topography(heights, size, periodic=True)
    return body, PeriodicFFTElasticHalfSpace(heights.shape, modulus / PASCAL_PER_GPA, size)


def _check_equilibrium(solution: Any, system: Any, largest_attraction: float) -> None:
    """Raise ValueError unless the bodies rest: no overlap, no force but on a contact pixel."""
    _refuse(not solution.success, solution.message)
    _refuse(system.gap.min() < -MAX_OVERLAP, f"an overlap of {-system.gap.min():.2g} nm")
    residual = np.where(system.gap > MAX_OVERLAP, np.abs(system.force), np.maximum(system.force, 0))
    _refuse(
        residual.max() > 2 * RELATIVE_RESIDUAL * largest_attraction,
        f"{residual.max() / largest_attraction:.2g} of the largest adhesive force left on a pixel",
    )


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
