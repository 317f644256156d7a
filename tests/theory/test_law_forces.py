"""Forces of any law from the exponential sums: against the direct sum of the law over pixels."""

import numpy as np
import pytest
from periodic_maps import RADIUS, height_map, make_bodies, periodic_noise

from hardcontact.contact.contact import Contact
from hardcontact.contact.geometry import flattened_gaps, gap_map
from hardcontact.contact.pull_off import pull_off_force
from hardcontact.inference.filtered_masters import Filters
from hardcontact.theory.interaction_laws import LAWS, law_forces, pressure, range_grid
from hardcontact.theory.law_forces import (
    LARGEST_EXPONENT,
    filtered_range_forces,
    range_forces,
    scan_range_forces,
)

POWERS = [law for law in LAWS if not law.exponential]
HARDNESS = 25e9


def range_arguments(pixel_size, contact_pixel_count, ranges, contacts_per_side=3, reach=0.0):
    """Return arguments for range_forces, with this number of contact pixels."""
    preload = contact_pixel_count * HARDNESS * (pixel_size * 1e-9) ** 2
    contact = Contact(
        radius=RADIUS, preload=preload, hardness=HARDNESS, window=8000.0, count=contacts_per_side
    )
    return contact, reach, list(ranges)


def direct_forces(bodies, contact_pixel_count, law, rho):
    """Eq. 3 with the pressure of the law itself, over every pixel of every contact, in N."""
    indices = np.ndindex(*[len(bodies.geometry.positions)] * 2)
    gaps = [flattened_gaps(gap_map(bodies, index), contact_pixel_count) for index in indices]
    totals = np.array([pressure(law, gap, rho).sum() for gap in gaps])
    return pull_off_force(totals, rho, bodies.geometry.pixel_size, 1.0).reshape(3, 3)


@pytest.mark.parametrize("law", POWERS, ids=lambda law: law.name)
@pytest.mark.parametrize("contact_pixel_count", [1, 17])
@pytest.mark.parametrize(("rms", "rough"), [(20.0, False), (60.0, False), (20.0, True)])
def test_the_force_of_a_law_is_its_direct_sum(law, contact_pixel_count, rms, rough):
    roughness = periodic_noise(96, 0.7, 4) if rough else None
    bodies = make_bodies(periodic_noise(96, rms, 3), roughness, 50.0, 160, 3)
    ranges = range_grid(5.6, 0.45, 0.01, 1e5)
    forces = range_forces(bodies, *range_arguments(50.0, contact_pixel_count, ranges))
    for rho in (0.15, 2.0, 8.0):
        mixture = law_forces(law, [rho], ranges, np.moveaxis(forces, 0, -1))[..., 0]
        direct = direct_forces(bodies, contact_pixel_count, law, rho)
        np.testing.assert_allclose(mixture, direct, rtol=3e-5)


def test_a_high_peak_outside_the_window_does_not_overflow():
    # The windows of the contacts in the first row and column exclude a tower: exp(height/rho)
    # overflows.
    heights = periodic_noise(96, 20.0, 3)
    heights[48, 48] += 400.0
    bodies = make_bodies(heights, None, 500.0, 40, 2)
    law = next(law for law in LAWS if law.name == "van_der_waals")
    rho, ranges = 0.15, range_grid(5.6, 0.5, 0.01, 1e5)
    forces = range_forces(bodies, *range_arguments(500.0, 3, ranges))
    mixture = law_forces(law, [rho], ranges, np.moveaxis(forces, 0, -1))[..., 0]
    assert 48 not in (bodies.geometry.positions[0] + bodies.geometry.offsets()) % 96
    assert heights.max() / ranges[0] > 2 * LARGEST_EXPONENT
    for indices, force in np.ndenumerate(mixture):
        total = pressure(law, flattened_gaps(gap_map(bodies, indices), 3), rho).sum()
        assert force == pytest.approx(pull_off_force(total, rho, 500.0, 1.0), rel=3e-5)


@pytest.mark.parametrize("law", LAWS, ids=lambda law: law.name)
def test_a_smooth_sphere_on_a_flat_has_derjaguin_s_force(law):
    # 2 pi R times the energy, without the attraction beyond the window: it lies between that beyond
    # the inscribed circle and that beyond the circumscribed circle of the window.
    pixel_size, rho, window = 100.0, 5.6, 800
    flat = make_bodies(np.zeros((400, 400)), None, pixel_size, window, 1)
    ranges = range_grid(5.6, 0.5, 0.01, 1e6)
    arguments = range_arguments(pixel_size, 1, ranges, 1, window * pixel_size)
    force = law_forces(law, [rho], ranges, range_forces(flat, *arguments)[:, 0, 0]).item()
    ideal = 2 * np.pi * RADIUS * 1e-9
    edge = (window * pixel_size / 2) ** 2 / (2 * RADIUS)
    energy_beyond = (1 + np.array([2, 1]) * edge / law.spacing(rho)) ** -law.exponent
    low, high = np.sort(ideal * (1 - (0 if law.exponential else energy_beyond)) * np.ones(2))
    assert low * (1 - 3e-3) < force < high * (1 + 3e-3)


def test_a_filter_that_removes_nothing_changes_no_force():
    master = height_map(periodic_noise(128, 10.0, 5), 20.0)
    arguments = range_arguments(20.0, 5, [1.0, 5.6], 2)
    filters = Filters("small", 128, [50.0, 400.0])
    filtered = filtered_range_forces(master, filters, *arguments)
    unfiltered = filtered["unfiltered_pull_off_force"].values
    scan = scan_range_forces(master, None, *arguments)
    np.testing.assert_allclose(unfiltered, scan["pull_off_force"])
    short_cutoff, long_cutoff = filtered["pull_off_force"].values / unfiltered
    assert abs(short_cutoff - 1).max() < abs(long_cutoff - 1).max()
