"""Elastic contact by the libraries ContactMechanics and Adhesion, to compare with."""

import numpy as np
from Adhesion.Interactions import Exponential
from Adhesion.System import BoundedSmoothContactSystem
from ContactMechanics import PeriodicFFTElasticHalfSpace
from ContactMechanics.Systems import NonSmoothContactSystem
from scipy.optimize import minimize_scalar
from SurfaceTopography import Topography


def half_space_and_body(heights, pixel_size, modulus):
    """Return a half space of a modulus (Pa) and a rigid body (n, n) in nm; they use nm and GPa."""
    size = (len(heights) * pixel_size,) * 2
    half_space = PeriodicFFTElasticHalfSpace(heights.shape, modulus * 1e-9, size)
    return half_space, Topography(heights, size, periodic=True)


def library_pressure(gap, pixel_size, modulus, load):
    """Return the pressure (n, n) in Pa at a load (N), by constrained conjugate gradients."""
    # The solver finds no contact if all heights are below zero.
    system = NonSmoothContactSystem(*half_space_and_body(gap.mean() - gap, pixel_size, modulus))
    solution = system.minimize_proxy(external_force=load * 1e9, pentol=1e-5)
    assert solution.success and solution.nit > 1
    return solution.jac / pixel_size**2 * 1e9


def library_pull_off(gap, pixel_size, modulus, work, rho):
    """Return the elastic pull-off force (N), by L-BFGS-B outside a hard wall at each approach."""
    heights = gap.min() - gap
    attraction = work / rho * pixel_size**2 * np.exp(heights / rho)
    half_space, body = half_space_and_body(heights, pixel_size, modulus)
    system = BoundedSmoothContactSystem(half_space, Exponential(work, rho), body)
    displacement = half_space.evaluate_disp(attraction)
    elongation = -displacement.min()
    options = {"ftol": 0, "gtol": 1e-5 * attraction.max(), "maxiter": 5000}

    def normal_force(offset):  # nN, negative if attraction exceeds repulsion
        nonlocal displacement
        start = np.maximum(displacement, heights + offset)
        system.minimize_proxy(offset=offset, initial_displacements=start, options=options)
        displacement = system.disp
        return system.interaction_force.sum() - system.force[system.gap <= 0].sum()

    optimum = minimize_scalar(
        normal_force,
        bounds=(-1.5 * elongation, 3 * elongation),
        method="bounded",
        options={"xatol": 1e-3 * elongation},
    )
    return -optimum.fun * 1e-9
