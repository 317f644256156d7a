"""Elastic contact by the field's solvers: what rigid and plastic contact leave out.

A rough body of height -gap is pressed into, or pulled off, a flat periodic half space of the
effective modulus. Towards the solvers lengths are in nm and forces in nN, so that pressures are
in GPa and energies per area in J/m²: numbers near one, as their tolerances expect.
"""

import numpy as np
from Adhesion.Interactions import Exponential
from Adhesion.System import BoundedSmoothContactSystem
from ContactMechanics import PeriodicFFTElasticHalfSpace
from ContactMechanics.Systems import NonSmoothContactSystem
from scipy.optimize import minimize_scalar
from SurfaceTopography import Topography

__all__ = ["adhesive_pull_off", "contact_at_load"]

PASCAL_PER_GPA = 1e9
NEWTON_PER_NN = 1e-9

#: Overlap or open gap (nm) that pixels in contact may have.
OVERLAP = 1e-4
#: Force that may be left on a pixel in equilibrium, over the largest adhesive force on one.
RESIDUAL = 1e-4


def contact_at_load(gap, pixel_size, modulus, load):
    """Pressure (n, n) in Pa of elastic contact without adhesion, and the solver's iterations.

    gap: (n, n) in nm at any approach; pixel_size: nm; modulus: effective modulus in Pa; load: N.
    Constrained conjugate gradients (Polonsky and Keer, Wear 231 (1999) 206).
    Raises ValueError if what the solver returns is no solution: not converged, another load,
    tension, an overlap, a gap under pressure, or the uniform pressure of a solver that never
    began.
    """
    # Heights that are all below zero the solver takes for no contact: centred, some are above.
    body, half_space = _bodies(gap.mean() - gap, pixel_size, modulus)
    system = NonSmoothContactSystem(half_space, body)
    found = system.minimize_proxy(external_force=load / NEWTON_PER_NN, pentol=OVERLAP / 2)
    _refuse(not found.success, found.message)
    _refuse(found.nit < 2, f"{found.nit} iterations")
    pressure = found.jac / pixel_size**2 * PASCAL_PER_GPA
    pressing = pressure > 0
    left = system.compute_gap(found.x, found.offset)
    carried = found.jac.sum() * NEWTON_PER_NN
    _refuse(abs(carried / load - 1) > 1e-6, f"a load of {carried:.3g} N")
    _refuse(pressure.min() < 0, f"a tension of {-pressure.min():.3g} Pa")
    _refuse(left.min() < -OVERLAP, f"an overlap of {-left.min():.2g} nm")
    _refuse(left[pressing].max() > OVERLAP, f"pressure across {left[pressing].max():.2g} nm")
    _refuse(
        pressing.all() or pressure.max() > modulus,
        f"{pressing.mean():.0%} of all pixels in contact, peak pressure {pressure.max():.3g} Pa",
    )
    return pressure, found.nit


def adhesive_pull_off(gap, pixel_size, modulus, work_of_adhesion, rho):
    """Pull-off forces (N), rigid and elastic, of one window, and the solver's iterations.

    gap: (n, n) in nm at any approach; pixel_size, rho: nm; modulus: effective modulus in Pa;
    work_of_adhesion: J/m². Rigid: Eq. 3 at closest approach. Elastic: the largest attraction in
    equilibrium while the bodies part, with the exponential potential of Eq. 1 outside a hard
    wall, by L-BFGS-B (the paper, elastic analysis).
    Raises ValueError if an equilibrium was not found, and for bodies so soft that attraction
    stretches them by more than a tenth of rho: they let go far from where this looks.
    """
    heights = gap.min() - gap
    attraction = work_of_adhesion / rho * pixel_size**2 * np.exp(heights / rho)
    body, half_space = _bodies(heights, pixel_size, modulus)
    system = BoundedSmoothContactSystem(half_space, Exponential(work_of_adhesion, rho), body)
    # The attraction of rigid bodies stretches them nearly as that of elastic ones does.
    displacement = half_space.evaluate_disp(attraction)
    stretch = -displacement.min()
    _refuse(stretch > rho / 10, f"bodies stretched by {stretch:.2g} nm")
    iterations = 0

    def force(offset):
        nonlocal displacement, iterations
        found = system.minimize_proxy(
            offset=offset,
            initial_displacements=np.maximum(displacement, heights + offset),
            options={"ftol": 0, "gtol": RESIDUAL * attraction.max(), "maxiter": 5000},
        )
        displacement, iterations = system.disp, iterations + found.nit
        _check_equilibrium(found, system, attraction.max())
        # Attraction less the wall's reaction: what is left on free pixels does not add up in it.
        return system.interaction_force.sum() - system.force[system.gap <= 0].sum()

    # The bodies let go near where they would just touch if the surface stayed stretched.
    found = minimize_scalar(
        force, bounds=(-1.5 * stretch, 0), method="bounded", options={"xatol": stretch / 6}
    )
    _refuse(not found.success or iterations < 2, f"{found.message}, {iterations} iterations")
    return attraction.sum() * NEWTON_PER_NN, -found.fun * NEWTON_PER_NN, iterations


def _bodies(heights, pixel_size, modulus):
    """Rigid body and half space of the same period; heights: (n, n) nm, modulus: Pa."""
    size = tuple(pixels * pixel_size for pixels in heights.shape)
    body = Topography(heights, size, periodic=True)
    return body, PeriodicFFTElasticHalfSpace(heights.shape, modulus / PASCAL_PER_GPA, size)


def _check_equilibrium(found, system, largest):
    """Raise ValueError unless the bodies rest: no overlap, no force but on a touching pixel."""
    _refuse(not found.success, found.message)
    _refuse(system.gap.min() < -OVERLAP, f"an overlap of {-system.gap.min():.2g} nm")
    residual = np.where(system.gap > OVERLAP, np.abs(system.force), np.maximum(system.force, 0))
    _refuse(
        residual.max() > 2 * RESIDUAL * largest,
        f"{residual.max() / largest:.2g} of the largest adhesive force left on a pixel",
    )


def _refuse(wrong, what):
    if wrong:
        raise ValueError(f"expected an elastic contact in equilibrium, found {what}")
