"""The critical band: the wavelengths whose removal changes the pull-off force."""

import numpy as np
import xarray as xr

from hardcontact.statistics import resampling_counts, with_interval

__all__ = ["critical_band", "critical_wavelength"]


def critical_wavelength(cutoffs, ratios, tolerance):
    """Cutoff wavelength (nm) where a ratio curve leaves 1 ± tolerance, coming from no filter.

    cutoffs: (k,) nm in the order of growing effect; ratios: (k,). Linear in the ratio and in
    log wavelength. NaN if the curve never leaves, or has left before the first cutoff.
    """
    outside = np.flatnonzero(np.abs(ratios - 1) > tolerance)
    if not len(outside) or outside[0] == 0:
        return np.nan
    last, first = outside[0] - 1, outside[0]
    edge = 1 + np.copysign(tolerance, ratios[first] - 1)
    share = (edge - ratios[last]) / (ratios[first] - ratios[last])
    return float(np.exp(np.log(cutoffs[last]) + share * np.log(cutoffs[first] / cutoffs[last])))


def critical_band(scales, tolerance, rng, samples, confidence):
    """Ratio curves and critical wavelengths of each surface and of all pooled, by side.

    scales: Dataset with ratio(surface, realization, side, cutoff_wavelength); the pooled curve is
    the mean over surfaces. Intervals resample realizations. Returns a Dataset over side, group
    (the surfaces and "pooled") and cutoff_wavelength.
    """
    surfaces = scales.surface.values.tolist()
    count = scales.sizes["realization"]
    drawn = resampling_counts(rng, np.ones(count, bool), samples) / count
    ratio = scales.ratio.transpose("side", "surface", "realization", "cutoff_wavelength").values
    ratio = np.concatenate([ratio, ratio.mean(axis=1, keepdims=True)], axis=1)
    curves = np.einsum("nr,sgrc->nsgc", drawn, ratio)
    cutoffs = scales.cutoff_wavelength.values
    dimensions = ("side", "group")
    critical = _along_curves(cutoffs, ratio.mean(axis=2)[None], scales.side.values, tolerance)[0]
    sampled = _along_curves(cutoffs, curves, scales.side.values, tolerance, bounded=True)
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
            {"units": "nm", "long_name": "cutoff where the force leaves 10 %"},
        ),
        {
            "side": scales.side.values,
            "group": [*surfaces, "pooled"],
            "cutoff_wavelength": scales.cutoff_wavelength,
        },
    )


def _along_curves(cutoffs, curves, sides, tolerance, bounded=False):
    """Critical wavelengths (n, side, group) of curves (n, side, group, cutoff).

    From the unfiltered end: the shortest cutoff at the small side, the longest at the large side.
    bounded: a curve that never leaves the tolerance counts as leaving at its last cutoff, one
    that has left before the first as leaving there, so that percentiles see them.
    """
    found = np.full(curves.shape[:3], np.nan)
    for n, s, g in np.ndindex(found.shape):
        known = np.flatnonzero(np.isfinite(curves[n, s, g]))
        order = known if sides[s] == "small" else known[::-1]
        ratios = curves[n, s, g, order]
        found[n, s, g] = critical_wavelength(cutoffs[order], ratios, tolerance)
        if bounded and np.isnan(found[n, s, g]):
            left_at_once = abs(ratios[0] - 1) > tolerance
            found[n, s, g] = cutoffs[order[0 if left_at_once else -1]]
    return found
