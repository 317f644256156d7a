"""Mean forces over scans, their samples, and forces between the ranges computed."""

import numpy as np
import pytest
from known_forces import RHOS, power_curves, power_forces

from hardcontact.adhesion import force_curves
from hardcontact.adhesion.bootstrap import Bootstrap


def test_resampled_means_of_full_counts_are_means():
    pairs = np.random.default_rng(0).random((2, 3, 4, 5))
    means = force_curves.resampled_means(pairs, np.ones((1, 2, 3)), np.ones((1, 4)))
    np.testing.assert_allclose(means[0], pairs.mean(axis=(1, 2)))


def test_a_scan_that_is_drawn_twice_counts_twice():
    pairs = np.array([1.0, 4.0]).reshape(1, 2, 1, 1)
    means = force_curves.resampled_means(pairs, np.array([[[2, 1]]]), np.ones((1, 1)))
    assert means == pytest.approx(2.0)


def test_samples_scatter_as_the_mean_of_independent_scans_does():
    forces = power_forces(spread=0.3, scans=12).isel(sphere_scan=[0], rho=[0])
    means, sampled = force_curves.mean_forces(forces, Bootstrap(0, 4000, 0.95))
    scans = forces.mean(["sphere_scan", "contact_y", "contact_x"]).isel(rho=0)
    np.testing.assert_allclose(means[:, 0], scans.mean("scan"))
    expected = scans.std("scan") / np.sqrt(12)  # ddof 0, of the drawn scans themselves
    np.testing.assert_allclose(sampled[:, :, 0].std(axis=0), expected, rtol=0.05)


def test_sphere_scans_are_drawn_for_all_surfaces_at_once():
    forces = power_forces().copy()
    forces *= np.array([1.0, 2.0, 3.0, 4.0])[:, None, None, None]  # by sphere scan
    _, sampled = force_curves.mean_forces(forces, Bootstrap(0, 20, 0.95))
    ratios = sampled / sampled[:, [0]]
    assert np.ptp(sampled, axis=0).min() > 0
    np.testing.assert_allclose(ratios, np.broadcast_to(ratios[:1], ratios.shape))


def test_power_laws_are_followed_between_the_ranges_computed():
    forces = power_forces(rho=4.0, work=0.05)
    at_four = force_curves.at_range(forces, 4.0)
    np.testing.assert_allclose(
        at_four.isel(scan=0, sphere_scan=0, contact_y=0, contact_x=0) * 0.05,
        power_curves(4.0, 1.0)[:, 4] * (4 / 5) ** np.array([2, 1.3, 0.7, 0.4]),
    )
    fine = np.geomspace(0.5, 10, 33)
    expected = power_curves()[:, :1] * (fine / 0.5) ** np.array([2, 1.3, 0.7, 0.4])[:, None]
    np.testing.assert_allclose(force_curves.on_fine_grid(power_curves(), RHOS, fine), expected)
    two = force_curves.on_fine_grid(power_curves()[:, :2], RHOS[:2], np.array([0.7]))
    np.testing.assert_allclose(
        two[:, 0], power_curves()[:, 0] * 1.4 ** np.array([2, 1.3, 0.7, 0.4])
    )


def test_curves_and_their_ratios():
    forces = power_forces(spread=0.3)
    bootstrap = Bootstrap(0, 50, 0.9)
    means, sampled = force_curves.mean_forces(forces, bootstrap)
    curves = force_curves.force_curves(forces, means, sampled, 1, bootstrap)
    np.testing.assert_allclose(curves["ratio"][1], means / means[1])
    np.testing.assert_array_equal(curves["ratio_interval"].isel(surface=1), 1.0)
    contacts = forces.isel(surface=2, rho=3).values
    assert curves["contact_spread"][1][2, 3] == pytest.approx(contacts.std())
