"""Datasets of described spectra, and of the spectra of several surfaces."""

import numpy as np
import pandas as pd
from measurements import random_map, two_sizes_and_a_line

from hardcontact.base.arrays import generator
from hardcontact.base.dataset import read_dataset, write_dataset
from hardcontact.scans.extrapolation import Tail
from hardcontact.scans.joined_spectrum import joined_spectrum
from hardcontact.scans.spectrum_datasets import convert_described_spectrum, stack_spectra
from hardcontact.surfaces.spectral_models import self_affine
from hardcontact.surfaces.spectrum import WAVEVECTORS, spectrum_dataset

SEGMENTS = pd.DataFrame(
    {
        "longest_nm": [np.inf, 1e4, 1e3, 100.0, 10.0],
        "shortest_nm": [1e4, 1e3, 100.0, 10.0, 0.1],
        "evidence": ["published", "published", "assumed", "measured", "inferred"],
        "source": ["a", "a", "none", "b", "c"],
    }
)


def described_spectrum():
    """Return the spectrum of SEGMENTS in the form of a joined spectrum."""
    substitute = spectrum_dataset(
        self_affine(WAVEVECTORS, plateau=1e9, rolloff=2000.0, hurst=0.8)
    ).assign_attrs(source="substitute", table1_rows_met="", segments=SEGMENTS.to_csv(index=False))
    return convert_described_spectrum(substitute, "x.csv")


def test_only_published_or_measured_segments_are_reliable():
    spectrum = described_spectrum()
    assert spectrum.notes.values.tolist() == ["a", "b"]
    np.testing.assert_allclose(spectrum.longest_reliable, [1e6, 100.0])  # WAVEVECTORS end at 1 mm
    np.testing.assert_allclose(spectrum.shortest_reliable, [1e3, 10.0])
    wavelength = 2 * np.pi / spectrum.bin_wavevector.values
    is_reliable = (wavelength > 1e3) | ((wavelength > 10) & (wavelength <= 100))
    density = self_affine(spectrum.bin_wavevector.values, plateau=1e9, rolloff=2000.0, hurst=0.8)
    density[~is_reliable] = np.nan
    np.testing.assert_allclose(spectrum.joined_psd, density, rtol=0.03)
    assert np.isnan(spectrum.attrs["tail_hurst"])
    assert set(spectrum.limited_by.values) == {"source"}


def test_described_and_measured_spectra_have_the_same_variables():
    measured = joined_spectrum([random_map(generator(21), 128, 10.0)], [None])
    described = described_spectrum()
    assert {*described.variables} == {*measured.variables}
    assert {*described.attrs} >= {*measured.attrs}
    for name, values in measured.variables.items():
        assert described[name].dtype.kind == values.dtype.kind, name
        assert described[name].attrs == values.attrs, name


def test_stacked_surfaces_keep_their_ends_and_have_empty_measurements(tmp_path):
    coat = joined_spectrum(two_sizes_and_a_line(19), [None] * 3)
    rough = joined_spectrum([random_map(generator(20), 128, 10.0)], [None])
    labels = {"rough": "Rough", "coat": "My coat"}
    write_dataset(stack_spectra({"rough": rough, "coat": coat}, labels), tmp_path / "a.nc")
    table = read_dataset(tmp_path / "a.nc")
    assert list(table["kind"].values[0]) == ["map", "", ""]
    assert table["reliable"].values[0, 1:].sum() == 0
    assert np.isnan(table["psd"].values[0, 1:]).all()
    for surface, single in (("rough", rough), ("coat", coat)):
        surface_spectrum = table.sel(surface=surface)
        np.testing.assert_array_equal(surface_spectrum["spectrum"], single["spectrum"])
        np.testing.assert_array_equal(surface_spectrum["joined_psd"], single["joined_psd"])
        for end in ("shortest_measured", "longest_measured", *Tail._fields):
            assert surface_spectrum[end].item() == single.attrs[end]
