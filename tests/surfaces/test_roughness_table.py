"""The table of roughness: averages over scans, spectra over all scales, maps for pictures."""

import numpy as np
import pytest
import xarray as xr
from random_scans import PIXEL, UNCD, levelled_scan

from hardcontact.numbers.random import generator
from hardcontact.numbers.statistics import bounds
from hardcontact.surfaces.height_map import METRICS, metrics, prepared_scan
from hardcontact.surfaces.roughness_table import averages, measured_roughness, roughness_table
from hardcontact.surfaces.spectrum import all_scales_moments, measured_psds, spectrum_dataset
from hardcontact.surfaces.substitute_scans import sphere_scan

SETTINGS = dict(
    labels={"uncd": "UNCD", "ruby": "ruby"},
    basis={"uncd": "measured", "ruby": "substitute"},
    sphere_surface="ruby",
    reference_surface="uncd",
    table1={"slope": "gradient", "curvature": "half_laplacian"},
    confidence=0.9,
)


def test_roughness_of_a_scan_is_its_metrics_and_spectra():
    scan = levelled_scan(generator(1), 64)
    dataset = measured_roughness(scan)
    for name, value in metrics(scan).items():
        assert dataset[name].item() == value
        assert dataset[name].attrs["units"] == METRICS[name][0]
    for name, values in zip(
        ("wavevector", "psd_profile", "psd_isotropic"), measured_psds(scan), strict=True
    ):
        np.testing.assert_array_equal(dataset[name], values)


def test_averages_over_scans():
    scans = xr.Dataset(
        {
            name: (("surface", "scan"), [[1.0, 2.0, 3.0], [5.0, 7.0, np.nan]], {"units": "nm"})
            for name in METRICS
        }
    )
    mean = averages(scans, 0.95)
    np.testing.assert_allclose(mean["rms_height_mean"], [2, 6])
    np.testing.assert_allclose(mean["rms_height_std"], [1, np.sqrt(2)])
    # Student's t: 4.303 for two degrees of freedom, 12.706 for one.
    low, high = bounds(mean, "rms_height_mean")
    reach = np.array([4.3027 / 3**0.5, 12.7062])
    np.testing.assert_allclose(high, [2, 6] + reach, rtol=1e-4)
    np.testing.assert_allclose(low, [2, 6] - reach, rtol=1e-4)
    assert mean["rms_height_mean_interval"].dims == ("surface", "bound")
    assert mean["rms_height_mean_interval"].attrs == {"units": "nm", "confidence": 0.95}
    assert mean["rms_height_std"].attrs == {"units": "nm"}


@pytest.fixture(scope="module")
def maps():
    """Two scans of UNCD and one of the sphere, of more pixels, as they are read."""
    sphere = sphere_scan(generator(3), levelled_scan(generator(3), 48), 250e3)
    return {
        ("uncd", 1): levelled_scan(generator(1), 32),
        ("uncd", 2): levelled_scan(generator(2), 32),
        ("ruby", 1): sphere,
    }


@pytest.fixture(scope="module")
def table(maps):
    scans = {key: measured_roughness(scan) for key, scan in maps.items()}
    radius = {"uncd": None, "ruby": 250e3}
    examples = {name: prepared_scan(maps[name, 1], radius[name])[0] for name in radius}
    spectra = {
        name: spectrum_dataset(factor * UNCD.density).assign_attrs(calibrated_to_table1=name)
        for name, factor in (("uncd", 1), ("ruby", 4))
    }
    conditionings = {"ruby": xr.Dataset(attrs={"calibrated_to_table1": "afm_rms_height"})}
    return roughness_table(scans, spectra, conditionings, examples, **SETTINGS)


def test_table_has_every_scan_and_what_is_missing_is_nan(table, maps):
    assert list(table.surface.values) == ["uncd", "ruby"] and list(table.scan.values) == [1, 2]
    for (surface, scan), heights in maps.items():
        rms_height = table.rms_height.sel(surface=surface, scan=scan).item()
        assert rms_height == metrics(heights)["rms_height"]
    assert np.isnan(table.rms_height.sel(surface="ruby", scan=2))
    mean = table.psd_isotropic.sel(surface="uncd").mean("scan")
    np.testing.assert_array_equal(table.psd_isotropic_mean.sel(surface="uncd"), mean)
    expected = averages(table, 0.9)
    for name in ("rms_gradient_mean", "rms_gradient_std", "rms_gradient_mean_interval"):
        np.testing.assert_array_equal(table[name], expected[name])
        assert table[name].attrs == expected[name].attrs


def test_table_has_the_spectra_and_their_moments(table):
    height, gradient, half_laplacian = all_scales_moments(UNCD)
    for name, expected in (
        ("all_scales_rms_height", height),
        ("all_scales_rms_gradient", gradient),
        ("all_scales_rms_profile_slope", gradient / 2**0.5),
        ("all_scales_rms_half_laplacian", half_laplacian),
        ("all_scales_rms_laplacian", 2 * half_laplacian),
    ):
        np.testing.assert_allclose(table[name], [expected, 2 * expected])
    np.testing.assert_allclose(table.spectrum.sel(surface="uncd"), UNCD(table.wavevector.values))


def test_maps_of_all_surfaces_have_the_pixels_of_the_coarsest(table, maps):
    assert table.example_heights.shape == (2, 32, 32)
    sphere = maps["ruby", 1].heights.astype(np.float32)
    seen = table.sphere_as_scanned.values
    assert seen.shape == (32, 32) and seen.dtype == np.float32
    assert seen[0, 0] == sphere[0, 0] and seen[-1, -1] == sphere[-1, -1]
    assert np.isin(seen, sphere).all()
    np.testing.assert_allclose(table.scan_size, [32 * PIXEL, 48 * PIXEL])
    np.testing.assert_allclose(table.pixel_size, [PIXEL, PIXEL])


def test_table_says_what_the_surfaces_are(table):
    assert list(table.label.values) == ["UNCD", "ruby"]
    assert list(table.basis.values) == ["measured", "substitute"]
    assert list(table.calibrated_to_table1.values) == ["uncd", "afm_rms_height"]
    assert table.attrs["sphere_surface"] == "ruby"
    assert table.attrs["reference_surface"] == "uncd"
    assert table.attrs["confidence"] == 0.9
    assert '"afm_rms_slope":"rms_gradient_mean"' in table.attrs["table1_variables"]
