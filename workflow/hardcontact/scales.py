"""The critical band: the wavelengths whose removal changes the pull-off force."""

import numpy as np
import xarray as xr

from hardcontact.statistics import resampling_counts, with_interval

__all__ = ["critical_band", "critical_wavelength"]


def critical_wavelength(cutoffs, ratios, tolerance):
    """Cutoff wavelength (nm) where a ratio curve leaves 1 ± tolerance, coming from no filter.

    cutoffs: (k,) nm in the order of growing effect, the first the end of the spectrum, where no
    filter acts; ratios: (k,), the first 1. Linear in the ratio and in log wavelength. NaN if the
    curve never leaves.
    """
    outside = np.flatnonzero(np.abs(ratios - 1) > tolerance)
    if not len(outside):
        return np.nan
    last, first = outside[0] - 1, outside[0]
    edge = 1 + np.copysign(tolerance, ratios[first] - 1)
    share = (edge - ratios[last]) / (ratios[first] - ratios[last])
    return float(np.exp(np.log(cutoffs[last]) + share * np.log(cutoffs[first] / cutoffs[last])))


def critical_band(scales, tolerance, rng, samples, confidence):
    """Ratio curves and critical wavelengths of each surface and of all pooled, by side.

    scales: Dataset with ratio(surface, realization, side, cutoff_wavelength) and
    unfiltered_wavelength(surface, side) in nm; the pooled curve is the mean over surfaces.
    Intervals resample realizations. Returns a Dataset over side, group (the surfaces and
    "pooled") and cutoff_wavelength.
    """
    surfaces = scales.surface.values.tolist()
    count = scales.sizes["realization"]
    drawn = resampling_counts(rng, np.ones(count, bool), samples) / count
    ratio = scales.ratio.transpose("side", "surface", "realization", "cutoff_wavelength").values
    ratio = np.concatenate([ratio, ratio.mean(axis=1, keepdims=True)], axis=1)
    curves = np.einsum("nr,sgrc->nsgc", drawn, ratio)
    ends = scales.unfiltered_wavelength.transpose("side", "surface").values
    ends = np.concatenate([ends, ends.mean(axis=1, keepdims=True)], axis=1)
    cutoffs = scales.cutoff_wavelength.values
    dimensions = ("side", "group")
    critical = _along_curves(ends, cutoffs, ratio.mean(axis=2)[None], tolerance)[0]
    sampled = _along_curves(ends, cutoffs, curves, tolerance)
    # A resampled curve that never leaves does so beyond its last cutoff, which bounds it.
    last = np.where(ends < cutoffs[0], cutoffs[-1], cutoffs[0])
    sampled = np.where(np.isnan(sampled), last, sampled)
    return xr.Dataset(
        with_interval(
            "scale_ratio",
            (*dimensions, "cutoff_wavelength"),
            ratio.mean(axis=2),
            curves,
            confidence,
            {"units": "1", "long_name": "pull-off force over that unfiltered"},
        )
        | with_interval(
            "critical_wavelength",
            dimensions,
            critical,
            sampled,
            confidence,
            {"units": "nm", "long_name": "cutoff where the force leaves its tolerance"},
        ),
        {
            "side": scales.side.values,
            "group": [*surfaces, "pooled"],
            "cutoff_wavelength": scales.cutoff_wavelength,
        },
    )


def _along_curves(ends, cutoffs, curves, tolerance):
    """Critical wavelengths (n, side, group) of curves (n, side, group, cutoff).

    ends: (side, group) nm, the unfiltered end: below all cutoffs, or above.
    """
    found = np.empty(curves.shape[:3])
    for n, s, g in np.ndindex(found.shape):
        known = np.flatnonzero(np.isfinite(curves[n, s, g]))
        order = known if ends[s, g] < cutoffs[known[0]] else known[::-1]
        found[n, s, g] = critical_wavelength(
            np.append(ends[s, g], cutoffs[order]), np.append(1.0, curves[n, s, g, order]), tolerance
        )
    return found
