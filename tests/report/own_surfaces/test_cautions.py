"""Each caution is given exactly where it applies."""

from dataclasses import replace
from functools import cache

import numpy as np
import own_datasets as own
import pytest
from measurements import random_map
from own_answers import setting

from hardcontact.base.arrays import generator
from hardcontact.base.dataset import read_dataset, write_dataset
from hardcontact.contact.hertz_jkr_dmt import STRONGEST_WORK
from hardcontact.contact.numerical_limits import SMALLEST_SIZE_RATIO
from hardcontact.report.own_surfaces.answer import own_answer, surface_answers
from hardcontact.scans.defects import DEFECTS
from hardcontact.scans.joined_spectrum import joined_spectrum
from hardcontact.surfaces.height_map import load_height_map


def all_cautions(**others):
    """The cautions about the first surface."""
    return surface_answers(own.datasets(**others), setting())[0].cautions


@cache
def codes_on_a_large_contact():
    """The codes of the cautions on unchanged data, but with contacts of ten pixels, not four."""
    return {caution.code for caution in all_cautions(**change_forces(1000.0))}


def find_cautions(code, **others):
    """The cautions with a code."""
    return [caution for caution in all_cautions(**others) if caution.code == code]


def change_spectra(name, measurement, value):
    """`spectra` for `datasets`: one measurement has another value, or its PSD times the value."""
    data = own.spectra()
    data[name] = data[name].astype(object if isinstance(value, str) else float)
    scaled = data[name][0, measurement] * value if name == "psd" else value
    data[name][0, measurement] = scaled
    return {"spectra": data}


def change_forces(area=None, **variables):
    """`force` for `datasets`: with another area of contact (nm²), or other variables."""
    data = own.force().assign(variables)
    return {"force": data if area is None else data.assign_attrs(contact_area=area)}


def with_streaks():
    """`spectra` for `datasets`: the first measurement has 25 streaks."""
    data = own.spectra()
    for name, value in zip(DEFECTS["streaks"], (25.0, 12.0, 253.0, 4.1), strict=True):
        data[name] = data[name].astype(float)
        data[name][0, 0] = value
    return {"spectra": data}


def smooth_scans():
    """`spectra` for `datasets`: scans show a tenth of the extrapolated power of short waves."""
    data = own.spectra()
    wavelength = 2 * np.pi / data["bin_wavevector"]
    extrapolated = data["spectrum"].interp(wavevector=data["bin_wavevector"])
    psd = data["psd"].where(wavelength >= data["shortest_measured"], extrapolated / 10)
    return {"spectra": data.assign(psd=psd)}


