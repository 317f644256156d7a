"""What makes an answer less sure: each caution stands where it holds, and only there."""

import numpy as np
import pytest
from answer_inputs import (
    SURFACES,
    continued,
    datasets,
    edges,
    force,
    spectra,
)  # fmt: skip

from hardcontact.contact.finite_scan import SMALLEST_TESTED
from hardcontact.report.artificial import measurement_name
from hardcontact.report.cautions import cautions
from hardcontact.report.surface_facts import answer_rows


def of_first(**others):
    return datasets(**others).select_surface(SURFACES[0])


def named(code, **others):
    """The cautions of a code."""
    return [one for one in cautions(of_first(**others)) if one["code"] == code]


def grave(**others):
    return [one["code"] for one in cautions(of_first(**others)) if one["grave"]]


def test_finite_scans_have_their_numbers():
    small = force().assign(
        finite_scan_ratio=(("surface", "bound"), [[2.0, 4.0]]), draw_size=("surface", [2560.0])
    )
    (found,) = named("small_scan", force=small)
    assert found["share"].value == 0.25 and np.isnan(found["tried"].value)
    assert (found["ratio"].low, found["ratio"].high) == (2.0, 4.0)
    tiny = small.assign(draw_size=("surface", [64e3]))
    assert named("small_scan", force=tiny)[0]["tried"].value == SMALLEST_TESTED
    assert not named("small_scan")


def test_a_window_that_cuts_off_the_force_is_named():
    (here,) = named("window", force=force().assign(window_share=("rho", [1, 1, 0.36, 0.2, 0.1])))
    assert np.isnan(here["from"].value) and here["share"].value == 0.36 and here["at"].value == 5.6
    long = force().assign(window_share=("rho", [1, 1, 0.995, 0.95, 0.9]))
    (beyond,) = named("window", force=long)
    assert (beyond["from"].value, beyond["at"].value, beyond["share"].value) == (10.0, 14.0, 0.9)
    assert beyond["window"].value == 12.5e3 and not named("window")


@pytest.mark.parametrize(
    ("area", "code"), [(20.0, "one_pixel"), (250.0, "few_pixels"), (1000.0, None)]
)
def test_pixels_larger_than_the_contact_are_named(area, code):
    data = force().assign_attrs(contact_area=area)
    found = [*named("one_pixel", force=data), *named("few_pixels", force=data)]
    assert [one["code"] for one in found] == ([code] if code else [])
    assert all(one["pixels"].value == area / 100 for one in found)


def test_measurements_that_contradict_each_other_are_named():
    data = spectra()
    data["psd"][0, 2] *= 100  # of the line scan, which shares wavelengths with coarse.spm alone
    (found,) = named("contradiction", spectra=data)
    assert [name.split("/")[-1] for name in found["measurements"]] == ["line.txt", "coarse.spm"]
    assert found["factor"].value == pytest.approx(100, rel=0.2) and found["others"] == 0
    assert 790 < found["band"].low < found["band"].high < 5100
    assert not named("contradiction")


def test_cautions_that_change_the_force_are_grave():
    mild = force().assign(window_share=("rho", [1, 1, 0.95, 0.8, 0.7]))
    assert grave() == grave(force=mild) == []
    small = mild.assign(finite_scan_ratio=(("surface", "bound"), [[2.0, 4.0]]))
    assert grave(force=small) == ["small_scan"]
    cut = ("rho", [0.5] * 5)
    assert grave(force=mild.assign(window_share=cut)) == ["window"]
    both = ["window", "small_scan", "window_and_small_scan"]
    assert grave(force=small.assign(window_share=cut)) == both
    assert grave(force=force().assign_attrs(contact_area=20.0)) == ["one_pixel"]


def test_contacts_on_unreliable_scans_are_named():
    blind = spectra()
    blind["reliable"].loc[{"measurement": 1}] = 0  # of the first, whose pixels contacts have
    assert "blind_scans" in grave(spectra=blind) and named("blind_scans", spectra=blind)
    assert not named("blind_scans")


def test_intervals_of_few_scans_are_conditional():
    assert not named("conditional")
    quarters = force().assign(conditional=("surface", [1]), correlation_of_parts=("surface", [0.2]))
    (found,) = named("conditional", force=quarters)
    assert found["correlation"].value == 0.2 and found["scans"] == 3


def test_contacts_that_touch_few_places_are_named():
    counts = {"contacts": ("surface", [64]), "touched_places": ("surface", [3.0])}
    few = force().assign(counts | {"interval_source": ("surface", ["few_places"])})
    few["conditional"][:] = 1
    (found,) = named("few_places", force=few)
    assert (found["contacts"], found["touched_places"], found["grave"]) == (64, 3, True)
    assert not named("few_places") and not named("conditional", force=few)


def test_a_measurement_of_a_container_has_both_names():
    data = spectra().sel(surface=SURFACES[0]).isel(measurement=0)
    assert measurement_name(data) == "scans/fine.spm"
    assert measurement_name(data.assign(dataset=((), "map-1"))) == "scans/fine.spm: map-1"


def test_roughness_beyond_the_scans_is_named():
    cut = spectra()
    cut["spectrum"][:, np.flatnonzero(cut["spectrum"].values[0])[-1]] *= 0.01  # as where tails end
    (tail,) = named("tail", spectra=cut)
    assert tail["hurst"].value == pytest.approx(0.8) and tail["ends_at"].value < 0.33
    (long,) = named("long_waves")
    assert (long["above"].value, long["rolloff"].value) == (25e3, 37.5e3)


def test_the_hurst_exponent_has_an_interval_of_the_study_s_confidence():
    sure = edges().assign_attrs(confidence=0.6827)  # of one standard error, here 0.1
    (tail,) = named("tail", edges=sure)
    assert (tail["hurst"].low, tail["hurst"].high) == pytest.approx((0.7, 0.9), abs=1e-4)


def test_a_spectrum_above_the_scans_is_named():
    data = spectra()
    wavelength = 2 * np.pi / data["bin_wavevector"]
    added = data["spectrum"].interp(wavevector=data["bin_wavevector"])
    smooth = data["psd"].where(wavelength >= data["shortest_measured"], added / 10)
    (found,) = named("more_than_measured", spectra=data.assign(psd=smooth))
    assert found["factor"].value == pytest.approx(10)
    assert 20 <= found["band"].low < found["band"].high < 55  # two pixels; the shortest reliable
    assert not named("more_than_measured")


def test_a_tail_of_unknown_exponent_gives_no_force():
    data = spectra().assign(tail_known=("surface", [0]))
    of = of_first(spectra=data, force=continued(force(), small=0.5))
    assert [one["known"] for one in cautions(of) if one["code"] == "tail"] == [False]
    (answer,) = [row.fact for row in answer_rows(of) if row.fact.name == "force_extrapolated"]
    assert np.isnan(answer.value) and answer.status == "no_exponent"
