"""topography.nc: averages over scans, spectra over all scales, maps for pictures."""

from dataclasses import replace

import numpy as np
import pytest
import xarray as xr
from measurements import PIXEL, UNCD, levelled_scan, measurement

from hardcontact.base.arrays import generator
from hardcontact.surfaces.levelling import level_and_mirror, remove_form
from hardcontact.surfaces.metrics import metrics
from hardcontact.surfaces.spectrum import measured_psds, spectrum_dataset
from hardcontact.surfaces.synthesis import add_sphere_shape
from hardcontact.surfaces.topography import measured_roughness, topography_dataset


@pytest.fixture(scope="module")
def maps():
    """Two scans of UNCD, and a scan of the sphere with more pixels."""
    sphere = add_sphere_shape(generator(3), levelled_scan(generator(3), 48), 250e3)
    uncd = {("uncd", number): levelled_scan(generator(number), 32) for number in (1, 2)}
    return uncd | {("ruby", 1): sphere}


@pytest.fixture(scope="module")
def table(maps):
    examples = {
        name: level_and_mirror(measurement(maps[name, 1].heights, PIXEL), radius)[0]
        for name, radius in (("uncd", None), ("ruby", 250e3))
    }
    spectra = {
        name: spectrum_dataset(factor * UNCD.density).assign_attrs(table1_rows_met=name)
        for name, factor in (("uncd", 1), ("ruby", 4))
    }
    conditionings = {"ruby": xr.Dataset(attrs={"table1_rows_met": "afm_rms_height"})}
    scans = {key: measured_roughness(scan) for key, scan in maps.items()}
    return topography_dataset(scans, spectra, conditionings, examples, 0.9)


def test_the_table_has_every_scan_and_nan_for_missing_scans(table, maps):
    for (surface, number), scan in maps.items():
        row = table.sel(surface=surface, scan=number)
        assert row.rms_height == metrics(scan)["rms_height"]
        _, _, isotropic_psd = measured_psds(scan)
        np.testing.assert_array_equal(row.isotropic_psd, isotropic_psd)
    assert np.isnan(table.rms_height.sel(surface="ruby", scan=2))
    assert list(table.table1_rows_met.values) == ["uncd", "afm_rms_height"]


def test_maps_of_all_surfaces_have_the_pixels_of_the_coarsest(table, maps):
    assert table.example_heights.shape == (2, 32, 32)
    scanned, sphere = table.sphere_as_scanned.values, maps["ruby", 1].heights.astype(np.float32)
    assert scanned.shape == (32, 32)
    assert scanned[0, 0] == sphere[0, 0] and scanned[-1, -1] == sphere[-1, -1]
    np.testing.assert_allclose(table.scan_size, [32 * PIXEL, 48 * PIXEL])


@pytest.mark.parametrize("radius", [None, 250e3])
def test_a_prepared_scan_is_levelled_and_mirrored_and_keeps_its_notes(maps, radius):
    scan = replace(measurement(maps["ruby", 1].heights, PIXEL), notes=("cropped", "filled"))
    levelled, mirrored = level_and_mirror(scan, radius, "lines")
    np.testing.assert_array_equal(mirrored.heights[48:, 48:], levelled.heights[::-1, ::-1])
    assert levelled.attrs["notes"] == mirrored.attrs["notes"] == "cropped\nfilled"
    assert (levelled.attrs["periodic"], mirrored.attrs["periodic"]) == (0, 1)
    assert ("as_scanned" in levelled) == (radius is not None)
    heights = remove_form(maps["ruby", 1], radius, "lines").heights
    np.testing.assert_allclose(levelled.heights, heights, atol=1e-4)
