"""Numbers about forces: known powers of the range, known distributions."""

import numpy as np
import pytest
import xarray as xr
from paper_claims import NUMBERS, judge_one, make_sets, near
from paper_datasets import RADIUS, make_adhesion, make_datasets
from scipy import stats

from hardcontact.claims.evaluation import estimate
from hardcontact.claims.force_quantities import (
    area_slope,
    force_decades,
    force_slope,
    least_force,
    lognormal_misfit,
    plastic_over_rigid,
    short_range_rise,
    smooth_sphere_change,
)


def test_force_slope_is_the_exponent():
    slope = force_slope(make_adhesion())["value"].sel(contact_model="plastic")
    np.testing.assert_allclose(slope, [0.9, 0.6, 0.3, 0.2])


def test_area_that_attracts_grows_by_one_power_more_than_the_force():
    adhesion = make_adhesion()
    near(area_slope(adhesion).sel(contact_model="plastic"), [1.9, 1.6, 1.3, 1.2])


def test_plastic_over_rigid():
    ratio = plastic_over_rigid(make_adhesion())["value"]
    adhesion = make_adhesion()["pull_off_force"].sel(rho=5.6).mean(["contact_y", "contact_x"])
    expected = adhesion.sel(contact_model="plastic") / adhesion.sel(contact_model="rigid")
    np.testing.assert_allclose(ratio, expected.mean(["scan", "sphere_scan"]), rtol=0.05)


def test_rise_at_short_ranges():
    adhesion = make_adhesion()
    rise = short_range_rise(adhesion).sel(contact_model="plastic", surface="mcd")
    mean = adhesion["pull_off_force"].mean(["sphere_scan", "contact_y", "contact_x"])
    mean = mean.sel(contact_model="plastic", surface="mcd")
    near(rise, (mean.sel(rho=0.05) / mean.sel(rho=2.0)).mean())
    adhesion["pull_off_force"].loc[{"rho": 0.05}] = 1e-12
    datasets = make_datasets() | {"adhesion": adhesion}
    alike = make_sets(datasets, [1.0])
    assert judge_one("short_range_rise", datasets, alike).verdict == "not reproduced"


def test_least_force_is_that_before_the_rise_at_the_published_work():
    adhesion = make_adhesion()
    force = adhesion["pull_off_force"].sel(rho=2.0)
    expected = 0.0463 * force.mean(["scan", "sphere_scan", "contact_y", "contact_x"])
    near(least_force(adhesion, NUMBERS).sel(surface="mcd"), expected.sel(surface="mcd"))


def test_smooth_sphere_has_the_same_force_at_all_ranges():
    assert float(smooth_sphere_change(make_adhesion())["value"]) < 1e-9


def test_coarse_pixels_show_at_small_ranges():
    """Pixels as wide as the disk of interaction: the sum over them is no integral any more."""
    adhesion = make_adhesion().assign_attrs(pixel_size=np.sqrt(RADIUS * 0.05) * 4)
    assert float(smooth_sphere_change(adhesion)["value"]) > 0.1


def with_forces(forces):
    """An adhesion dataset with these (n,) forces at the reference range, whatever the surface."""
    adhesion = make_adhesion()
    shape = adhesion["pull_off_force"].isel(surface=0, contact_model=0, rho=0).shape
    adhesion["pull_off_force"] = xr.zeros_like(adhesion["pull_off_force"]) + xr.DataArray(
        forces.reshape(shape), dims=("scan", "sphere_scan", "contact_y", "contact_x")
    )
    return adhesion


DISTRIBUTIONS = {
    "lognormal_misfit": stats.lognorm(0.9, scale=2e-7),
    "half_gaussian_misfit": stats.halfnorm(scale=2e-7),
    "inverse_gaussian_misfit": stats.invgauss(3.0, scale=2e-7),
}


@pytest.mark.parametrize("name", DISTRIBUTIONS)
def test_misfit_is_small_for_the_right_distribution(name):
    forces = DISTRIBUTIONS[name].rvs(1000, random_state=4)
    assert (estimate(name, with_forces(forces))["value"] < 0.05).all()


@pytest.mark.parametrize("name", ["half_gaussian_misfit", "inverse_gaussian_misfit"])
def test_misfit_is_large_for_the_wrong_distribution(name):
    forces = np.tile([1e-8, 1e-5], 500)
    assert (estimate(name, with_forces(forces))["value"] > 0.2).all()


def test_lognormal_misfit_tells_lognormal_from_bimodal():
    adhesion = make_adhesion()
    assert (lognormal_misfit(adhesion)["value"] < 0.05).all()
    adhesion["pull_off_force"][..., :5] *= 1e4
    assert (lognormal_misfit(adhesion)["value"] > 0.1).all()


def test_force_decades():
    adhesion = make_adhesion()
    adhesion["pull_off_force"][:] = 1e-7
    adhesion["pull_off_force"][..., 0] = 1e-5
    np.testing.assert_allclose(force_decades(adhesion)["value"], 2.0)
