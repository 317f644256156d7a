"""The force on a map that `hardcontact predict` leads with, against the sum over its pixels."""

import json
from dataclasses import replace
from itertools import product

import numpy as np
import pytest
import scan_files
from direct_sum import direct_force, gap_to_sphere, mirror
from known_spectra import PAPER_CONTACT, self_affine_spectrum
from measurements import random_map
from prediction_command import predict_text
from refusals import assert_says, refusal

import hardcontact as hc
from hardcontact.base.arrays import generator
from hardcontact.contact.geometry import count_window_pixels
from hardcontact.own import scan_force
from hardcontact.own.own_spectrum import OwnSpectrum, add_sphere_roughness
from hardcontact.own.scan_contact import contact_on_scan
from hardcontact.own.scan_force import scan_force_numbers
from hardcontact.scans.joined_spectrum import joined_spectrum, reliable_spectrum
from hardcontact.surfaces.levelling import level_plane

PIXELS, PIXEL_SIZE = 128, 40.0
CONTACTS = 8
CONTACT = replace(PAPER_CONTACT, contacts_per_row=CONTACTS)


@pytest.fixture(autouse=True, scope="module")
def few_contacts_and_cutoffs():
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("hardcontact.commands.predict.CONTACTS_PER_ROW", CONTACTS)
        patch.setattr("hardcontact.theory.closed_form.CUTOFF_COUNT", 8)
        yield


def heights_of(kind):
    """Heights (y, x) of some 4 nm rms: Gaussian, flat with pits, or flat with peaks."""
    waves = random_map(
        generator(3), PIXELS, PIXEL_SIZE, self_affine_spectrum(rms=17, rolloff=500)
    ).heights
    waves = waves / waves.std()
    if kind == "gaussian":
        return 4 * waves
    excess = np.maximum(waves - 1, 0)
    return 4 * excess / excess.std() * (1 if kind == "peaks" else -1) + 0.3 * waves


def direct_forces(scan):
    """The plastic forces (N) of all contacts on a levelled map, pixel by pixel."""
    heights = mirror(scan.heights)
    pixels = count_window_pixels(contact_on_scan(scan, CONTACT).window, scan.pixel_size)
    positions = (np.arange(CONTACTS) + 0.25) * len(heights) / CONTACTS
    touching = int(np.ceil(CONTACT.area / scan.pixel_size**2))
    gaps = (
        gap_to_sphere(heights, position, pixels, scan.pixel_size, CONTACT.radius)
        for position in product(positions.astype(int), repeat=2)
    )
    return [direct_force(gap, touching, CONTACT.rho, scan.pixel_size, CONTACT.work) for gap in gaps]


def predict_map(tmp_path, heights, *options):
    """The report and the numbers of the command for a map."""
    path = tmp_path / "scan.nc"
    scan_files.write_scan(path, heights.T, (PIXELS * PIXEL_SIZE,) * 2)
    json_path = tmp_path / "numbers.json"
    report = predict_text(str(path), "--json", str(json_path), "--overwrite", *options)
    return report, json.loads(json_path.read_text())


@pytest.fixture(scope="module")
def predictions(tmp_path_factory):
    """The report and the numbers of the command for each kind of heights."""
    return {
        kind: predict_map(tmp_path_factory.mktemp(kind), heights_of(kind), "--verbose")
        for kind in ("gaussian", "pits", "peaks")
    }


@pytest.mark.parametrize("kind", ["gaussian", "pits", "peaks"])
def test_the_force_on_a_map_is_the_sum_over_its_pixels(kind, predictions):
    report, numbers = predictions[kind]
    forces = direct_forces(level_plane(hc.HeightMap(heights_of(kind), PIXEL_SIZE)))
    force = np.mean(forces)
    log_force_std = numbers["log_force_std"]["value"]
    assert log_force_std == pytest.approx(np.log(forces).std(), rel=1e-2)
    assert f"ln F of single contacts has a standard deviation of {log_force_std:.2g}" in report
    assert numbers["force_on_scan"]["value"] == pytest.approx(force, rel=1e-3)
    share = force / numbers["smooth_force"]["value"]
    assert numbers["force_on_scan_over_smooth"]["value"] == pytest.approx(share, rel=1e-3)
    if "interval" in numbers["force_on_scan"]:
        low, high = numbers["force_on_scan"]["interval"]
        assert low < force < high
    assert report.splitlines()[0].startswith("pull-off force, on the scan: ")


