"""Conditioned scans meet their targets, whatever their number and pixels."""

import numpy as np
import pandas as pd
import paper_numbers
import pytest
from measurements import PIXEL, UNCD
from refusals import assert_says, refusal
from repository import PAPER

from hardcontact.surfaces import substitutes
from hardcontact.surfaces.levelling import level_plane
from hardcontact.surfaces.metrics import TABLE1_METRICS, metrics
from hardcontact.surfaces.spectrum import spectrum_dataset
from hardcontact.surfaces.substitute_spectra import AFM_ROWS, expected_scan_rms, scan_rms_weights
from hardcontact.surfaces.substitutes import Substitute, Targets
from hardcontact.surfaces.synthesis import ScanGrid

GRID = ScanGrid(pixels=64, size=64 * PIXEL, surface_pixels=256)
#: Rows of Table 1 of a surface: heights in nm, curvatures in 1/nm.
TABLE1 = pd.DataFrame(
    {"value": [20.0, 0.4, 0.05], "uncertainty": [5.0, 0.1, 0.01]}, index=list(AFM_ROWS)
)
CONSTANTS = pd.DataFrame({"value": {"scan_pixels": 64.0, "scan_size": 64 * PIXEL}})


def substitute(spectrum, grid=GRID, table1=TABLE1):
    return Substitute("uncd", spectrum, table1, CONSTANTS, grid, 7)


def make_targets(rms_values, height_std, rows=()):
    """Return targets of the rms height, gradient and half-Laplacian of scans."""
    return Targets(dict(zip(TABLE1_METRICS.values(), rms_values, strict=True)), height_std, rows)


def assert_met(targets, scan_metrics):
    """Expect the means, and the standard deviation of rms heights of several scans."""
    for name, mean in targets.means.items():
        assert scan_metrics[name].mean() == pytest.approx(mean, rel=1e-6)
    if len(scan_metrics) > 1:
        assert scan_metrics.rms_height.std(ddof=1) == pytest.approx(
            targets.rms_height_std, rel=1e-6
        )


@pytest.fixture(scope="module")
def spectrum():
    """The spectrum of UNCD, as if calibrated on four rows of Table 1."""
    rms_values = expected_scan_rms(UNCD, scan_rms_weights(256, PIXEL, 64))
    return spectrum_dataset(UNCD.density).assign_attrs(
        table1_rows_met="afm_rms_height,afm_rms_slope,afm_rms_curvature,all_rms_slope",
        expected_scan_rms=rms_values,
    )


def batch_metrics(surface, batch):
    """Return a row of metrics for each conditioned scan of a batch."""
    scans = (substitutes.conditioned_scan(surface, k, batch) for k in batch.scan.values)
    return pd.DataFrame([metrics(level_plane(scan)) for scan in scans])


@pytest.mark.parametrize("scan_numbers", [(1,), (1, 2), (6, 7, 8, 9, 10)])
def test_conditioned_scans_have_the_given_statistics(spectrum, scan_numbers):
    rms_values = spectrum.attrs["expected_scan_rms"] * np.array([1.02, 0.97, 1.01])
    targets = make_targets(rms_values, 0.2 * rms_values[0])
    batch = substitutes.condition_batch(substitute(spectrum), targets, scan_numbers)
    assert_met(targets, batch_metrics(substitute(spectrum), batch))


PAPER_PIXELS = PAPER["substitutes"]["pixels"]
PAPER_GRID = ScanGrid(PAPER_PIXELS, size=2500.0, surface_pixels=4 * PAPER_PIXELS)
COARSE_GRID = ScanGrid(pixels=128, size=2500.0, surface_pixels=512)


