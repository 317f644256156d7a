"""Elastic contact without plasticity: a rough body is pressed into a half space, or pulled off it.

Some hundred pixels touch, so that their forces follow from one dense matrix. Attraction acts on all
pixels. The flat, periodic half space has the effective modulus of both bodies. Lengths are in nm,
moduli and pressures in Pa, forces in nN; functions after `press` take and return forces in N.
"""

import numpy as np
import xarray as xr
from numpy.typing import NDArray
from scipy import fft
from scipy.optimize import minimize_scalar
from threadpoolctl import threadpool_limits

from hardcontact.base.arrays import Floats
from hardcontact.base.dataset import DatasetsByLabels, stack, variables_of_columns
from hardcontact.base.progress import progress
from hardcontact.base.units import GIGAPASCAL, NANONEWTON, NM, PASCAL
from hardcontact.contact.contact import CONTACT_AXES, Contact
from hardcontact.contact.geometry import (
    Bodies,
    count_window_pixels,
    largest_contact_gap,
    reference_gap_map,
    square_around_lowest,
)
from hardcontact.contact.hertz_jkr_dmt import hertz_peak_pressure

#: Overlap (nm) that pixels may have: far below the range of adhesion.
MAX_OVERLAP = 1e-6
#: Pixels that may touch in the first step.
FIRST_TOUCHING_PIXELS = 32
#: Most pixels that may touch: their dense matrix then takes 128 MB.
MAX_TOUCHING_PIXELS = 4000
#: Begins messages if no equilibrium is found.
EXPECTED_EQUILIBRIUM = "expected an elastic contact in equilibrium"
#: Most steps of an iteration; the active set needs about ten.
MAX_ITERATIONS = 200
#: Change of the attraction at which it counts as converged, relative to the total attraction.
RELATIVE_RESIDUAL = 1e-9
#: First step and tolerance of the load in the search for pull-off, relative to the rigid force.
LOAD_STEP = 1e-6
#: Most pixels per row of the pressure map of a contact.
PRESSURE_MAP_PIXELS = 64
#: Largest width in nm of the window in `adhesive_pull_off`: that of the paper's scans.
PULL_OFF_WINDOW = 2500.0
#: Quantities of each elastic contact, with their units.
ELASTIC_UNITS = {
    "elastic_contact_area": "nm2", "share_above_hardness": "1", "peak_pressure": "Pa",
    "mean_pressure": "Pa", "rigid_pull_off_force": "N", "elastic_pull_off_force": "N",
}  # fmt: skip


class HalfSpace:
    """A flat elastic half space, periodic after n x n pixels; its mean displacement is left out."""

    def __init__(self, pixels: int, pixel_size: float, modulus: float) -> None:
        wave_y = 2 * np.pi * fft.fftfreq(pixels, pixel_size)
        wave_x = 2 * np.pi * fft.rfftfreq(pixels, pixel_size)
        wavevector = np.hypot(wave_y[:, None], wave_x)
        wavevector[0, 0] = np.inf
        # A wave of pressure p displaces by 2p/(E* q); a force on a pixel is p pixel_size².
        self._compliance = 2 * GIGAPASCAL / (modulus * wavevector * pixel_size**2)
        # The displacements by 1 nN on the first pixel.
        self._response = fft.irfft2(self._compliance, s=(pixels, pixels))

    def displacement(self, forces: Floats) -> Floats:
        """Return the displacement (n, n) in nm into the half space by forces (n, n) in nN."""
        return np.asarray(fft.irfft2(self._compliance * fft.rfft2(forces), s=forces.shape))

    def influence(self, candidates: NDArray[np.int_]) -> Floats:
        """Return the displacements (k, k) in nm of pixels (k, 2) by 1 nN on each of them."""
        # It depends on the distance of two pixels alone.
        rows, columns = (candidates[:, None] - candidates).transpose(2, 0, 1) % len(self._response)
        return np.asarray(self._response[rows, columns])


