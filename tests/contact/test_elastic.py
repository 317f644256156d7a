"""Elastic contact against Hertz, the rigid limit, and two libraries."""

import numpy as np
import pytest
from elastic_libraries import library_pressure, library_pull_off
from paper_numbers import MODULUS, RADIUS
from periodic_maps import CONTACT, make_bodies, periodic_noise

from hardcontact.contact.elastic import (
    ELASTIC_UNITS,
    adhesive_pull_off,
    pressure_at_load,
    solve_elastic_contacts,
)
from hardcontact.contact.geometry import sample_contacts
from hardcontact.contact.hertz_jkr_dmt import hertz_peak_pressure

LOAD = 10e-6  # N
WORK, RHO = CONTACT.work, CONTACT.rho


def sphere_gap(pixels, pixel_size, radius=RADIUS):
    """The gap (pixels, pixels) in nm under a smooth sphere."""
    shape = ((np.arange(pixels) - pixels // 2) * pixel_size) ** 2 / (2 * radius)
    return shape[:, None] + shape


def rough_gap(rms):
    """The gap (64, 64) in nm between a sphere and noise of an rms height (nm)."""
    return sphere_gap(64, 12.0) - periodic_noise(64, rms, 4)


@pytest.mark.parametrize("load", [1e-6, 10e-6])
def test_a_smooth_sphere_follows_hertz(load):
    pixels, pixel_size = 384, 12.0 * (load / LOAD) ** (1 / 3)  # grows as the contact radius
    peak = hertz_peak_pressure(load, RADIUS, MODULUS)
    contact_radius = np.sqrt(1.5 * load / (np.pi * peak)) * 1e9  # nm
    gap = sphere_gap(pixels, pixel_size)
    pressure = pressure_at_load(gap, pixel_size, MODULUS, load)
    area = np.count_nonzero(pressure) * pixel_size**2
    assert np.sqrt(area / np.pi) == pytest.approx(contact_radius, rel=0.03)  # half a pixel
    assert pressure.max() == pytest.approx(peak, rel=1e-4)
    # Boussinesq: the pressure pushes the flat under the apex down by the approach. The distance at
    # the apex is the harmonic mean over its pixel.
    y, x = np.indices(pressure.shape) - pixels // 2
    distance = np.hypot(y, x) * pixel_size
    distance[pixels // 2, pixels // 2] = pixel_size / (4 * np.log(1 + np.sqrt(2)))
    displacement = (pressure / distance).sum() * pixel_size**2 / (np.pi * MODULUS)
    assert displacement == pytest.approx(contact_radius**2 / RADIUS, rel=0.01)


@pytest.mark.parametrize("rms", [0.5, 5.0, 50.0])
def test_pressures_are_those_of_conjugate_gradients(rms):
    gap = rough_gap(rms)
    pressure = pressure_at_load(gap, 12.0, MODULUS, LOAD)
    expected = library_pressure(gap, 12.0, MODULUS, LOAD)
    np.testing.assert_array_equal(pressure > 0, expected > 0)
    np.testing.assert_allclose(pressure, expected, atol=1e-4 * expected.max())


@pytest.mark.parametrize("rms", [0.5, 5.0])
def test_pull_off_is_that_of_a_minimizer_outside_a_wall(rms):
    gap = rough_gap(rms)
    _, force = adhesive_pull_off(gap, 12.0, MODULUS / 10, WORK, RHO)
    expected = library_pull_off(gap, 12.0, MODULUS / 10, WORK, RHO)
    assert force == pytest.approx(expected, rel=1e-6)
    # The search over approaches in the library may end beside the largest force.
    assert force >= expected * (1 - 1e-8)


def test_a_load_that_flattens_everything_is_refused():
    with pytest.raises(ValueError, match="found over 4000 touching pixels"):
        pressure_at_load(sphere_gap(72, 1.0, 1e9), 1.0, MODULUS, LOAD)  # 5184 pixels


def test_stiff_bodies_have_the_rigid_pull_off_force():
    gap = rough_gap(1.0)
    # To first order the difference is proportional to the compliance.
    differences = []
    for factor in (1, 10):
        rigid, pull_off = adhesive_pull_off(gap, 12.0, factor * MODULUS, WORK, RHO)
        differences.append(1 - pull_off / rigid)
    assert 0 < differences[0] < 0.01
    assert differences[1] == pytest.approx(differences[0] / 10, rel=1e-3)


def test_bodies_too_soft_are_refused():
    with pytest.raises(ValueError, match="a stretch of at most rho/10"):
        adhesive_pull_off(sphere_gap(64, 12.0), 12.0, 1e6, WORK, RHO)


def test_elastic_contacts_carry_the_preload(monkeypatch):
    monkeypatch.setattr("hardcontact.contact.elastic.PULL_OFF_WINDOW", 600.0)
    bodies = make_bodies(periodic_noise(96, 2.0, 1), periodic_noise(96, 0.3, 2), 8.0, 512, 3)
    indices = sample_contacts(np.random.default_rng(1), 3, 2)
    solved = solve_elastic_contacts(bodies, CONTACT, indices, MODULUS)
    assert {name: solved[name].units for name in ELASTIC_UNITS} == ELASTIC_UNITS
    assert solved.sizes["contact"] == 2
    load = solved.elastic_contact_area * 1e-18 * solved.mean_pressure
    np.testing.assert_allclose(load, 10e-6, rtol=1e-5)
    assert (solved.elastic_pull_off_force <= solved.rigid_pull_off_force * (1 + 1e-6)).all()
    assert solved.pressure.max() == solved.peak_pressure[0]
    assert solved.pressure.values[32, 32] == solved.pressure.max()  # of 64 x 64 pixels
    assert solved.effective_modulus == MODULUS
    assert solved.hertz_peak_pressure == hertz_peak_pressure(10e-6, RADIUS, MODULUS)