@pytest.mark.parametrize(
    ("surface", "grid", "rows"),
    [
        *((surface, COARSE_GRID, ("afm_rms_height",)) for surface in paper_numbers.SUBSTRATES),
        pytest.param("mcd", PAPER_GRID, AFM_ROWS, marks=pytest.mark.study),
    ],
)
def test_scans_of_the_default_study_keep_table_1(surface, grid, rows):
    table1 = paper_numbers.table1_rows(surface)
    spectrum = paper_numbers.default_spectrum(surface)
    surface_substitute = Substitute(
        surface, spectrum, table1, paper_numbers.CONSTANTS, grid, PAPER["seed"]
    )
    targets = surface_substitute.targets
    assert targets.published_rows == tuple(rows)
    published_means = table1.value[list(rows)]
    np.testing.assert_allclose(list(targets.means.values())[: len(rows)], published_means)
    assert targets.rms_height_std == pytest.approx(table1.uncertainty["afm_rms_height"])
    batch = substitutes.condition_batch(surface_substitute, targets, [1, 2])
    assert_met(targets, batch_metrics(surface_substitute, batch))


def test_the_targets_of_an_uncalibrated_spectrum_are_its_own_rms_values(spectrum):
    uncalibrated_spectrum = spectrum.assign_attrs(table1_rows_met="")
    targets = substitute(uncalibrated_spectrum).targets
    rms_values = spectrum.attrs["expected_scan_rms"]
    np.testing.assert_array_equal(list(targets.means.values()), rms_values)
    assert targets.rms_height_std == pytest.approx(0.25 * rms_values[0])  # 5/20 in TABLE1
    assert targets.published_rows == ()


def test_coarser_pixels_keep_the_rms_height(spectrum):
    coarse = ScanGrid(32, GRID.size, 128)
    coarse_substitute = substitute(spectrum, coarse)
    targets = coarse_substitute.targets
    rms_values = expected_scan_rms(UNCD, scan_rms_weights(128, 2 * PIXEL, 32))
    np.testing.assert_allclose(list(targets.means.values()), [20.0, *rms_values[1:]])
    assert targets.published_rows == ("afm_rms_height",)
    batch = substitutes.condition_batch(coarse_substitute, targets, [1, 2])
    assert batch.attrs["table1_rows_met"] == "afm_rms_height,all_rms_slope"


def test_a_surface_without_published_roughness_is_not_conditioned(spectrum):
    assert substitute(spectrum, table1=TABLE1.iloc[:0]).targets is None
    batch = substitutes.condition_batch(substitute(spectrum), None, [1, 2])
    assert (batch.amplitude_gain == 1).all() and (batch.factor == 1).all()
    np.testing.assert_array_equal(batch.scan, [1, 2])


def test_negative_rms_heights_are_refused(spectrum):
    targets = make_targets((20.0, 0.4, 0.05), height_std=40.0)
    message = refusal(substitutes.condition_batch, substitute(spectrum), targets, range(1, 6))
    assert_says(
        message, "5 scans with the mean 20 nm and the standard deviation 40 nm", "expected", "found"
    )


def test_a_slope_beyond_the_largest_gain_is_missed_and_the_rms_height_met(spectrum):
    height, slope, curvature = spectrum.attrs["expected_scan_rms"]
    targets = make_targets((height, 0.05 * slope, curvature), 1.0, AFM_ROWS)
    batch = substitutes.condition_batch(substitute(spectrum), targets, [1, 2, 3])
    assert batch.attrs["table1_rows_met"] == "afm_rms_height,all_rms_slope"
    scan_metrics = batch_metrics(substitute(spectrum), batch)
    assert scan_metrics.rms_height.mean() == pytest.approx(height, rel=1e-6)
    assert scan_metrics.rms_height.std(ddof=1) == pytest.approx(1.0, rel=1e-6)


def test_scans_of_another_size_meet_no_row_of_table_1(spectrum):
    grid = ScanGrid(128, 2 * GRID.size, 256)
    targets = substitute(spectrum, grid).targets
    rms_values = expected_scan_rms(UNCD, scan_rms_weights(512, PIXEL, 128))
    np.testing.assert_allclose(list(targets.means.values()), rms_values)
    assert targets.published_rows == ()
