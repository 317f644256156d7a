"""The substitutes of the default study: spectra without jumps, scans that keep Table 1."""

from functools import cache, partial

import numpy as np
import pandas as pd
import pytest
from paper_numbers import SUBSTRATES, SURFACES
from repository import PAPER, ROOT

from hardcontact.config.grids import realization_pixels
from hardcontact.numbers.random import generator
from hardcontact.records import published
from hardcontact.surfaces.conditioning import amplified, conditioned_group, scan_targets
from hardcontact.surfaces.height_map import HeightMap, level, metrics
from hardcontact.surfaces.spectrum import (
    AFM_ROWS,
    TAIL_ROWS,
    WAVEVECTORS,
    Spectrum,
    all_scales_moments,
    spectrum_from,
)
from hardcontact.surfaces.substitute_scans import ScanGrid, synthesized_scan
from hardcontact.surfaces.substitute_spectra import (
    from_description,
    rows_of_surface,
    substitute_spectrum,
    transfer_weights,
)

DEFINITIONS = {"slope": "gradient", "curvature": "half_laplacian"}
TABLE1 = published.table1(ROOT / "resources/paper/table1.csv")
CONSTANTS = published.constants(ROOT / "resources/paper/parameters.csv")
SPECTRA = ROOT / "resources/spectra"
SEED = PAPER["seed"]


def rows(surface):
    return rows_of_surface(TABLE1, surface, **DEFINITIONS)


@cache
def spectrum(surface):
    """The spectrum of a default substitute, as it is stored."""
    return substitute_spectrum(SPECTRA / f"{surface}.csv", rows(surface), CONSTANTS)


def scans(surface, numbers, grid):
    """Targets and metrics of scans of a surface that are conditioned together."""
    targets = scan_targets(spectrum(surface), rows(surface), CONSTANTS, DEFINITIONS, grid)
    streams = {n: partial(generator, SEED, surface, n, "scan") for n in numbers}
    group = conditioned_group(spectrum(surface), targets, streams, grid)
    density, values = amplified(spectrum_from(spectrum(surface)), group.gain.values), []
    for number, factor in zip(numbers, group.factor.values, strict=True):
        made = synthesized_scan(streams[number](), density, grid, factor)
        heights = made.heights.values.T
        stored = level(HeightMap(heights, grid.pixel_size, False, "substitute"))
        values.append(metrics(stored))
    return targets, pd.DataFrame(values)


@pytest.mark.parametrize("surface", SURFACES)
def test_no_spectrum_jumps(surface):
    density = spectrum(surface).spectrum.values
    density = density[density > 0][:-1]  # the last cell counts by its share
    step = np.diff(np.log(density)) / np.diff(np.log(WAVEVECTORS[: len(density)]))
    # A jump by a factor of two between two of 40 points a decade is a slope of 12.
    assert np.abs(step).max() < 6


@pytest.mark.parametrize("surface", SUBSTRATES)
def test_spectra_meet_every_row_of_table_1_but_the_height_over_all_scales(surface):
    stored = spectrum(surface)
    table1 = rows(surface).value
    assert stored.attrs["calibrated_to_table1"] == ",".join([*AFM_ROWS, *TAIL_ROWS])
    np.testing.assert_allclose(
        stored.attrs["expected_scan_moments"], table1[list(AFM_ROWS)], rtol=1e-9
    )
    moments = all_scales_moments(Spectrum(WAVEVECTORS, stored.spectrum.values))
    np.testing.assert_allclose(moments[1:], table1[list(TAIL_ROWS)], rtol=1e-9)


# Plain runs look at the smaller scans of the quick study, below.
@pytest.mark.study
@pytest.mark.parametrize("surface", SUBSTRATES)
def test_the_five_scans_of_a_coating_keep_table_1(surface):
    scan = PAPER["scan"]
    grid = ScanGrid(scan["pixels"], 2500.0, realization_pixels(scan["pixels"]))
    _, found = scans(surface, range(1, 6), grid)
    table1 = rows(surface)
    assert found.rms_height.std(ddof=1) == pytest.approx(
        table1.uncertainty["afm_rms_height"], rel=1e-6
    )
    means = found[["rms_height", "rms_gradient", "rms_half_laplacian"]].mean()
    np.testing.assert_allclose(means, table1.value[list(AFM_ROWS)], rtol=1e-6)


@pytest.mark.parametrize("surface", SUBSTRATES)
@pytest.mark.parametrize("numbers", [(1,), (1, 2), (3, 4)], ids=str)
def test_scans_of_the_quick_study_keep_the_heights_of_table_1(surface, numbers):
    targets, found = scans(surface, numbers, ScanGrid(128, 2500.0, 512))
    height = rows(surface).loc["afm_rms_height"]
    assert found.rms_height.mean() == pytest.approx(height.value, rel=1e-6)
    if len(numbers) > 1:
        assert found.rms_height.std(ddof=1) == pytest.approx(height.uncertainty, rel=1e-6)
    for name, mean in targets.means.items():
        assert found[name].mean() == pytest.approx(mean, rel=1e-6)
    assert targets.rows == ("afm_rms_height",)


def test_uncd_is_near_what_is_measured_of_it_in_public():
    """The ratios that workflow/report/departures.md reports."""
    weights = transfer_weights(256, 2500 / 64, 64)
    density, *_ = from_description(SPECTRA / "uncd-measured.csv", rows("uncd"), weights)
    q = 2 * np.pi / np.array([2000, 1000, 500, 200, 100, 50])
    calibrated = Spectrum(WAVEVECTORS, spectrum("uncd").spectrum.values)(q)
    ratio = calibrated / Spectrum(WAVEVECTORS, density)(q)
    np.testing.assert_allclose(ratio, [1.29, 2.00, 0.86, 0.68, 0.71, 0.75], atol=0.005)