SMALL_SCAN = {"finite_scan_ratio": (("surface", "end"), [[2.0, 4.0]])}
FEW_PATCHES = {
    "contacts": ("surface", [64]), "touched_patches": ("surface", [3.0]),
    "interval_source": ("surface", ["few_patches"]),
}  # fmt: skip
QUARTERS = {
    "interval_source": ("surface", ["quarters"]), "correlation_of_parts": ("surface", [0.2]),
}  # fmt: skip
#: Code, changed datasets, whether the caution is grave, and its numbers or the ends of these.
CASES = [
    ("small_scan", change_forces(search_size=("surface", [2560.0]), **SMALL_SCAN), True,
     {"share": 0.25, "ratio": (2.0, 4.0)}),
    ("small_scan", change_forces(search_size=("surface", [64e3]), **SMALL_SCAN), True,
     {"smallest_share": SMALLEST_SIZE_RATIO}),
    ("window", change_forces(window_share=("rho", [1, 1, 0.36, 0.2, 0.1])), True,
     {"shortest_low_range": np.nan, "share": 0.36, "range": 5.6}),
    ("window", change_forces(window_share=("rho", [1, 1, 0.995, 0.95, 0.9])), False,
     {"shortest_low_range": 10.0, "range": 14.0, "share": 0.9, "window": 12.5e3}),
    ("few_pixels", change_forces(20.0), True, {"pixels": 0.2}),
    ("few_pixels", change_forces(250.0), False, {"pixels": 2.5}),
    # The line scan shares wavelengths with coarse.spm alone.
    ("contradiction", change_spectra("psd", 2, 100), False, {"factor": 100, "more_pairs": 0}),
    ("blind_scans", change_spectra("reliable", 0, 0), True, {}),
    ("conditional_intervals", change_forces(**QUARTERS), False, {"correlation": 0.2, "scans": 3}),
    ("few_patches", change_forces(**FEW_PATCHES), True, {}),
    ("more_than_measured", smooth_scans(), False, {"factor": 10}),
    ("smooth_bound", change_forces(smooth_bound=own.force()["force"][0]), False, {}),
    ("reading", change_spectra("notes", 0, "cropped\ntake care: a mask hides 9 pixels"), False, {}),
    ("repeated_scan", change_spectra("earlier_scan", 1, "scans/trace.spm"), True, {}),
    ("repeated_sites", {"fit": own.fit().assign(look_repeated=("surface", [1]))}, True, {}),
    ("highest", change_spectra("highest_share", 2, 0.06), True, {"highest_share": 0.06}),
    ("streaks", with_streaks(), True, {"streak_lines": 25.0}),
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
        # A factor compares spectra that scatter.
        relative_error = 0.2 if name == "factor" else 1e-6
        assert number_or_ends == pytest.approx(value, rel=relative_error, nan_ok=True)
    assert code not in codes_on_a_large_contact()


def test_surfaces_without_faults_have_no_grave_caution():
    assert not [caution for caution in all_cautions() if caution.grave]


def test_few_patches_give_no_caution_on_intervals_of_quarters():
    assert not find_cautions("conditional_intervals", **change_forces(**FEW_PATCHES))


def test_a_caution_with_a_semicolon_stays_whole_from_the_scan_to_the_page(tmp_path):
    caution = "the file states a square; if its pixels are square, heights are stretched"
    notes = ("cropped", f"take care: {caution}")
    scan = replace(random_map(generator(21), 64, 10.0), notes=notes)
    write_dataset(scan.to_dataset(), tmp_path / "scan.nc")
    stored_scan = load_height_map(tmp_path / "scan.nc")
    assert stored_scan.notes == notes
    write_dataset(joined_spectrum([stored_scan], [None]), tmp_path / "spectrum.nc")
    stored_notes = read_dataset(tmp_path / "spectrum.nc")["notes"].item()
    datasets = own.datasets(**change_spectra("notes", 0, stored_notes))
    answer = own_answer(datasets, setting())
    (text,) = [note["text"] for note in answer["notes"] if note["code"] == "reading"]
    assert caution in text
    measurement = answer["surfaces"][0]["measurements"][0]
    assert measurement["notes"] == f"cropped; take care: {caution}"


def test_roughness_beyond_the_scans_is_named():
    one_error = own.edges().assign_attrs(confidence=0.6827)  # of one standard error, here 0.1
    spectra = own.spectra()
    # The last wave of the spectrum counts however small its density is.
    spectra["spectrum"][:, np.flatnonzero(spectra["spectrum"].values[0])[-1]] *= 0.01
    (tail,) = find_cautions("tail", spectra=spectra, edges=one_error)
    hurst = tail.numbers["hurst"]
    assert (hurst.low, hurst.value, hurst.high) == pytest.approx((0.7, 0.8, 0.9), abs=1e-4)
    # The shortest wavelength of the grid above 0.3 nm, where the spectrum ends.
    assert tail.numbers["spectrum_end"].value == pytest.approx(0.316, abs=1e-3)
    (long,) = find_cautions("long_waves")
    assert (long.numbers["longest_measured"].value, long.numbers["rolloff"].value) == (25e3, 37.5e3)


def test_a_tail_of_unknown_exponent_gives_no_force():
    data = own.spectra().assign(tail_known=("surface", [0]))
    changed = own.datasets(spectra=data, force=own.scaled_extrapolated_force(short=0.5))
    (surface,) = surface_answers(changed, setting())
    (tail,) = [caution for caution in surface.cautions if caution.code == "tail"]
    assert tail.numbers["exponent_known"].value == 0
    extrapolated_force = surface.numbers["extrapolated_force_short"]
    assert np.isnan(extrapolated_force.value) and extrapolated_force.status == "no_exponent"


# Of 640 [576, high] nN: with MAX_LOPSIDEDNESS 2 the high end may be 640 (640/576)² = 790 nN.
@pytest.mark.parametrize(("high", "count"), [(700.0, 0), (900.0, 1)])
def test_a_lopsided_interval_of_few_sites_is_named(high, count):
    data = own.fit()
    data["measured_force_interval"].loc[{"end": "high"}] = 1e-9 * high
    assert len(find_cautions("few_sites", fit=data)) == count


@pytest.mark.parametrize(
    ("work", "count"), [(0.99 * STRONGEST_WORK, 0), (1.01 * STRONGEST_WORK, 1)]
)
def test_a_work_beyond_that_of_solids_is_named(work, count):
    data = own.fit()
    data["work_by_range"] = data["work_by_range"] * 0 + work
    assert len(find_cautions("strong_work", fit=data)) == count
