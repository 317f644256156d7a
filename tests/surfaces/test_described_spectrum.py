"""Spectra of substitutes beside measured ones: known bands, and what is not known of them."""

import numpy as np
import pandas as pd
from refusals import assert_says, refusal

from hardcontact.answer.artificial import artificial_bands
from hardcontact.surfaces.joined_spectrum import described_spectrum, stacked_spectra
from hardcontact.surfaces.spectrum import WAVEVECTORS, self_affine, spectrum_dataset

BANDS = pd.DataFrame(
    {
        "longest_nm": [np.inf, 1e4, 1e3, 100.0, 10.0],
        "shortest_nm": [1e4, 1e3, 100.0, 10.0, 0.1],
        "basis": ["published", "published", "assumed", "measured", "inferred"],
        "source": ["a", "a", "none", "b", "c"],
    }
)


def stored(bands=BANDS):
    """Return the spectrum of a substitute as the study stores it."""
    return spectrum_dataset(self_affine(WAVEVECTORS, 1e9, 2000.0, 0.8)).assign_attrs(
        basis="substitute", calibrated_to_table1="", bands=bands.to_csv(index=False)
    )


def test_known_bands_are_those_of_published_or_measured_sources():
    found = described_spectrum(stored(), "x.csv")
    assert found.notes.values.tolist() == ["a", "b"]
    np.testing.assert_allclose(found.longest_reliable, [1e6, 100.0])
    np.testing.assert_allclose(found.shortest_reliable, [1e3, 10.0])
    wavelength = 2 * np.pi / found.bin_wavevector.values
    known = (wavelength > 1e3) | ((wavelength > 10) & (wavelength <= 100))
    expected = self_affine(found.bin_wavevector.values, 1e9, 2000.0, 0.8)
    np.testing.assert_allclose(found.joined, np.where(known, expected, np.nan), rtol=0.03)
    assert np.isnan(found.attrs["tail_hurst"]) and set(found.limited_by.values) == {"source"}


def test_what_is_not_known_is_artificial():
    stacked = stacked_spectra({"x": described_spectrum(stored(), "x.csv")}, {"x": "X"})
    bands = artificial_bands(stacked.sel(surface="x"))
    np.testing.assert_allclose(bands, [(0, 10), (100, 1000), (1e6, np.inf)])


def test_a_description_without_known_bands_is_refused():
    assumed = BANDS.assign(basis="assumed")
    assert_says(refusal(described_spectrum, stored(assumed), "x.csv"), "x.csv", "published")
