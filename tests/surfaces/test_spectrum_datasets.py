"""Datasets of spectra: of descriptions, and of all surfaces."""

import numpy as np
import pandas as pd
from measurements import map_of, two_sizes_and_a_line

from hardcontact.base import dataset
from hardcontact.base.random import generator
from hardcontact.report.artificial import artificial_bands
from hardcontact.surfaces.extrapolated_spectrum import Tail
from hardcontact.surfaces.joined_spectrum import joined_spectrum
from hardcontact.surfaces.spectrum import WAVEVECTORS, self_affine, spectrum_dataset
from hardcontact.surfaces.spectrum_datasets import described_spectrum, stacked_spectra

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
    described = described_spectrum(stored(), "x.csv")
    assert described.notes.values.tolist() == ["a", "b"]
    np.testing.assert_allclose(described.longest_reliable, [1e6, 100.0])
    np.testing.assert_allclose(described.shortest_reliable, [1e3, 10.0])
    wavelength = 2 * np.pi / described.bin_wavevector.values
    in_known_band = (wavelength > 1e3) | ((wavelength > 10) & (wavelength <= 100))
    expected = self_affine(described.bin_wavevector.values, 1e9, 2000.0, 0.8)
    expected[~in_known_band] = np.nan
    np.testing.assert_allclose(described.joined, expected, rtol=0.03)
    assert np.isnan(described.attrs["tail_hurst"])
    assert set(described.limited_by.values) == {"source"}


def test_what_is_not_known_is_artificial():
    stacked = stacked_spectra({"x": described_spectrum(stored(), "x.csv")}, {"x": "X"})
    bands = artificial_bands(stacked.sel(surface="x"))
    np.testing.assert_allclose(bands, [(0, 10), (100, 1000), (1e6, np.inf)])


def test_surfaces_are_stacked_with_their_limits_and_empty_places(tmp_path):
    coat = joined_spectrum(two_sizes_and_a_line(19), [None] * 3)
    rough = joined_spectrum([map_of(generator(20), 128, 10.0)], [None])
    labels = {"rough": "Rough", "coat": "My coat"}
    dataset.write(stacked_spectra({"rough": rough, "coat": coat}, labels), tmp_path / "a.nc")
    stacked = dataset.read(tmp_path / "a.nc")
    assert list(stacked["kind"].values[0]) == ["map", "", ""]
    assert stacked["reliable"].values[0, 1:].sum() == 0
    assert np.isnan(stacked["psd"].values[0, 1:]).all()
    for name, single in (("rough", rough), ("coat", coat)):
        chosen = stacked.sel(surface=name)
        np.testing.assert_array_equal(chosen["spectrum"], single["spectrum"])
        np.testing.assert_array_equal(chosen["joined"], single["joined"])
        for limit in ("shortest_measured", "longest_measured", *Tail._fields):
            assert chosen[limit].item() == single.attrs[limit]
