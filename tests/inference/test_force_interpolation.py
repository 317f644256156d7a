"""Interpolation of forces, against power laws and against the sums themselves."""

import numpy as np
import pytest
import xarray as xr
from known_forces import RHOS, SLOPES, power_curves, power_forces
from paper_numbers import MEAN_FORCE
from repository import PAPER

from hardcontact.inference.fit import interpolate_forces, interpolate_to_ranges


def test_interpolation_between_ranges_follows_power_laws():
    forces = power_forces(rho=4.0, work=0.05)
    forces_at_four = interpolate_forces(forces, 4.0)
    single_forces = forces_at_four.isel(scan=0, sphere_scan=0, contact_y=0, contact_x=0)
    np.testing.assert_allclose(single_forces * 0.05, MEAN_FORCE)
    assert interpolate_forces(forces, 0.49).isnull().all()
    fine = np.geomspace(0.5, 10, 33)
    power_laws = power_curves()[:, :1] * (fine / 0.5) ** SLOPES[:, None]
    np.testing.assert_allclose(interpolate_to_ranges(power_curves(), RHOS, fine), power_laws)
    two_range_forces = interpolate_to_ranges(power_curves()[:, :2], RHOS[:2], np.array([0.7]))
    np.testing.assert_allclose(two_range_forces[:, 0], power_curves()[:, 0] * (0.7 / 0.5) ** SLOPES)


def sphere_on_steps(rhos):
    """Return the force (rho) on pixels at a few heights, which rises toward both ends of rho."""
    gaps = np.array([0.0, 0.05, 0.3, 2.0, 9.0, 40.0, 90.0])
    pixels = np.array([17, 40, 90, 600, 8e3, 9e4, 2e5])
    return (pixels * np.exp(-gaps / np.asarray(rhos)[:, None])).sum(axis=1) / rhos


def test_the_study_s_ranges_are_close_enough_for_interpolation():
    ranges = np.array([float(rho.removesuffix(" nm")) for rho in PAPER["adhesion"]["ranges"]])
    assert (ranges[0], ranges[-1]) == (0.05, 40.0) and 5.6 in ranges
    fine = np.geomspace(ranges[0], ranges[-1], 801)
    interpolated_forces = interpolate_to_ranges(sphere_on_steps(ranges), ranges, fine)
    np.testing.assert_allclose(interpolated_forces, sphere_on_steps(fine), rtol=0.02)
    assert interpolated_forces[[0, -1]] == pytest.approx(sphere_on_steps(ranges)[[0, -1]])
    forces = xr.DataArray(sphere_on_steps(ranges), {"rho": ranges}, "rho")
    for rho in (0.05, 0.07, 5.6, 13.3, 39.0, 40.0):
        exact_force = sphere_on_steps(np.array([rho]))[0]
        assert float(interpolate_forces(forces, rho)) == pytest.approx(exact_force, rel=0.02)
