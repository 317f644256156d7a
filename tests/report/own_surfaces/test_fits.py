"""Measured forces on the user's surfaces, and the ranges and works that fit them."""

import numpy as np
import pytest
from answer_inputs import WORK, fit, numbers_of

from hardcontact.report.own_surfaces.fits import fit_numbers, preferred_fit


def test_own_forces_have_numbers_only_for_their_surface():
    numbers = numbers_of(fit=fit())
    assert numbers["measured_force"].source == "measured"
    assert numbers["measured_force_count"].value == 40
    assert numbers["measured_work"].value == pytest.approx(WORK)
    different = fit()
    different["extrapolation_matters"].loc[{"side": "short"}] = 1
    assert numbers_of(fit=different)["extrapolated_work_short"].value == pytest.approx(WORK / 2)
    assert "measured_force" not in numbers_of(fit=fit().assign_coords(surface=["other"]))


def fitted(data):
    """The numbers of a fit by name."""
    return {number.name: number for number in fit_numbers(preferred_fit(data))}


def test_fits_of_several_surfaces_have_a_region():
    numbers = fitted(fit(2))
    assert (numbers["fit_best_range"].value, numbers["fit_best_work"].value) == (5.6, WORK)
    region = numbers["fit_region_range"]
    assert (region.low, region.status) == (3.2, "ends") and np.isnan(region.high)
    assert (numbers["fit_range"].value, numbers["fit_agrees"].value) == (5.6, 1)
    assert np.isnan(numbers["fit_gap"].low)


def test_the_range_of_the_forces_may_lie_outside_of_the_region():
    short_range = fit(2).assign_attrs(rho=1.0)  # the region begins at 3.2 nm
    assert fitted(short_range)["fit_agrees"].value == 0


def test_a_region_may_have_a_gap():
    parted = fit(2)
    parted["region"].loc[{"rho_fine": slice(6, 9)}] = np.nan
    rho = parted["rho_fine"].values
    gap = fitted(parted)["fit_gap"]
    assert (gap.low, gap.high) == (rho[rho < 6].max(), rho[rho > 9].min())


def test_a_fit_without_a_region_has_a_reason():
    assert fitted(fit())["fit_region_range"].status == "one_force"
    nothing = fit(2)
    nothing["region"] *= np.nan
    assert fitted(nothing)["fit_region_range"].status == "no_agreement"
    nothing["work_by_range_interval"] *= np.nan
    assert fitted(nothing)["fit_region_range"].status == "no_interval"
