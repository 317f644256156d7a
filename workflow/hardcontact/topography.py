"""Height maps: levelling, subtracting the sphere, mirror stitching, rms metrics.

A height map is an array (y, x) in nm on square pixels; heights grow out of the material.
"""

import numpy as np
from scipy.stats import kurtosis, skew
from scipy.stats import t as student_t
from SurfaceTopography import Topography

__all__ = [
    "METRICS",
    "averages",
    "level",
    "metrics",
    "mirror_stitch",
    "subtract_sphere",
    "table1_variables",
    "thinned",
]

#: Metrics of a height map with their units and long names, in the order of Table 1.
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

#: What slope and curvature of Table 1 may be.
DEFINITIONS = {
    "gradient": "rms_gradient",
    "profile": "rms_profile_slope",
    "half_laplacian": "rms_half_laplacian",
    "laplacian": "rms_laplacian",
}


def _library_map(heights, pixel_size):
    """The height map as SurfaceTopography knows it; its first axis is x."""
    sizes = tuple(count * pixel_size for count in heights.T.shape)
    return Topography(np.asarray(heights, dtype=float).T, sizes, unit="nm")


def level(heights, pixel_size):
    """Heights (y, x) in nm less their least-squares plane."""
    return _library_map(heights, pixel_size).detrend("height").heights().T


def subtract_sphere(heights, pixel_size, radius):
    """Roughness (y, x) in nm of a scan of the top of a sphere of `radius` (nm).

    The paraboloid x²/2R of the known radius is added back and the plane removed; where the apex
    lies does not matter, for moving it adds a plane.
    """
    y, x = (_centred(count) * pixel_size for count in heights.shape)
    return level(heights + (y[:, None] ** 2 + x**2) / (2 * radius), pixel_size)


def _centred(count):
    return np.arange(count) - (count - 1) / 2


def mirror_stitch(heights):
    """Periodic map (2y, 2x): the scan beside its mirror images, so that all edges match.

    Source: the paper, section Numerical Analysis of Results.
    """
    wide = np.concatenate([heights, heights[:, ::-1]], axis=1)
    return np.concatenate([wide, wide[::-1]], axis=0)


def metrics(heights, pixel_size):
    """The METRICS of a levelled, non-periodic scan (y, x) in nm, as a dict of floats.

    Derivatives are finite differences between neighbouring pixels, as in Table 1's source
    library; each definition that the paper leaves open stands under its own name.
    """
    topography = _library_map(heights, pixel_size)
    values = heights.ravel()
    half_laplacian = topography.rms_curvature_from_area()
    return {
        "rms_height": float(topography.rms_height_from_area()),
        "rms_gradient": float(topography.rms_gradient()),
        "rms_profile_slope": float(topography.rms_slope_from_profile()),
        "rms_half_laplacian": float(half_laplacian),
        "rms_laplacian": float(2 * half_laplacian),
        "skewness": float(skew(values)),
        "kurtosis": float(kurtosis(values, fisher=False)),
        "peak_to_valley": float(np.ptp(values)),
    }


def averages(scans, confidence):
    """Mean, standard deviation and confidence interval of the mean over scans, of every metric.

    scans: Dataset of METRICS over (surface, scan), NaN where a surface has no such scan. Student's
    t over scans gives the interval. Returns a dict of DataArrays named <metric>_mean, _std,
    _mean_low and _mean_high over surface.
    """
    found = {}
    for name in METRICS:
        values = scans[name]
        count, mean, std = values.count("scan"), values.mean("scan"), values.std("scan", ddof=1)
        reach = student_t.ppf((1 + confidence) / 2, count - 1) * std / np.sqrt(count)
        found |= {
            f"{name}_mean": mean,
            f"{name}_std": std,
            f"{name}_mean_low": mean - reach,
            f"{name}_mean_high": mean + reach,
        }
    return {
        key: value.assign_attrs(scans[key.split("_mean")[0].removesuffix("_std")].attrs)
        for key, value in found.items()
    }


def table1_variables(slope, curvature):
    """Which variable of the topography dataset is which row of Table 1, by the row's name.

    slope, curvature: keys of DEFINITIONS.
    """
    metrics = {
        "height": "rms_height",
        "slope": DEFINITIONS[slope],
        "curvature": DEFINITIONS[curvature],
    }
    return {f"afm_rms_{row}": f"{metric}_mean" for row, metric in metrics.items()} | {
        f"all_rms_{row}": f"all_scales_{metric}" for row, metric in metrics.items()
    }


def thinned(heights, pixels):
    """Every so-many-th pixel of a square map, pixels x pixels of them: for pictures."""
    chosen = np.linspace(0, heights.shape[0] - 1, pixels).round().astype(int)
    return heights[np.ix_(chosen, chosen)].astype(np.float32)