@pytest.mark.parametrize(("kind", "sign", "fault"), [("pits", -1, "low"), ("peaks", 1, "high")])
def test_the_closed_form_has_no_interval_on_heights_that_are_not_gaussian(
    kind, sign, fault, predictions
):
    report, numbers = predictions[kind]
    ratio = numbers["closed_form_on_scan"]["value"] / numbers["force_on_scan"]["value"]
    assert ratio**sign > 1.5
    assert numbers["closed_form_on_scan"]["status"] == "not_gaussian"
    names = {"closed_form_on_scan", *scan_force.CLOSED_FORM_NAMES} & numbers.keys()
    assert names and not any("interval" in numbers[name] for name in names)
    assert "found" not in {numbers[name]["status"] for name in names}
    (line,) = [line for line in report.splitlines() if line.startswith("closed form")]
    assert_says(line, "no number: the heights are not", f"times too {fault}")


def test_the_closed_form_of_a_gaussian_map_agrees_with_the_force_on_it(predictions):
    report, numbers = predictions["gaussian"]
    formula, force = numbers["closed_form_on_scan"], numbers["force_on_scan"]
    assert formula["status"] == "agrees"
    low, high = formula["interval"]
    assert low < formula["value"] < high
    assert low < force["interval"][1] and force["interval"][0] < high
    assert_says(report, "closed form, for the spectrum of this scan: ", "pixels 4 times finer")
    assert_says(report, "a check that assumes Gaussian heights", "quote the force on the scan")
    assert_says(report, "regime: many")


def test_a_smooth_wafer_has_the_force_of_a_rough_sphere(tmp_path, predictions):
    waves = heights_of("gaussian")
    _, smooth_numbers = predictions["gaussian"]
    position = (np.arange(PIXELS) - (PIXELS - 1) / 2) * PIXEL_SIZE
    sphere = waves - (position[:, None] ** 2 + position**2) / (2 * CONTACT.radius)
    path = tmp_path / "sphere.nc"
    scan_files.write_scan(path, sphere.T, (PIXELS * PIXEL_SIZE,) * 2)
    report, numbers = predict_map(tmp_path, waves.T / 200, "--sphere", str(path))
    assert "the position at which the rough sphere touches changes the force" in report
    low, high = numbers["force_on_scan"]["interval"]
    assert low < smooth_numbers["force_on_scan"]["value"] < high
    # The interval is that of one position of the sphere.
    assert high > numbers["position_factor"]["value"] * numbers["force_on_scan"]["value"] * 0.99
    assert numbers["rms_height"]["value"] == pytest.approx(
        smooth_numbers["rms_height"]["value"], rel=1e-4
    )


def test_no_sphere_is_added_to_a_table_of_a_spectrum():
    table = OwnSpectrum(self_affine_spectrum(rms=17), ())
    message = refusal(add_sphere_roughness, table, table, 1)
    assert_says(message, "--sphere: expected scans of both bodies")


def test_a_force_that_is_not_computed_has_a_reason():
    scan = hc.HeightMap(heights_of("gaussian"), PIXEL_SIZE)
    line = hc.HeightMap(scan.heights[0], PIXEL_SIZE)
    large = hc.HeightMap(np.tile(scan.heights, (20, 20)), PIXEL_SIZE)
    spectrum = reliable_spectrum(joined_spectrum([scan], [None]), 0.0)
    short_range = replace(CONTACT, rho=0.001)
    for scans, contact, status in (
        ([line], CONTACT, "no_map"),
        ([scan, scan], CONTACT, "several_scans"),
        ([large], CONTACT, "too_large"),
        ([scan], short_range, "short_range"),
    ):
        own_spectrum = OwnSpectrum(spectrum, (), tuple(scans))
        numbers = scan_force_numbers(own_spectrum, contact, 0.95)
        assert numbers["force_on_scan"].status == status
        assert np.isnan(numbers["force_on_scan"].value)
    assert scan_force_numbers(OwnSpectrum(spectrum, ()), CONTACT, 0.95) == {}
