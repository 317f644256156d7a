"""Mean forces over scans and between the ranges computed; statistics of a known log-normal."""

import numpy as np
import pytest
import xarray as xr
from known_forces import RHOS, power_curves, power_forces
from repository import PAPER
from scipy.stats import lognorm

from hardcontact.base.statistics import Sampling, bounds, percentile_interval, student_log_interval
from hardcontact.contact import force_curves
from hardcontact.contact.force_curves import FORCE_STATISTICS, force_statistics


def test_means_are_sampled_over_scans():
    forces = power_forces(spread=0.3, scans=5)
    means, samples = force_curves.mean_forces(forces, Sampling(0, 20000, 0.95))
    scans = forces.mean(["sphere_scan", "contact_y", "contact_x"])
    np.testing.assert_allclose(means, scans.mean("scan"))
    sampled_interval = percentile_interval(samples, 0.95)
    student_interval = student_log_interval(scans, 0.95, "scan").transpose(
        "surface", "rho", "bound"
    )
    np.testing.assert_allclose(sampled_interval, student_interval, rtol=0.02)


def test_missing_scans_change_no_mean():
    forces = power_forces(spread=0.3, scans=5)
    incomplete_forces = forces.copy()
    incomplete_forces[0, 3:] = np.nan
    means, samples = force_curves.mean_forces(incomplete_forces, Sampling(0, 10, 0.95))
    remaining_forces = forces.isel(surface=[0], scan=slice(3))
    remaining_means, remaining_samples = force_curves.mean_forces(
        remaining_forces, Sampling(0, 10, 0.95)
    )
    np.testing.assert_allclose(means[0], remaining_means[0])
    np.testing.assert_allclose(samples[:, 0], remaining_samples[:, 0])


def test_contact_models_share_random_numbers_but_surfaces_do_not():
    forces = power_forces(spread=0.3)
    _, samples = force_curves.mean_forces(forces, Sampling(0, 20, 0.95))
    _, doubled_samples = force_curves.mean_forces(2 * forces[1:], Sampling(0, 20, 0.95))
    np.testing.assert_allclose(doubled_samples, 2 * samples[:, 1:])
    assert abs(np.corrcoef(np.log(samples[:, :2, 0]).T)[0, 1]) < 0.9


def test_interpolation_between_ranges_follows_power_laws():
    forces = power_forces(rho=4.0, work=0.05)
    forces_at_four = force_curves.interpolate_to_range(forces, 4.0)
    np.testing.assert_allclose(
        forces_at_four.isel(scan=0, sphere_scan=0, contact_y=0, contact_x=0) * 0.05,
        power_curves(4.0, 1.0)[:, 4] * (4 / 5) ** np.array([2, 1.3, 0.7, 0.4]),
    )
    assert force_curves.interpolate_to_range(forces, 0.49).isnull().all()
    fine = np.geomspace(0.5, 10, 33)
    power_laws = power_curves()[:, :1] * (fine / 0.5) ** np.array([2, 1.3, 0.7, 0.4])[:, None]
    np.testing.assert_allclose(
        force_curves.interpolate_to_ranges(power_curves(), RHOS, fine), power_laws
    )
    two = force_curves.interpolate_to_ranges(power_curves()[:, :2], RHOS[:2], np.array([0.7]))
    np.testing.assert_allclose(
        two[:, 0], power_curves()[:, 0] * 1.4 ** np.array([2, 1.3, 0.7, 0.4])
    )


def sphere_on_steps(rhos):
    """Force (rho) of a smooth sphere on pixels at a few heights: it rises at both ends of rho."""
    gaps = np.array([0.0, 0.05, 0.3, 2.0, 9.0, 40.0, 90.0])
    pixels = np.array([17, 40, 90, 600, 8e3, 9e4, 2e5])
    return (pixels * np.exp(-gaps / np.asarray(rhos)[:, None])).sum(axis=1) / rhos


def test_the_study_s_ranges_are_close_enough_for_interpolation():
    """Against the sum itself, between all ranges and up to both ends of the sweep."""
    ranges = np.array([float(rho.removesuffix(" nm")) for rho in PAPER["adhesion"]["ranges"]])
    assert (ranges[0], ranges[-1]) == (0.05, 40.0) and 5.6 in ranges
    fine = np.geomspace(ranges[0], ranges[-1], 801)
    interpolated_forces = force_curves.interpolate_to_ranges(sphere_on_steps(ranges), ranges, fine)
    np.testing.assert_allclose(interpolated_forces, sphere_on_steps(fine), rtol=0.02)
    assert interpolated_forces[[0, -1]] == pytest.approx(sphere_on_steps(ranges)[[0, -1]])
    forces = xr.DataArray(sphere_on_steps(ranges), {"rho": ranges}, "rho")
    for rho in (0.05, 0.07, 5.6, 13.3, 39.0, 40.0):
        exact_force = sphere_on_steps(np.array([rho]))[0]
        assert float(force_curves.interpolate_to_range(forces, rho)) == pytest.approx(
            exact_force, rel=0.02
        )


KNOWN = lognorm(0.9, scale=6e-8)
FORCES = KNOWN.rvs(size=(5, 4, 200), random_state=np.random.default_rng(0))


def test_statistics_recover_a_known_distribution():
    statistics = force_statistics(FORCES, 3e-8, Sampling(0, 200, 0.95))
    known_values = (KNOWN.mean(), KNOWN.median(), 0.9, 6e-8, KNOWN.cdf(3e-8))
    for (name, unit), value in zip(FORCE_STATISTICS.items(), known_values, strict=True):
        assert float(statistics[name]) == pytest.approx(value, rel=0.1), name
        assert statistics[name].attrs["units"] == unit
        low, high = bounds(statistics, name)
        assert low < statistics[name] < high, name
    assert float(statistics.mean_force_at_pair) == pytest.approx(FORCES.mean())
    assert float(statistics.median_force_at_pair) == pytest.approx(np.median(FORCES))
    assert float(statistics.censored_fraction) == pytest.approx((FORCES < 3e-8).mean())


def test_missing_scans_and_contacts_do_not_count():
    padded = np.full((7, 5, 210), np.nan)
    padded[:5, 1:, :200] = FORCES
    sampling = Sampling(0, 20, 0.95)
    assert force_statistics(padded, 3e-8, sampling).equals(force_statistics(FORCES, 3e-8, sampling))


def test_the_interval_comes_from_scans_and_not_from_contacts():
    """Scans differ and their contacts do not: many contacts do not narrow the interval."""
    levels = 1e-7 * np.array([1.0, 2.0, 3.0, 4.0, 5.0])
    forces = np.broadcast_to(levels[:, None, None], (5, 1, 1000))
    statistics = force_statistics(forces, 3e-8, Sampling(0, 1, 0.683))
    scans = xr.DataArray(levels, dims="scan")
    scan_interval = student_log_interval(scans, 0.683, "scan")
    np.testing.assert_allclose(statistics.mean_force_at_pair_interval, scan_interval)
    np.testing.assert_allclose(statistics.censored_fraction_interval, 0.0)


def test_missing_forces_have_no_statistics():
    statistics = force_statistics(np.full((2, 2, 3), np.nan), 3e-8, Sampling(0, 1, 0.9))
    assert all(statistics[name].isnull().all() for name in statistics.data_vars)
