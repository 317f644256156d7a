"""Metrics of height maps, such as the rms height."""

from collections.abc import Iterable

import numpy as np
import xarray as xr

from hardcontact.surfaces.height_map import HeightMap

#: Units and long names of metrics.
METRICS = {
    "rms_height": ("nm", "rms height"),
    "rms_gradient": ("1", "rms gradient (2D slope)"),
    "rms_profile_slope": ("1", "rms slope of profiles along x"),
    "rms_half_laplacian": ("nm-1", "half the rms Laplacian (mean curvature)"),
    "rms_laplacian": ("nm-1", "rms Laplacian"),
    "skewness": ("1", "skewness of heights"),
    "kurtosis": ("1", "kurtosis of heights (3 for a Gaussian)"),
    "peak_to_valley": ("nm", "peak to valley"),
}
#: Metrics by rows of Table 1 for AFM scans. The paper does not define slope and curvature.
TABLE1_METRICS = {
    "afm_rms_height": "rms_height",
    "afm_rms_slope": "rms_gradient",
    "afm_rms_curvature": "rms_half_laplacian",
}
#: The variable of topography.nc for each row of Table 1, of AFM scans and over all scales.
TABLE1_VARIABLES = {row: f"{metric}_mean" for row, metric in TABLE1_METRICS.items()} | {
    row.replace("afm", "all"): f"all_scales_{metric}" for row, metric in TABLE1_METRICS.items()
}


def metrics(scan: HeightMap) -> dict[str, float]:
    """Return the rms height, gradient and curvature of a scan, and its other METRICS.

    Derivatives are finite differences between neighbouring pixels, as in SurfaceTopography, at the
    pixels that have both derivatives. They do not wrap around a periodic map.

    Parameters
    ----------
    scan : HeightMap
        A levelled map.

    Returns
    -------
    dict of str to float
        The metrics by name, such as ``rms_height``: heights in nm, curvatures in 1/nm.

    Examples
    --------
    >>> scan = hc.read_scan("scan.nc")
    >>> rms_height = hc.metrics(scan)["rms_height"]  # nm
    """
    heights = scan.heights.astype(float)
    pixel_size = scan.pixel_size
    slope_y = np.diff(heights, axis=0)[:, :-1] / pixel_size
    slope_x = np.diff(heights, axis=1)[:-1] / pixel_size
    second_differences = np.diff(heights, 2, axis=0)[:, 1:-1] + np.diff(heights, 2, axis=1)[1:-1]
    rms_laplacian = float(np.sqrt((second_differences**2).mean())) / pixel_size**2
    flat_heights = heights.ravel()
    deviations = flat_heights - flat_heights.mean()
    squares = deviations**2
    variance = squares.mean()
    return {
        "rms_height": float(flat_heights.std()),
        "rms_gradient": float(np.sqrt((slope_x**2 + slope_y**2).mean())),
        "rms_profile_slope": float(np.sqrt((slope_x**2).mean())),
        "rms_half_laplacian": rms_laplacian / 2,
        "rms_laplacian": rms_laplacian,
        "skewness": float((squares * deviations).mean() / variance**1.5),
        "kurtosis": float((squares**2).mean() / variance**2),
        "peak_to_valley": float(np.ptp(flat_heights)),
    }


def metrics_dataset(scan: HeightMap, names: Iterable[str]) -> xr.Dataset:
    """Return METRICS of a scan, by their names, as variables."""
    scan_metrics = metrics(scan)
    variables = {}
    for name in names:
        unit, long_name = METRICS[name]
        variables[name] = ((), scan_metrics[name], {"units": unit, "long_name": long_name})
    return xr.Dataset(variables)
