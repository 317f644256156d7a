"""The critical band: the wavelengths whose removal changes the pull-off force."""

import numpy as np
import xarray as xr

from hardcontact.adhesion.bootstrap import Bootstrap
from hardcontact.statistics import resampling_counts

__all__ = ["critical_band", "critical_wavelength", "find_critical_band"]


def find_critical_band(scales: xr.Dataset, tolerance: float, bootstrap: Bootstrap) -> xr.Dataset:
    """Find the critical band of all surfaces, with label and basis of each.

    Parameters
    ----------
    scales : xarray.Dataset
        Forces of the filtered masters, as in scales.nc.
    tolerance : float
        Relative change of the force that counts.
    bootstrap : Bootstrap
        Of the intervals.

    Returns
    -------
    xarray.Dataset
        Variables of `critical_band`, label and basis.
    """
    band = critical_band(scales, tolerance, bootstrap)
    return band.assign(label=scales.label, basis=scales.basis).assign_attrs(
        scale_tolerance=tolerance,
        confidence=bootstrap.confidence,
        sphere_radius=scales.attrs["sphere_radius"],
    )


def critical_band(scales: xr.Dataset, tolerance: float, bootstrap: Bootstrap) -> xr.Dataset:
    """Return ratio curves and critical wavelengths of each surface and of all pooled, by side.

    Parameters
    ----------
    scales : xarray.Dataset
        ratio (surface, realization, side, cutoff_wavelength) and unfiltered_wavelength
        (surface, side) in nm.
    tolerance : float
        Relative change of the force that counts.
    bootstrap : Bootstrap
        Realizations are resampled.

    Returns
    -------
    xarray.Dataset
        scale_ratio (1) and critical_wavelength (nm) with their intervals, over side, group (the
        surfaces, and "pooled", whose curve is the mean over them) and cutoff_wavelength.
    """
    surfaces, realizations = scales.surface.values.tolist(), scales.sizes["realization"]
    available = np.ones(realizations, bool)
    drawn = resampling_counts(bootstrap.generator("scales"), available, bootstrap.samples)
    ratio = scales.ratio.transpose("side", "surface", "realization", "cutoff_wavelength").values
    ratio = np.concatenate([ratio, ratio.mean(axis=1, keepdims=True)], axis=1)
    curves = np.einsum("nr,sgrc->nsgc", drawn / realizations, ratio)
    ends = scales.unfiltered_wavelength.transpose("side", "surface").values
    ends = np.concatenate([ends, ends.mean(axis=1, keepdims=True)], axis=1)
    cutoffs = scales.cutoff_wavelength.values
    critical = _along_curves(ends, cutoffs, ratio.mean(axis=2)[None], tolerance)[0]
    sampled = _along_curves(ends, cutoffs, curves, tolerance)
    # A resampled curve that stays within the tolerance gets the last cutoff, a bound on where it
    # leaves.
    last = np.where(ends < cutoffs[0], cutoffs[-1], cutoffs[0])
    sampled = np.where(np.isnan(sampled), last, sampled)
    return xr.Dataset(
        bootstrap.with_interval(
            "scale_ratio",
            ("side", "group", "cutoff_wavelength"),
            ratio.mean(axis=2),
            curves,
            {"units": "1", "long_name": "pull-off force over that unfiltered"},
        )
        | bootstrap.with_interval(
            "critical_wavelength",
            ("side", "group"),
            critical,
            sampled,
            {"units": "nm", "long_name": "cutoff where the force leaves its tolerance"},
        ),
        {
            "side": scales.side.values,
            "group": [*surfaces, "pooled"],
            "cutoff_wavelength": scales.cutoff_wavelength,
        },
    )


def critical_wavelength(cutoffs: np.ndarray, ratios: np.ndarray, tolerance: float) -> float:
    """Return the cutoff where a ratio curve leaves 1 ± tolerance, coming from no filter.

    Linear in the ratio and in log wavelength.

    Parameters
    ----------
    cutoffs : ndarray (k,)
        In nm, in the order of growing effect; the first is the end of the spectrum, where no
        filter acts.
    ratios : ndarray (k,)
        The first is 1.
    tolerance : float
        Relative change of the force that counts.

    Returns
    -------
    float
        In nm; NaN if the curve never leaves.
    """
    outside = np.flatnonzero(np.abs(ratios - 1) > tolerance)
    if not len(outside):
        return np.nan
    last, first = outside[0] - 1, outside[0]
    edge = 1 + np.copysign(tolerance, ratios[first] - 1)
    share = (edge - ratios[last]) / (ratios[first] - ratios[last])
    return float(np.exp(np.log(cutoffs[last]) + share * np.log(cutoffs[first] / cutoffs[last])))


def _along_curves(
    ends: np.ndarray, cutoffs: np.ndarray, curves: np.ndarray, tolerance: float
) -> np.ndarray:
    """Return critical wavelengths (n, side, group) of curves (n, side, group, cutoff).

    ends: (side, group) nm, the unfiltered end: below all cutoffs, or above.
    """
    wavelengths = np.empty(curves.shape[:3])
    for n, s, g in np.ndindex(wavelengths.shape):
        known = np.flatnonzero(np.isfinite(curves[n, s, g]))
        order = known if ends[s, g] < cutoffs[known[0]] else known[::-1]
        wavelengths[n, s, g] = critical_wavelength(
            np.append(ends[s, g], cutoffs[order]), np.append(1.0, curves[n, s, g, order]), tolerance
        )
    return wavelengths
