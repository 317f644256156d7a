"""Elastic contact against Hertz, the rigid limit and the transition between JKR and DMT."""

import numpy as np
import pytest
from published_contact import MODULUS, RADIUS

from hardcontact.contact import elastic as elastic_solvers
from hardcontact.contact.smooth_sphere import hertz_contact


def sphere_gap(pixels, pixel_size, radius=RADIUS):
    shape = ((np.arange(pixels) - pixels // 2) * pixel_size) ** 2 / (2 * radius)
    return shape[:, None] + shape


@pytest.mark.parametrize("load", [1e-6, 10e-6])
def test_a_smooth_sphere_follows_hertz(load):
    pixels, pixel_size = 384, 4.0 * (load / 10e-6) ** (1 / 3)
    radius, peak, approach = hertz_contact(load, RADIUS, MODULUS)
    gap = sphere_gap(pixels, pixel_size)
    pressure = elastic_solvers.pressure_at_load(gap, pixel_size, MODULUS, load)
    area = np.count_nonzero(pressure) * pixel_size**2
    assert np.sqrt(area / np.pi) == pytest.approx(radius, rel=0.01)
    assert pressure.max() == pytest.approx(peak, rel=0.01)
    # Boussinesq: the pressure pushes the flat under the apex down by the approach.
    y, x = np.indices(pressure.shape) - pixels // 2
    distance = np.hypot(y, x) * pixel_size
    distance[pixels // 2, pixels // 2] = pixel_size / (4 * np.log(1 + np.sqrt(2)))
    pushed = (pressure / distance).sum() * pixel_size**2 / (np.pi * MODULUS)
    assert pushed == pytest.approx(approach, rel=0.01)


def test_lifting_the_gap_changes_no_pressure():
    # Heights that are all below zero make the solver report success after one iteration.
    gap = sphere_gap(128, 12.0)
    near, far = (
        elastic_solvers.pressure_at_load(gap + lift, 12.0, MODULUS, 10e-6) for lift in (0.0, 300.0)
    )
    np.testing.assert_allclose(near, far, rtol=1e-6, atol=1e-6 * near.max())


def test_a_load_that_flattens_everything_is_refused():
    with pytest.raises(ValueError, match="expected an elastic contact in equilibrium, found"):
        elastic_solvers.pressure_at_load(sphere_gap(64, 1.0, 1e9), 1.0, MODULUS, 10e-6)


def test_stiff_bodies_have_the_rigid_pull_off_force():
    rng = np.random.default_rng(4)
    gap = sphere_gap(96, 12.0) + rng.normal(0, 1.0, (96, 96))
    differences = []
    for stiffer in (1, 10):
        rigid, pull_off = elastic_solvers.adhesive_pull_off(
            gap, 12.0, stiffer * MODULUS, 46.3e-3, 5.6
        )
        assert pull_off <= rigid * (1 + 1e-6)
        differences.append(1 - pull_off / rigid)
    assert differences[0] < 0.01
    assert differences[1] < 0.3 * differences[0] + 1e-5


def test_bodies_too_soft_are_refused():
    with pytest.raises(ValueError, match="found bodies stretched by"):
        elastic_solvers.adhesive_pull_off(sphere_gap(64, 12.0), 12.0, 1e6, 46.3e-3, 5.6)


def test_a_failing_solver_is_an_error(monkeypatch):
    from scipy.optimize import OptimizeResult

    def gives_up(self, **_):
        return OptimizeResult(success=False, message="gave up", nit=7)

    monkeypatch.setattr(elastic_solvers.NonSmoothContactSystem, "minimize_proxy", gives_up)
    with pytest.raises(ValueError, match="gave up"):
        elastic_solvers.pressure_at_load(sphere_gap(32, 12.0), 12.0, MODULUS, 10e-6)
