"""Each caution is given exactly where it applies."""

import numpy as np
import pytest
from answer_inputs import (
    SURFACES,
    datasets,
    edges,
    fit,
    force,
    scale_extrapolated_force,
    setting,
    spectra,
)  # fmt: skip

from hardcontact.contact.finite_scan import SMALLEST_TESTED
from hardcontact.report.own_surfaces.answer import surface_answers
from hardcontact.report.own_surfaces.artificial_roughness import measurement_name


def all_cautions(**others):
    """The cautions about the first surface."""
    return surface_answers(datasets(**others), setting())[0].cautions


def find_cautions(code, **others):
    """The cautions with a code."""
    return [caution for caution in all_cautions(**others) if caution.code == code]


def grave_codes(**others):
    return [caution.code for caution in all_cautions(**others) if caution.grave]


def test_finite_scans_have_their_numbers():
    small = force().assign(
        finite_scan_ratio=(("surface", "bound"), [[2.0, 4.0]]), search_size=("surface", [2560.0])
    )
    (caution,) = find_cautions("small_scan", force=small)
    assert caution.numbers["share"].value == 0.25 and "tried" not in caution.numbers
    assert (caution.numbers["ratio"].low, caution.numbers["ratio"].high) == (2.0, 4.0)
    tiny = small.assign(search_size=("surface", [64e3]))
    assert find_cautions("small_scan", force=tiny)[0].numbers["tried"].value == SMALLEST_TESTED
    assert not find_cautions("small_scan")


def test_a_window_that_cuts_off_the_force_is_named():
    small = force().assign(window_share=("rho", [1, 1, 0.36, 0.2, 0.1]))
    (caution,) = find_cautions("window", force=small)
    assert np.isnan(caution.numbers["from"].value)
    assert (caution.numbers["share"].value, caution.numbers["at"].value) == (0.36, 5.6)
    long = force().assign(window_share=("rho", [1, 1, 0.995, 0.95, 0.9]))
    (long_caution,) = find_cautions("window", force=long)
    values = [long_caution.numbers[name].value for name in ("from", "at", "share")]
    assert values == [10.0, 14.0, 0.9]
    assert long_caution.numbers["window"].value == 12.5e3 and not find_cautions("window")


@pytest.mark.parametrize(("area", "grave"), [(20.0, True), (250.0, False)])
def test_pixels_that_are_too_large_for_the_contact_are_named(area, grave):
    (caution,) = find_cautions("few_pixels", force=force().assign_attrs(contact_area=area))
    assert (caution.numbers["pixels"].value, caution.grave) == (area / 100, grave)
    assert not find_cautions("few_pixels", force=force().assign_attrs(contact_area=1000.0))


def test_measurements_that_contradict_each_other_are_named():
    data = spectra()
    data["psd"][0, 2] *= 100  # of the line scan, which shares wavelengths with coarse.spm alone
    (caution,) = find_cautions("contradiction", spectra=data)
    assert caution.texts == {"higher": "scans/line.txt", "lower": "scans/coarse.spm"}
    assert (
        caution.numbers["factor"].value == pytest.approx(100, rel=0.2)
        and caution.numbers["others"].value == 0
    )
    assert 790 < caution.numbers["band"].low < caution.numbers["band"].high < 5100
    assert not find_cautions("contradiction")


def test_cautions_that_change_the_force_are_grave():
    mild = force().assign(window_share=("rho", [1, 1, 0.95, 0.8, 0.7]))
    assert grave_codes() == grave_codes(force=mild) == []
    small = mild.assign(finite_scan_ratio=(("surface", "bound"), [[2.0, 4.0]]))
    assert grave_codes(force=small) == ["small_scan"]
    small_share = ("rho", [0.5] * 5)
    assert grave_codes(force=mild.assign(window_share=small_share)) == ["window"]
    codes = ["small_scan", "window"]
    assert grave_codes(force=small.assign(window_share=small_share)) == codes
    assert grave_codes(force=force().assign_attrs(contact_area=20.0)) == ["few_pixels"]


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
    assert caution.numbers["correlation"].value == 0.2 and caution.numbers["scans"].value == 3