def contact_forces(influence: Floats, gaps: Floats, load: float) -> tuple[Floats, float]:
    """Return the contact forces (k,) on pixels with gaps (k,), and the approach (nm) of the bodies.

    Contact forces (nN) repel, and add up to the load. A pixel that touches has no gap left, any
    other pixel has no force. If it were known which pixels touch, these equations would give the
    forces on them, and the separation of the bodies, which raises all gaps:

        influence @ forces + separation = -gaps,    sum(forces) = load.

    So first all pixels touch. Then pixels whose force would be negative are released, and pixels
    that would overlap are added, until nothing changes. Source: the primal-dual active set of
    Hintermüller, Ito and Kunisch, SIAM J. Optim. 13 (2002) 865.
    """
    is_touching = np.ones(len(gaps), bool)
    for _ in range(MAX_ITERATIONS):
        # The last row and column of the system are those of the load and the separation.
        system = np.pad(influence[np.ix_(is_touching, is_touching)], (0, 1), constant_values=1.0)
        system[-1, -1] = 0.0
        *touching_forces, separation = np.linalg.solve(system, np.append(-gaps[is_touching], load))
        forces = np.zeros(len(gaps))
        forces[is_touching] = touching_forces
        gaps_left = gaps + influence @ forces + separation
        touches_next = np.where(is_touching, forces > 0, gaps_left < 0)
        if np.array_equal(touches_next, is_touching):
            return forces, -separation
        is_touching = touches_next if touches_next.any() else gaps == gaps.min()
    raise ValueError(f"{EXPECTED_EQUILIBRIUM}, found none")


def press(half_space: HalfSpace, gap: Floats, load: float) -> tuple[Floats, Floats]:
    """Return contact forces (n, n) in nN under a load (nN), and the gap (n, n) in nm that is left.

    The matrix of `contact_forces` would be too large for all pixels. So only candidates may touch:
    at first the lowest pixels, then also pixels that overlap under the forces on the candidates,
    until none overlaps. A constant added to `gap` changes nothing. Raises ValueError if candidates
    are more than MAX_TOUCHING_PIXELS.
    """
    if load == 0:  # The lowest pixel touches without a force.
        return np.zeros_like(gap), gap - gap.min()
    is_candidate = gap <= largest_contact_gap(gap, FIRST_TOUCHING_PIXELS)
    while True:
        candidates = np.argwhere(is_candidate)
        if len(candidates) > MAX_TOUCHING_PIXELS:
            raise ValueError(
                f"{EXPECTED_EQUILIBRIUM}, found over {MAX_TOUCHING_PIXELS} touching pixels"
            )
        forces, approach = contact_forces(half_space.influence(candidates), gap[is_candidate], load)
        all_forces = np.zeros_like(gap)
        all_forces[is_candidate] = forces
        gap_left = gap + half_space.displacement(all_forces) - approach
        overlaps = gap_left < -MAX_OVERLAP
        if not overlaps.any():
            return all_forces, gap_left
        # If few candidates carry the whole load, they sink so far that most other pixels overlap,
        # although few of these will touch. So the candidates at most double.
        other_gaps = np.where(is_candidate, np.inf, gap_left)
        added_count = min(int((overlaps & ~is_candidate).sum()), len(candidates))
        is_candidate |= other_gaps <= largest_contact_gap(other_gaps, added_count)


def pressure_at_load(gap: Floats, pixel_size: float, modulus: float, load: float) -> Floats:
    """Return the pressure (n, n) in Pa of elastic contact without adhesion at a load (N)."""
    half_space = HalfSpace(len(gap), pixel_size, modulus)
    forces, _ = press(half_space, gap, load / NANONEWTON)
    return forces / pixel_size**2 * GIGAPASCAL


def adhesive_pull_off(
    gap: Floats, pixel_size: float, modulus: float, work: float, rho: float
) -> tuple[float, float]:
    """Return the pull-off forces (N) of one window, rigid and elastic.

    Without elasticity the force is the attraction when one pixel touches. Elastic bodies may also
    press against each other where they touch, with a load, which deforms them and brings more
    pixels close. The force that pulls them is then attraction minus load; its maximum over loads is
    the elastic pull-off force (the paper, elastic analysis). Raises ValueError if attraction
    stretches the bodies by over rho/10.
    """
    rigid_gap = gap - gap.min()
    strength = work / rho * pixel_size**2  # attraction of a pixel that touches, in nN
    rigid_attraction = strength * np.exp(-rigid_gap / rho)
    rigid_force = float(rigid_attraction.sum())
    half_space = HalfSpace(len(gap), pixel_size, modulus)
    stretch = half_space.displacement(rigid_attraction).max()
    if stretch > rho / 10:
        # Beyond this limit `pull` may not converge. In trials at the limit, an iteration left up to
        # 95 % of the error.
        raise ValueError(
            f"expected a stretch of at most rho/10 = {rho / 10:.2g} nm, found {stretch:.2g} nm"
        )

    def pull(load: float, attraction: Floats) -> tuple[float, Floats]:
        """Return attraction less load, and the attraction (n, n), in equilibrium, both in nN.

        The attraction stretches the bodies and changes the gap, which changes the attraction. So
        both are computed in turn until they agree; `attraction` is the first guess.
        """
        for _ in range(MAX_ITERATIONS):
            _, gap_left = press(half_space, rigid_gap - half_space.displacement(attraction), load)
            former_attraction = attraction
            # Gaps may be negative by MAX_OVERLAP.
            attraction = strength * np.exp(-np.maximum(gap_left, 0) / rho)
            if np.abs(attraction - former_attraction).sum() < RELATIVE_RESIDUAL * attraction.sum():
                return float(attraction.sum()) - load, attraction
        raise ValueError(f"{EXPECTED_EQUILIBRIUM}, found none")

    step = LOAD_STEP * rigid_force
    elastic_force, unloaded_attraction = pull(0.0, rigid_attraction)

    def negative_force(load: float) -> float:
        return -pull(load, unloaded_attraction)[0]

    # A contact stiffens under its load: if the first step gains nothing, no later one does.
    if negative_force(step) < -elastic_force:
        loads = (0, rigid_force)
        elastic_force = -minimize_scalar(negative_force, bounds=loads, options={"xatol": step}).fun
    return rigid_force * NANONEWTON, elastic_force * NANONEWTON


