"""Intervals of spectrum, force and edges contain the values of known surfaces."""

from itertools import product

import numpy as np
import pytest
from known_spectra import contact_of_area
from measurements import measurement, random_line, random_map
from scipy import stats

from hardcontact.base.arrays import generator
from hardcontact.scans.joined_spectrum import joined_spectrum, sample_spectra
from hardcontact.scans.measured_spectrum import CALIBRATION_SCATTER
from hardcontact.scans.tail import MAX_GRADIENT, MAX_HALF_LAPLACIAN
from hardcontact.surfaces.spectrum import (
    WAVEVECTORS,
    Spectrum,
    all_scales_rms,
    spectrum_of_dataset,
    varying_hurst,
)
from hardcontact.theory import closed_form as closed
from hardcontact.theory.closed_form import closed_form, filtered_spectrum

pytestmark = pytest.mark.study

CONTACT = contact_of_area(100e3, 5.6, 0.05, 400.0)
TRIALS, DRAWS = 12, 8
#: Wavelengths in nm that no scan shows: above, in the gap between map and line, below.
HELD_BACK = 2 * np.pi / np.array([15_000.0, 110.0, 8.0])
KNOWN_TIPS = [1e-3, 1e-3]


def truth(rng):
    """Return a random spectrum, bent or straight, with an rms height of 2 to 15 nm."""
    while True:
        hurst, change = rng.uniform(0.5, 0.95), rng.uniform(-0.1, 0.1)
        rolloff, height = np.exp(rng.uniform(np.log([300, 2]), np.log([5000, 15])))
        values = varying_hurst(WAVEVECTORS, 1.0, rolloff, hurst, change)
        values[2 * np.pi / WAVEVECTORS < 0.3] = 0
        values *= (height / all_scales_rms(Spectrum(WAVEVECTORS, values))[0]) ** 2
        spectrum = Spectrum(WAVEVECTORS, values)
        _, gradient, half_laplacian = all_scales_rms(spectrum)
        if gradient < MAX_GRADIENT and half_laplacian < MAX_HALF_LAPLACIAN:
            return spectrum


def measure_scans(rng, spectrum, has_line):
    """Return a map of 10 µm and perhaps a line of 228 nm, calibrated to ten per cent."""
    scans = [random_map(rng, 256, 40.0, spectrum)]
    if has_line:
        scans.append(random_line(rng, 76, 3.0, spectrum))
    factors = np.exp(CALIBRATION_SCATTER / 2 * rng.standard_normal(len(scans)))
    return [
        measurement(scan.heights * factor, scan.pixel_size)
        for scan, factor in zip(scans, factors, strict=True)
    ]


def logarithms(spectrum, edges):
    """Return ln C at held-out wavelengths, ln F, and the change of ln F at both true edges."""
    force = closed_form(spectrum, CONTACT).force
    changes = [
        closed_form(filtered_spectrum(spectrum, side, edge), CONTACT).force / force
        if np.isfinite(edge)
        else np.nan
        for side, edge in zip(("short", "long"), edges, strict=True)
    ]
    return np.log([*np.maximum(spectrum(HELD_BACK), 1e-99), force, *changes])


def test_intervals_contain_spectrum_force_and_edges_of_known_surfaces(monkeypatch):
    monkeypatch.setattr(closed, "CUTOFF_COUNT", 24)
    contained, forces, force_half_widths = [], [], []
    for number, has_line in product(range(TRIALS // 2), (0, 1)):
        rng = generator(31, number, has_line)
        spectrum = truth(rng)
        scans = measure_scans(rng, spectrum, has_line)
        radii = KNOWN_TIPS[: len(scans)]
        edges = closed.critical_band(spectrum, CONTACT, 0.1)
        measured_forces = logarithms(spectrum_of_dataset(joined_spectrum(scans, radii)), edges)
        rngs = (generator(32, number, has_line, draw) for draw in range(DRAWS))
        shifts = [
            logarithms(sampled_spectrum, edges) - measured_forces
            for sampled_spectrum, _ in sample_spectra(rngs, scans, radii)
        ]
        # As for the user's surfaces; the interval of an edge holds it if that of F_c/F there does.
        half_width = stats.t.ppf(0.975, DRAWS) * np.sqrt(np.mean(np.square(shifts), axis=0))
        true = logarithms(spectrum, edges)
        contained.append(
            np.where(np.isfinite(true), np.abs(measured_forces - true) <= half_width, np.nan)
        )
        forces.append(true[3])
        force_half_widths.append(half_width[3])
    count, contained_count = np.isfinite(contained).sum(axis=0), np.nansum(contained, axis=0)
    assert count.min() > TRIALS / 2
    assert (contained_count >= stats.binom.ppf(0.01, count, 0.93)).all(), (contained_count, count)
    assert np.median(force_half_widths) < np.std(forces)
