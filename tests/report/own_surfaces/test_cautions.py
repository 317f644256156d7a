"""Each caution is given exactly where it applies."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from answer_inputs import SURFACES, datasets, edges, fit, force, scaled_extrapolated_force, setting
from answer_inputs import spectra as plain_spectra
from measurements import random_map

from hardcontact.base.arrays import generator
from hardcontact.base.dataset import read_dataset, write_dataset
from hardcontact.contact.numerical_limits import SMALLEST_SIZE_RATIO
from hardcontact.report.own_surfaces.answer import own_answer, surface_answers
from hardcontact.report.own_surfaces.datasets import measurement_name
from hardcontact.scans.joined_spectrum import joined_spectrum
from hardcontact.surfaces.height_map import load_height_map


def all_cautions(**others):
    """The cautions about the first surface."""
    return surface_answers(datasets(**others), setting())[0].cautions


@cache
def codes_on_a_large_contact():
    """The codes of the cautions on contacts of ten pixels, which leave all other data unchanged."""
    return {caution.code for caution in all_cautions(**forces(1000.0))}


def find_cautions(code, **others):
    """The cautions with a code."""
    return [caution for caution in all_cautions(**others) if caution.code == code]


def spectra(name, measurement, value):
    """Spectra of which one measurement has another value, or one so many times as large."""
    data = plain_spectra()
    data[name] = data[name].astype(object if isinstance(value, str) else float)
    scaled = data[name][0, measurement] * value if name == "psd" else value
    data[name][0, measurement] = scaled
    return {"spectra": data}


def forces(area=None, **variables):
    """Forces with other variables or another area of contact (nm²)."""
    data = force().assign(variables)
    return {"force": data if area is None else data.assign_attrs(contact_area=area)}


def added_spectrum():
    """Spectra of which a tenth is measured below the shortest reliable wavelength."""
    data = plain_spectra()
    wavelength = 2 * np.pi / data["bin_wavevector"]
    added = data["spectrum"].interp(wavevector=data["bin_wavevector"])
    smooth = data["psd"].where(wavelength >= data["shortest_measured"], added / 10)
    return {"spectra": data.assign(psd=smooth)}


RATIO = {"finite_scan_ratio": (("surface", "end"), [[2.0, 4.0]])}
FEW_PATCHES = {
    "contacts": ("surface", [64]), "touched_patches": ("surface", [3.0]),
    "interval_source": ("surface", ["few_patches"]),
}  # fmt: skip
QUARTERS = {
    "interval_source": ("surface", ["quarters"]), "correlation_of_parts": ("surface", [0.2]),
}  # fmt: skip
#: Code, changed datasets, whether the caution is grave, and its numbers or the ends of these.
CASES = [
    ("small_scan", forces(search_size=("surface", [2560.0]), **RATIO), True,
     {"share": 0.25, "ratio": (2.0, 4.0)}),
    ("small_scan", forces(search_size=("surface", [64e3]), **RATIO), True,
     {"smallest_share": SMALLEST_SIZE_RATIO}),
    ("window", forces(window_share=("rho", [1, 1, 0.36, 0.2, 0.1])), True,
     {"shortest_low_range": np.nan, "share": 0.36, "range": 5.6}),
    ("window", forces(window_share=("rho", [1, 1, 0.995, 0.95, 0.9])), False,
     {"shortest_low_range": 10.0, "range": 14.0, "share": 0.9, "window": 12.5e3}),
    ("few_pixels", forces(20.0), True, {"pixels": 0.2}),
    ("few_pixels", forces(250.0), False, {"pixels": 2.5}),
    # The line scan shares wavelengths with coarse.spm alone.
    ("contradiction", spectra("psd", 2, 100), False, {"factor": 100, "more_pairs": 0}),
    ("blind_scans", spectra("reliable", 0, 0), True, {}),
    ("conditional_intervals", forces(**QUARTERS), False, {"correlation": 0.2, "scans": 3}),
    ("few_patches", forces(**FEW_PATCHES), True, {}),
    ("more_than_measured", added_spectrum(), False, {"factor": 10}),
    ("smooth_bound", forces(smooth_bound=force()["force"].isel(surface=0)), False, {}),
    ("reading", spectra("notes", 0, "cropped\ntake care: its mask marks 9 pixels"), False, {}),
    ("repeated_scan", spectra("earlier_scan", 1, "scans/trace.spm"), True, {}),
    ("repeated_sites", {"fit": fit().assign(look_repeated=("surface", [1]))}, True, {}),
    ("highest", spectra("highest_share", 2, 0.06), True, {"highest_share": 0.06}),
]  # fmt: skip


@pytest.mark.parametrize(("code", "changed", "is_grave", "numbers"), CASES)
def test_a_caution_is_given_with_its_numbers_only_where_it_applies(
    code, changed, is_grave, numbers
):
    (caution,) = find_cautions(code, **changed)
    assert caution.grave == is_grave
    for name, value in numbers.items():
        number = caution.numbers[name]
        number_or_ends = (number.low, number.high) if isinstance(value, tuple) else number.value
        assert number_or_ends == pytest.approx(
            value, rel=0.2 if name == "factor" else 1e-6, nan_ok=True
        )
    assert code not in codes_on_a_large_contact()


def test_surfaces_without_faults_have_no_grave_caution():
    assert not [caution for caution in all_cautions() if caution.grave]
    assert not find_cautions("conditional_intervals", **forces(**FEW_PATCHES))


def test_a_caution_with_a_semicolon_stays_whole_from_the_scan_to_the_page(tmp_path):
    caution = "the file states a square; if its pixels are square, heights are stretched"
    notes = ("cropped", f"take care: {caution}")
    scan = replace(random_map(generator(21), 64, 10.0), notes=notes)
    write_dataset(scan.to_dataset(), tmp_path / "scan.nc")
    stored_scan = load_height_map(tmp_path / "scan.nc")
    assert stored_scan.notes == notes
    write_dataset(joined_spectrum([stored_scan], [None]), tmp_path / "spectrum.nc")
    stored_notes = read_dataset(tmp_path / "spectrum.nc")["notes"].item()
    answer = own_answer(datasets(**spectra("notes", 0, stored_notes)), setting())
    (text,) = [note["text"] for note in answer["notes"] if note["code"] == "reading"]
    assert caution in text
    measurement = answer["surfaces"][0]["measurements"][0]
    assert measurement["notes"] == f"cropped; take care: {caution}"


def test_a_measurement_of_a_container_has_both_names():
    data = plain_spectra().sel(surface=SURFACES[0]).isel(measurement=0)
    assert measurement_name(data) == "scans/fine.spm"
    assert measurement_name(data.assign(dataset=((), "map-1"))) == "scans/fine.spm: map-1"


def test_roughness_beyond_the_scans_is_named():
    shortened = plain_spectra()
    # As where tails end.
    shortened["spectrum"][:, np.flatnonzero(shortened["spectrum"].values[0])[-1]] *= 0.01
    sure = edges().assign_attrs(confidence=0.6827)  # of one standard error, here 0.1
    (tail,) = find_cautions("tail", spectra=shortened, edges=sure)
    hurst = tail.numbers["hurst"]
    assert (hurst.low, hurst.value, hurst.high) == pytest.approx((0.7, 0.8, 0.9), abs=1e-4)
    assert tail.numbers["spectrum_end"].value < 0.33
    (long,) = find_cautions("long_waves")
    assert (long.numbers["longest_measured"].value, long.numbers["rolloff"].value) == (25e3, 37.5e3)


def test_a_tail_of_unknown_exponent_gives_no_force():
    data = plain_spectra().assign(tail_known=("surface", [0]))
    changed = datasets(spectra=data, force=scaled_extrapolated_force(short=0.5))
    (surface,) = surface_answers(changed, setting())
    (tail,) = [caution for caution in surface.cautions if caution.code == "tail"]
    assert tail.numbers["exponent_known"].value == 0
    answer = surface.numbers["force_extrapolated_short"]
    assert np.isnan(answer.value) and answer.status == "no_exponent"


@pytest.mark.parametrize(("high", "count"), [(700.0, 0), (900.0, 1)])
def test_a_lopsided_interval_of_few_sites_is_named(high, count):
    data = fit()
    data["measured_force_interval"].loc[{"end": "high"}] = 1e-9 * high
    assert len(find_cautions("few_sites", fit=data)) == count


@pytest.mark.parametrize(("work", "count"), [(10.0, 0), (50.8, 1)])
def test_a_work_beyond_that_of_solids_is_named(work, count):
    data = fit()
    data["work_by_range"] = data["work_by_range"] * 0 + work
    assert len(find_cautions("strong_work", fit=data)) == count
