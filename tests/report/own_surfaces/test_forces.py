"""Computed and measured forces of your surfaces, their ratios, and the fit to them."""

import numpy as np
import own_datasets as own
import pytest
from own_answers import PAIRS, numbers_of

from hardcontact.report.own_surfaces.datasets import select_preferred_model
from hardcontact.report.own_surfaces.forces import comparison_numbers, fit_numbers, pair_numbers

#: An octave that scans show, by its shortest wavelength (nm), and its d ln F / d ln a.
OCTAVE, SENSITIVITY = own.OCTAVES[2], own.SENSITIVITIES[2]


def test_the_force_at_other_pairs_follows_a_power_law_within_the_ranges():
    surface_data = own.datasets().select_surface(own.SURFACES[0])
    numbers = {number.name: number for number in pair_numbers(surface_data.force, PAIRS)}
    long_range = numbers["force_of_pair_long_range"]
    # The pair has half the work, and F ~ W rho^-0.5.
    assert long_range.value == pytest.approx(own.FORCE / 2 * (10 / own.RANGE) ** -0.5)
    assert numbers["force_of_pair_long_range_share"].value == PAIRS[1]["share_of_sets"]
    assert numbers["force_of_pair_long_range_range"].value == 10.0
    assert np.isnan(numbers["force_of_pair_short_range"].value)
    assert "force_of_pair_published" not in numbers  # the pair of the study itself


def test_the_sensitivity_to_the_range_needs_two_ranges():
    assert numbers_of()["range_sensitivity"].value == pytest.approx(-0.5)
    one_range = own.force().sel(rho=[own.RANGE])
    assert np.isnan(numbers_of(force=one_range)["range_sensitivity"].value)


def compare(**others):
    """The numbers that compare the second surface with the first, by name."""
    datasets = own.datasets(2, **others)
    reference, twin = (datasets.select_surface(name) for name in datasets.force["surface"].values)
    return {number.name: number for number in comparison_numbers(twin, reference)}


def test_the_errors_of_both_forces_add_in_squares():
    ratio = compare()["force_over_reference"]
    assert ratio.value == pytest.approx(2)
    error = np.exp(np.sqrt(2) * np.log(1.25))
    assert (ratio.low, ratio.high) == pytest.approx((2 / error, 2 * error))
    assert (
        compare(force=own.drop_interval(own.force(2)))["force_over_reference"].status
        == "no_interval"
    )


def test_the_octave_whose_amplitude_differs_makes_the_ratio():
    data = own.spectra(2)
    wavelength = 2 * np.pi / data["wavevector"]
    is_octave = (wavelength >= OCTAVE) & (wavelength <= 2 * OCTAVE)
    is_twin = data["surface"] == data["surface"][1]
    data["spectrum"] = data["spectrum"] * (1 - 0.75 * (is_octave & is_twin))  # half the amplitude
    numbers = compare(spectra=data)
    name = "force_over_reference_octave_1"
    assert numbers[name].value == OCTAVE
    assert numbers[f"{name}_factor"].value == pytest.approx(0.5**SENSITIVITY, rel=0.03)


def test_own_forces_have_numbers_only_for_their_surface():
    numbers = numbers_of(fit=own.fit())
    assert numbers["measured_force"].source == "measured"
    assert numbers["measured_force_count"].value == 40
    assert numbers["measured_work"].value == pytest.approx(own.WORK)
    different = own.fit()
    different["extrapolation_matters"].loc[{"side": "short"}] = 1
    assert numbers_of(fit=different)["extrapolated_work_short"].value == pytest.approx(own.WORK / 2)
    assert "measured_force" not in numbers_of(fit=own.fit().assign_coords(surface=["other"]))


def fitted(data):
    """The numbers of a fit by name."""
    return {number.name: number for number in fit_numbers(select_preferred_model(data))}


def test_fits_of_several_surfaces_have_a_region():
    numbers = fitted(own.fit(2))
    assert (numbers["fit_best_range"].value, numbers["fit_best_work"].value) == (5.6, own.WORK)
    region = numbers["fit_region_range"]
    assert (region.low, region.status) == (3.2, "ends") and np.isnan(region.high)
    assert (numbers["fit_range"].value, numbers["fit_agrees"].value) == (5.6, 1)
    assert np.isnan(numbers["fit_gap"].low)


def test_the_range_of_the_forces_may_lie_outside_of_the_region():
    short_range = own.fit(2).assign_attrs(rho=1.0)  # the region begins at 3.2 nm
    assert fitted(short_range)["fit_agrees"].value == 0


def test_a_region_may_have_a_gap():
    parted = own.fit(2)
    parted["region"].loc[{"rho_fine": slice(6, 9)}] = np.nan
    rho = parted["rho_fine"].values
    gap = fitted(parted)["fit_gap"]
    assert (gap.low, gap.high) == (rho[rho < 6].max(), rho[rho > 9].min())


def test_a_fit_without_a_region_has_a_reason():
    assert fitted(own.fit())["fit_region_range"].status == "one_force"
    nothing = own.fit(2)
    nothing["region"] *= np.nan
    assert fitted(nothing)["fit_region_range"].status == "no_agreement"
    nothing["work_by_range_interval"] *= np.nan
    assert fitted(nothing)["fit_region_range"].status == "no_interval"