def _pressure_around_peak(pressure: Floats, pixel_size: float) -> xr.DataArray:
    """Return the pressure (y, x) in Pa about its peak, at most PRESSURE_MAP_PIXELS wide."""
    pixels = min(PRESSURE_MAP_PIXELS, len(pressure))
    # The highest pressure is the lowest negative pressure.
    around_peak = -square_around_lowest(-pressure, pixels)
    position = (np.arange(pixels) - pixels // 2) * pixel_size
    coordinates = {axis: (axis, position, NM) for axis in ("y", "x")}
    return xr.DataArray(around_peak, coordinates, ("y", "x"), attrs=PASCAL)


def solve_elastic_contacts(
    bodies: Bodies, contact: Contact, contact_indices: NDArray[np.int_], modulus: float
) -> xr.Dataset:
    """Return ELASTIC_UNITS (contact,) of contacts, given by row and column (k, 2) in the array.

    The map ``pressure`` (y, x) in Pa is around the peak pressure of the first contact.
    """
    geometry = bodies.geometry
    pixel_size = geometry.pixel_size
    period_pixels = min(bodies.substrate.pixels, geometry.window_pixels)
    pull_off_pixels = min(count_window_pixels(PULL_OFF_WINDOW, pixel_size), period_pixels)
    metrics = []
    pressures = []
    # More threads only take twice the processor time.
    with threadpool_limits(1, "blas"):
        for index in progress(contact_indices, len(contact_indices), "elastic contacts"):
            gap = reference_gap_map(bodies, index)
            period_gap = square_around_lowest(gap, period_pixels)
            window_gap = square_around_lowest(gap, pull_off_pixels)
            pressure = pressure_at_load(period_gap, pixel_size, modulus, contact.preload)
            forces = adhesive_pull_off(window_gap, pixel_size, modulus, contact.work, contact.rho)
            contact_pressures = pressure[pressure > 0]
            area = contact_pressures.size * pixel_size**2
            share = float(np.mean(contact_pressures > contact.hardness))
            peak, mean = contact_pressures.max(), contact_pressures.mean()
            # In the order of ELASTIC_UNITS.
            metrics.append((area, share, peak, mean, *forces))
            pressures.append(pressure)
    variables = variables_of_columns(np.array(metrics), "contact", ELASTIC_UNITS)
    return xr.Dataset(
        variables | {"pressure": _pressure_around_peak(pressures[0], pixel_size)},
        {axis: ("contact", contact_indices[:, k]) for k, axis in enumerate(CONTACT_AXES)},
        {
            "hardness": contact.hardness,
            "preload": contact.preload,
            "effective_modulus": modulus,
            "rho": contact.rho,
            "work_of_adhesion": contact.work,
            "window": pull_off_pixels * pixel_size,
            "sphere_radius": geometry.radius,
            "hertz_peak_pressure": hertz_peak_pressure(contact.preload, geometry.radius, modulus),
        },
    )


def stack_elastic_contacts(scans: DatasetsByLabels) -> xr.Dataset:
    """Stack results of `solve_elastic_contacts` along ``scan``; keep the first scan's pressure."""
    without_pressure = {key: scan.drop_vars(["pressure", "y", "x"]) for key, scan in scans.items()}
    return stack(without_pressure, ["scan"]).assign(pressure=next(iter(scans.values()))["pressure"])
