"""Each caution is given exactly where it applies."""

import numpy as np
import pytest
from answer_inputs import (
    SURFACES,
    datasets,
    edges,
    force,
    scale_extrapolated_force,
    spectra,
)  # fmt: skip

from hardcontact.contact.finite_scan import SMALLEST_TESTED
from hardcontact.report.artificial import measurement_name
from hardcontact.report.cautions import cautions
from hardcontact.report.surface_facts import answer_rows


def first_surface(**others):
    return datasets(**others).select_surface(SURFACES[0])


def find_cautions(code, **others):
    """The cautions with a code."""
    return [caution for caution in cautions(first_surface(**others)) if caution["code"] == code]


def grave_codes(**others):
    return [caution["code"] for caution in cautions(first_surface(**others)) if caution["grave"]]


def test_finite_scans_have_their_numbers():
    small = force().assign(
        finite_scan_ratio=(("surface", "bound"), [[2.0, 4.0]]), search_size=("surface", [2560.0])
    )
    (caution,) = find_cautions("small_scan", force=small)
    assert caution["share"].value == 0.25 and np.isnan(caution["tried"].value)
    assert (caution["ratio"].low, caution["ratio"].high) == (2.0, 4.0)
    tiny = small.assign(search_size=("surface", [64e3]))
    assert find_cautions("small_scan", force=tiny)[0]["tried"].value == SMALLEST_TESTED
    assert not find_cautions("small_scan")


def test_a_window_that_cuts_off_the_force_is_named():
    small = force().assign(window_share=("rho", [1, 1, 0.36, 0.2, 0.1]))
    (caution,) = find_cautions("window", force=small)
    assert np.isnan(caution["from"].value)
    assert (caution["share"].value, caution["at"].value) == (0.36, 5.6)
    long = force().assign(window_share=("rho", [1, 1, 0.995, 0.95, 0.9]))
    (long_caution,) = find_cautions("window", force=long)
    values = [long_caution[name].value for name in ("from", "at", "share")]
    assert values == [10.0, 14.0, 0.9]
    assert long_caution["window"].value == 12.5e3 and not find_cautions("window")


@pytest.mark.parametrize(
    ("area", "code"), [(20.0, "one_pixel"), (250.0, "few_pixels"), (1000.0, None)]
)
def test_pixels_larger_than_the_contact_are_named(area, code):
    data = force().assign_attrs(contact_area=area)
    pixel_cautions = [
        *find_cautions("one_pixel", force=data),
        *find_cautions("few_pixels", force=data),
    ]
    assert [caution["code"] for caution in pixel_cautions] == ([code] if code else [])
    assert all(caution["pixels"].value == area / 100 for caution in pixel_cautions)


def test_measurements_that_contradict_each_other_are_named():
    data = spectra()
    data["psd"][0, 2] *= 100  # of the line scan, which shares wavelengths with coarse.spm alone
    (caution,) = find_cautions("contradiction", spectra=data)
    assert [name.split("/")[-1] for name in caution["measurements"]] == ["line.txt", "coarse.spm"]
    assert caution["factor"].value == pytest.approx(100, rel=0.2) and caution["others"] == 0
    assert 790 < caution["band"].low < caution["band"].high < 5100
    assert not find_cautions("contradiction")


def test_cautions_that_change_the_force_are_grave():
    mild = force().assign(window_share=("rho", [1, 1, 0.95, 0.8, 0.7]))
    assert grave_codes() == grave_codes(force=mild) == []
    small = mild.assign(finite_scan_ratio=(("surface", "bound"), [[2.0, 4.0]]))
    assert grave_codes(force=small) == ["small_scan"]
    small_share = ("rho", [0.5] * 5)
    assert grave_codes(force=mild.assign(window_share=small_share)) == ["window"]
    codes = ["window", "small_scan", "window_and_small_scan"]
    assert grave_codes(force=small.assign(window_share=small_share)) == codes
    assert grave_codes(force=force().assign_attrs(contact_area=20.0)) == ["one_pixel"]


def test_contacts_on_unreliable_scans_are_named():
    blind = spectra()
    blind["reliable"].loc[{"measurement": 1}] = 0  # of the first, whose pixels contacts have
    assert "blind_scans" in grave_codes(spectra=blind) and find_cautions(
        "blind_scans", spectra=blind
    )
    assert not find_cautions("blind_scans")


def test_intervals_of_few_scans_are_conditional():
    assert not find_cautions("conditional_intervals")
    quarters = force().assign(
        interval_is_conditional=("surface", [1]), correlation_of_parts=("surface", [0.2])
    )
    (caution,) = find_cautions("conditional_intervals", force=quarters)
    assert caution["correlation"].value == 0.2 and caution["scans"] == 3


def test_contacts_that_touch_few_places_are_named():
    counts = {"contacts": ("surface", [64]), "touched_places": ("surface", [3.0])}
    few_places = force().assign(counts | {"interval_source": ("surface", ["few_places"])})
    few_places["interval_is_conditional"][:] = 1
    (caution,) = find_cautions("few_places", force=few_places)
    assert (caution["contacts"], caution["touched_places"], caution["grave"]) == (64, 3, True)
    assert not find_cautions("few_places") and not find_cautions(
        "conditional_intervals", force=few_places
    )


def test_a_measurement_of_a_container_has_both_names():
    data = spectra().sel(surface=SURFACES[0]).isel(measurement=0)
    assert measurement_name(data) == "scans/fine.spm"
    assert measurement_name(data.assign(dataset=((), "map-1"))) == "scans/fine.spm: map-1"


def test_roughness_beyond_the_scans_is_named():
    shortened = spectra()
    # As where tails end.
    shortened["spectrum"][:, np.flatnonzero(shortened["spectrum"].values[0])[-1]] *= 0.01
    (tail,) = find_cautions("tail", spectra=shortened)
    assert tail["hurst"].value == pytest.approx(0.8) and tail["ends_at"].value < 0.33
    (long,) = find_cautions("long_waves")
    assert (long["above"].value, long["rolloff"].value) == (25e3, 37.5e3)


def test_the_hurst_exponent_has_an_interval_of_the_study_s_confidence():
    sure = edges().assign_attrs(confidence=0.6827)  # of one standard error, here 0.1
    (tail,) = find_cautions("tail", edges=sure)
    assert (tail["hurst"].low, tail["hurst"].high) == pytest.approx((0.7, 0.9), abs=1e-4)


def test_a_spectrum_above_the_scans_is_named():
    data = spectra()
    wavelength = 2 * np.pi / data["bin_wavevector"]
    added = data["spectrum"].interp(wavevector=data["bin_wavevector"])
    smooth = data["psd"].where(wavelength >= data["shortest_measured"], added / 10)
    (caution,) = find_cautions("more_than_measured", spectra=data.assign(psd=smooth))
    assert caution["factor"].value == pytest.approx(10)
    # Between two pixels and the shortest reliable wavelength.
    assert 20 <= caution["band"].low < caution["band"].high < 55
    assert not find_cautions("more_than_measured")


def test_a_tail_of_unknown_exponent_gives_no_force():
    data = spectra().assign(tail_known=("surface", [0]))
    surface = first_surface(spectra=data, force=scale_extrapolated_force(force(), small=0.5))
    (tail,) = [caution for caution in cautions(surface) if caution["code"] == "tail"]
    assert tail["known"] is False
    (answer,) = [row.fact for row in answer_rows(surface) if row.fact.name == "force_extrapolated"]
    assert np.isnan(answer.value) and answer.status == "no_exponent"
