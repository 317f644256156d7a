"""The octaves of a prediction are derivatives, on a scan and in closed form."""

from dataclasses import replace

import numpy as np
import pytest
import scan_files
from known_spectra import self_affine_spectrum
from measurements import PIXEL, random_map

import hardcontact as hc
from hardcontact.base.arrays import generator
from hardcontact.commands.predict import predict, predict_arguments
from hardcontact.contact.contact import Contact
from hardcontact.inference.octaves import AMPLITUDE_FACTORS, STEP
from hardcontact.own.own_spectrum import OwnSpectrum, read_own_spectrum
from hardcontact.own.predicted_octaves import (
    derivatives_in_closed_form,
    derivatives_on_scan,
    predicted_octaves,
)
from hardcontact.own.scan_contact import window_on_scans
from hardcontact.surfaces.spectrum import Spectrum
from hardcontact.theory.closed_form import closed_form

#: The paper's contact.
CONTACT = Contact(
    radius=250e3, preload=10e-6, hardness=25e9, rho=5.6, work=0.0463, contacts_per_row=20
)
#: The shortest wavelengths (nm) of octaves.
OCTAVES = 80.0 * 2.0 ** np.arange(4)
#: A map of 2560 nm with waves in these octaves alone.
PIXELS, PIXEL_SIZE = 128, 20.0


def band_limited_map():
    """A map of 4 nm rms height that its mirror images continue without waves beyond OCTAVES."""
    order = np.arange(PIXELS)
    cosines = np.cos(np.pi * order[:, None] * (np.arange(PIXELS) + 0.5) / PIXELS)
    inverse_wavelength = np.hypot(order[:, None], order) / (2 * PIXELS * PIXEL_SIZE)
    is_inside = (inverse_wavelength <= 1 / OCTAVES[0]) & (inverse_wavelength > 0.5 / OCTAVES[-1])
    amplitude = np.where(is_inside, inverse_wavelength, np.inf) ** -1.8
    heights = cosines.T @ (generator(5).normal(size=amplitude.shape) * amplitude) @ cosines
    return hc.HeightMap(4.0 * heights / heights.std(), PIXEL_SIZE)


def log_force_sum(heights, window):
    """The logarithm of the mean plastic force on a map, from the library's force sum."""
    forces = hc.pull_off_forces(
        hc.HeightMap(heights, PIXEL_SIZE), radius=CONTACT.radius, preload=CONTACT.preload,
        hardness=CONTACT.hardness, rho=[CONTACT.rho], work=CONTACT.work, window=window,
        contacts_per_row=CONTACT.contacts_per_row,
    )  # fmt: skip
    return np.log(forces.pull_off_force.sel(contact_model="plastic").mean().item())


def test_octaves_on_a_scan_add_up_to_the_derivative_for_all_roughness():
    scan = band_limited_map()
    window, _ = window_on_scans(4.0, PIXEL_SIZE, scan.size, CONTACT.radius, CONTACT.rho)
    weak, strong = (log_force_sum(factor * scan.heights, window) for factor in AMPLITUDE_FACTORS)
    total = derivatives_on_scan(scan, OCTAVES, CONTACT).sum()
    assert total == pytest.approx((strong - weak) / (2 * STEP), rel=2e-3)
    assert abs(total) > 0.3


def test_octaves_in_closed_form_add_up_to_the_derivative_for_all_roughness():
    spectrum = self_affine_spectrum(17, 1000, 0.8, 20)
    longest = spectrum.wavelength[0]
    octaves = 10 * 2.0 ** np.arange(np.ceil(np.log2(longest / 10)) + 1)
    weak, strong = (
        closed_form(Spectrum(spectrum.wavevector, factor**2 * spectrum.density), CONTACT).force
        for factor in AMPLITUDE_FACTORS
    )
    total = derivatives_in_closed_form(spectrum, octaves, CONTACT).sum()
    assert total == pytest.approx(np.log(strong / weak) / (2 * STEP), rel=2e-3)


@pytest.mark.parametrize("method", ["scan", "closed form"])
def test_central_differences_converge(method, monkeypatch):
    def derivative(step):
        for module in ("inference.octaves", "own.predicted_octaves"):
            monkeypatch.setattr(f"hardcontact.{module}.AMPLITUDE_FACTORS", (1 - step, 1 + step))
            monkeypatch.setattr(f"hardcontact.{module}.STEP", step)
        # With 20 contacts, a single pixel cancels the error of one of the steps.
        contact = replace(CONTACT, contacts_per_row=12)
        if method == "scan":
            return derivatives_on_scan(band_limited_map(), OCTAVES[2:], contact).sum()
        return derivatives_in_closed_form(
            self_affine_spectrum(17, 1000, 0.8, 20), OCTAVES, CONTACT
        ).sum()

    limit = derivative(0.002)
    errors = [abs(derivative(step) - limit) for step in (4 * STEP, 2 * STEP, STEP)]
    assert errors[0] > errors[1] > errors[2]
    assert errors[2] < 0.05 * abs(limit)


def test_a_map_has_octaves_of_its_force_sum_and_a_table_those_of_the_closed_form(
    tmp_path, quick_predictions
):
    heights = random_map(generator(3), 128, PIXEL).heights
    path = scan_files.write_scan(tmp_path / "scan.nc", heights.T, (128 * PIXEL, 128 * PIXEL))
    words = predict(predict_arguments([str(path)]))
    (line,) = [line for line in words.splitlines() if line.startswith("octaves that matter most")]
    own_spectrum = read_own_spectrum([path])
    longest, shortest = 2 * np.pi / own_spectrum.spectrum.wavevector[[0, -1]]
    contact = replace(CONTACT, contacts_per_row=8)
    numbers = list(predicted_octaves(own_spectrum, contact))
    octaves, derivatives = numbers[::2], [number.value for number in numbers[1::2]]
    assert sorted(derivatives, key=abs, reverse=True) == derivatives
    assert all(shortest < np.sqrt(2) * octave.value < longest for octave in octaves)
    assert {number.status for number in numbers} == {"on_scan"}
    assert f"{derivatives[0]:+.2g} %" in line and "(sum over the scan)" in line
    first_octave = np.array([octaves[0].value])
    (scan,) = own_spectrum.scans
    assert derivatives_on_scan(scan, first_octave, contact)[0] == pytest.approx(
        derivatives[0], rel=1e-3
    )
    table = OwnSpectrum(self_affine_spectrum(17, 1000, 0.8, 20), ())
    table_octaves = list(predicted_octaves(table, CONTACT))
    assert len(table_octaves) == 6 and {number.status for number in table_octaves} == {
        "closed_form"
    }
