"""Metrics of a scan equal those of SurfaceTopography and SciPy."""

import numpy as np
import pytest
from scipy import stats

from hardcontact.surfaces.height_map import HeightMap, to_surface_topography
from hardcontact.surfaces.metrics import metrics


@pytest.mark.parametrize("shape", [(64, 64), (30, 47)])
def test_metrics_equal_those_of_surface_topography_and_scipy(shape):
    heights = np.random.default_rng(3).standard_normal(shape).cumsum(axis=0)
    scan = HeightMap(heights, 4.9)
    scan_metrics, topography = metrics(scan), to_surface_topography(scan)
    for name, library_metric in (
        ("rms_height", topography.Sq()),
        ("rms_gradient", topography.rms_gradient()),
        ("rms_profile_slope", topography.Rdq()),
        ("rms_half_laplacian", topography.rms_curvature_from_area()),
        ("rms_laplacian", 2 * topography.rms_curvature_from_area()),
        ("skewness", stats.skew(scan.heights, axis=None)),
        ("kurtosis", stats.kurtosis(scan.heights, axis=None, fisher=False)),
    ):
        assert scan_metrics[name] == pytest.approx(library_metric, rel=1e-13)