def test_contacts_that_touch_few_patches_are_named():
    counts = {"contacts": ("surface", [64]), "touched_patches": ("surface", [3.0])}
    few_patches = force().assign(counts | {"interval_source": ("surface", ["few_patches"])})
    few_patches["interval_is_conditional"][:] = 1
    (caution,) = find_cautions("few_patches", force=few_patches)
    counts = [number.value for number in caution.numbers.values()]
    assert (counts, caution.grave) == ([64, 3], True)
    assert not find_cautions("few_patches") and not find_cautions(
        "conditional_intervals", force=few_patches
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
    assert (
        tail.numbers["hurst"].value == pytest.approx(0.8) and tail.numbers["ends_at"].value < 0.33
    )
    (long,) = find_cautions("long_waves")
    assert (long.numbers["above"].value, long.numbers["rolloff"].value) == (25e3, 37.5e3)


def test_the_hurst_exponent_has_an_interval_of_the_study_s_confidence():
    sure = edges().assign_attrs(confidence=0.6827)  # of one standard error, here 0.1
    (tail,) = find_cautions("tail", edges=sure)
    assert (tail.numbers["hurst"].low, tail.numbers["hurst"].high) == pytest.approx(
        (0.7, 0.9), abs=1e-4
    )


def test_a_spectrum_above_the_scans_is_named():
    data = spectra()
    wavelength = 2 * np.pi / data["bin_wavevector"]
    added = data["spectrum"].interp(wavevector=data["bin_wavevector"])
    smooth = data["psd"].where(wavelength >= data["shortest_measured"], added / 10)
    (caution,) = find_cautions("more_than_measured", spectra=data.assign(psd=smooth))
    assert caution.numbers["factor"].value == pytest.approx(10)
    # Between two pixels and the shortest reliable wavelength.
    assert 20 <= caution.numbers["band"].low < caution.numbers["band"].high < 55
    assert not find_cautions("more_than_measured")


def test_a_tail_of_unknown_exponent_gives_no_force():
    data = spectra().assign(tail_known=("surface", [0]))
    (surface,) = surface_answers(
        datasets(spectra=data, force=scale_extrapolated_force(force(), short=0.5)), setting()
    )
    (tail,) = [caution for caution in surface.cautions if caution.code == "tail"]
    assert tail.numbers["known"].value == 0
    answer = surface.numbers["force_extrapolated_short"]
    assert np.isnan(answer.value) and answer.status == "no_exponent"


def test_a_force_at_the_smooth_bound_is_named():
    assert not find_cautions("smooth_bound")
    smooth = force()
    smooth["smooth_bound"] = smooth["force"].isel(surface=0)
    assert find_cautions("smooth_bound", force=smooth)


@pytest.mark.parametrize(("high", "count"), [(700.0, 0), (900.0, 1)])
def test_a_lopsided_interval_of_few_tests_is_named(high, count):
    data = fit()
    data["measured_force_interval"].loc[{"bound": "high"}] = 1e-9 * high
    assert len(find_cautions("few_tests", fit=data)) == count


def test_cautions_of_the_reader_are_named():
    assert not find_cautions("reading")
    data = spectra()
    data["notes"] = data["notes"].astype(object)
    data["notes"][{"surface": 0, "measurement": 0}] = "cropped; take care: its mask marks 9 pixels"
    (caution,) = find_cautions("reading", spectra=data)
    assert caution.texts["sentence"].endswith(": its mask marks 9 pixels")


def test_scans_of_the_same_area_are_named():
    assert not find_cautions("repeated_scan")
    data = spectra()
    data["earlier_scan"] = data["earlier_scan"].astype(object)
    data["earlier_scan"][{"surface": 0, "measurement": 1}] = "scans/trace.spm"
    (caution,) = find_cautions("repeated_scan", spectra=data)
    assert caution.texts["first"] == "scans/trace.spm"


def test_repeated_tests_are_asked_about():
    data = fit()
    assert not find_cautions("repeated_tests", fit=data)
    data["look_repeated"] = data["look_repeated"] + 1
    assert find_cautions("repeated_tests", fit=data)


@pytest.mark.parametrize(("work", "count"), [(10.0, 0), (50.8, 1)])
def test_a_work_beyond_that_of_solids_is_named(work, count):
    data = fit()
    data["work_by_range"] = data["work_by_range"] * 0 + work
    assert len(find_cautions("strong_work", fit=data)) == count


def test_defects_are_named_with_their_measurement():
    clipped = spectra()
    clipped["highest_share"].loc[{"measurement": [1, 3]}] = [[0.04, 0.06]]
    defects = find_cautions("highest", spectra=clipped)
    shares = {defect.measurement: defect.numbers["highest_share"].value for defect in defects}
    assert shares == {1: 0.04, 3: 0.06} and all(defect.grave for defect in defects)
