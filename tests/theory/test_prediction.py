"""The table of designed surfaces, and which spectra it validates."""

from dataclasses import replace

import numpy as np
import pandas as pd
import pytest
import validate_prediction
from known_spectra import PAPER_CONTACT, contact_of_area, self_affine_spectrum

from hardcontact.base.arrays import generator
from hardcontact.surfaces.spectral_models import varying_hurst
from hardcontact.surfaces.spectrum import WAVEVECTORS, Spectrum, spectral_moment
from hardcontact.surfaces.synthesis import random_surface
from hardcontact.theory import prediction, validity
from hardcontact.theory.closed_form import closed_form

TABLE = pd.read_csv(validity.DESIGNED_SURFACES)


def test_the_spectrum_of_a_grid_has_the_rms_height_of_its_surfaces():
    spectrum = self_affine_spectrum(rolloff=500, shortest=10)
    heights = [random_surface(generator(2, k), 256, 10.0, spectrum).heights for k in range(8)]
    grid_spectrum = validate_prediction.spectrum_of_grid(spectrum, 2560.0, 256)
    rms_height = np.sqrt(np.mean(np.square(heights)))
    assert np.sqrt(spectral_moment(grid_spectrum, 0)) == pytest.approx(rms_height, rel=0.03)
    with pytest.raises(ValueError, match="expected waves between"):
        validate_prediction.spectrum_of_grid(spectrum, 1e-3, 4)


def test_the_table_repeats_the_design_and_the_closed_form():
    designed = pd.DataFrame(validate_prediction.design())
    pd.testing.assert_frame_equal(TABLE[designed.columns], designed, rtol=1e-4, check_dtype=False)
    for row in TABLE.to_dict("records")[::3]:
        spectrum = validate_prediction.spectrum_of(row)
        grid_spectrum = validate_prediction.spectrum_of_grid(spectrum, row["size"], row["pixels"])
        contact = contact_of_area(row["radius"], row["rho"], work=1.0, area=row["area"])
        form = closed_form(grid_spectrum, contact)
        assert form.force == pytest.approx(row["predicted_force"], rel=1e-3)
        assert form.regime == row["regime"]
        assert (form.rms_height, form.apex_height) == pytest.approx(
            (row["unfollowed_rms_height"], row["apex_height"]), rel=1e-3
        )


@pytest.mark.parametrize("name", validity.VALIDATED_QUANTITIES)
def test_intervals_contain_most_ratios_on_surfaces_that_were_not_held_out(name):
    """The probability is 0.9, less at the border of the table."""
    rows = TABLE[TABLE["held_out"] == 0].dropna(subset=f"predicted_{name}")
    if f"{name}_status" in rows:
        rows = rows[rows[f"{name}_status"] == "found"]
    is_inside = []
    for _, row in rows.iterrows():
        low, high = validity.nearest_ratios(row, name)
        is_inside.append(low <= row[name] / row[f"predicted_{name}"] <= high)
    assert np.mean(is_inside) > 0.75


#: Roll-off (nm), plateau (nm⁴), Hurst exponent at the roll-off and its change per decade, for the
#: default spectra of polished UNCD, UNCD, NCD and MCD (workflow/report/departures.md).
COATINGS = [
    (751, 1.075e6, 1.27, 0.0),
    (1103, 5.471e7, 0.76, 0.0),
    (2000, 1.032e10, 1.67, -0.504),
    (2000, 1.319e10, 1.83, -0.569),
]


def is_in_table(spectrum, contact):
    form = closed_form(spectrum, contact)
    return validity.is_validated(validity.table_point(spectrum, contact, form))


@pytest.mark.parametrize(("rolloff", "plateau", "hurst", "change"), COATINGS)
def test_the_coatings_of_the_paper_lie_within_the_table(rolloff, plateau, hurst, change):
    density = varying_hurst(WAVEVECTORS, plateau, rolloff, hurst, change)
    spectrum = prediction.trim_spectrum(Spectrum(WAVEVECTORS, density))
    contact_length = np.sqrt(PAPER_CONTACT.area)
    mean_hurst = hurst + change * np.log10(rolloff / contact_length) / 2
    fit = validity.mean_hurst_and_change(spectrum, contact_length)
    assert fit == pytest.approx((mean_hurst, change), abs=0.01)
    assert is_in_table(spectrum, PAPER_CONTACT)


def test_a_contact_wider_than_the_roll_off_leaves_no_hurst_exponent():
    spectrum = Spectrum(WAVEVECTORS, varying_hurst(WAVEVECTORS, 1e6, 300, 0.8, 0.0))
    assert np.isnan(validity.mean_hurst_and_change(spectrum, 400.0)).all()
    assert not is_in_table(spectrum, replace(PAPER_CONTACT, preload=400.0**2))  # area in nm²
