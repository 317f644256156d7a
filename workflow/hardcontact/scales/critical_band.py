"""The critical band: the wavelengths whose removal changes the pull-off force."""

import numpy as np
import xarray as xr

from hardcontact.numbers.statistics import Sampling, student_log_samples


def computed_cutoffs(values: xr.DataArray) -> np.ndarray:
    """Return the cutoffs (nm), growing, at which any value of one side is known.

    Values (..., cutoff_wavelength) are NaN at cutoffs of the other side.
    """
    others = [dim for dim in values.dims if dim != "cutoff_wavelength"]
    known = values["cutoff_wavelength"].values[values.notnull().any(others).values]
    return np.sort(known)


def last_cutoff(values: xr.DataArray, side: str) -> float:
    """Return the cutoff (nm) of a side that removes most, which stands for all beyond it.

    The side is "small" or "large"; values (..., cutoff_wavelength) are NaN at cutoffs of the other.
    """
    return float(computed_cutoffs(values)[-1 if side == "small" else 0])


#: The group of all surfaces.
POOLED = "pooled"

AXES = ("side", "surface", "cutoff_wavelength")


def find_critical_band(scales: xr.Dataset, tolerance: float, sampling: Sampling) -> xr.Dataset:
    """Return the `critical_band` of all surfaces, with label and basis of each.

    The forces of the filtered masters are as in scales.nc; the tolerance is the relative change of
    the force that counts.
    """
    band = critical_band(scales, tolerance, sampling)
    return band.assign(label=scales.label, basis=scales.basis).assign_attrs(
        scale_tolerance=tolerance,
        confidence=sampling.confidence,
        sphere_radius=scales.attrs["sphere_radius"],
    )


def critical_band(scales: xr.Dataset, tolerance: float, sampling: Sampling) -> xr.Dataset:
    """Return ratio curves, changes of the force and critical wavelengths, by side.

    Parameters
    ----------
    scales : xarray.Dataset
        ratio (surface, realization, side, cutoff_wavelength), NaN at cutoffs of the other side, and
        unfiltered_wavelength (surface, side) in nm.
    tolerance : float
        Relative change of the force that counts.
    sampling : Sampling
        Mean ratios over realizations are sampled, each surface by itself.

    Returns
    -------
    xarray.Dataset
        scale_ratio (1) over side, surface and cutoff_wavelength; scale_change (1) and
        critical_wavelength (nm) over side and group, and scale_change over cutoff_wavelength; all
        with intervals. The change is |ratio - 1|; that of the group POOLED is the mean over
        surfaces. A surface leaves the tolerance where ln(ratio) does. A sampled change that stays
        within the tolerance counts as the last cutoff of its side, a bound on where it leaves.
    """
    realizations = scales.ratio.transpose("realization", *AXES)
    ratio = realizations.mean("realization").values
    sampled = _sampled_ratios(realizations, sampling)
    change, changes = _changes(ratio), _changes(sampled)
    cutoffs = scales.cutoff_wavelength.values
    ends = scales.unfiltered_wavelength.transpose("side", "surface").values
    ends = np.concatenate([ends, ends.mean(axis=1, keepdims=True)], axis=1)
    critical = _critical_wavelengths(ends, cutoffs, ratio[None], tolerance)[0]
    known = np.isfinite(change)
    last = [np.where(known, cutoffs, limit) for limit in (-np.inf, np.inf)]
    last = np.where(ends < cutoffs[0], last[0].max(axis=-1), last[1].min(axis=-1))
    critical_samples = _critical_wavelengths(ends, cutoffs, sampled, tolerance)
    stays = np.isnan(critical_samples) & np.isfinite(changes).any(axis=-1)
    critical_samples = np.where(stays, last, critical_samples)
    one, long_name = {"units": "1"}, "long_name"
    return xr.Dataset(
        sampling.with_interval(
            "scale_ratio",
            AXES,
            ratio,
            sampled,
            one | {long_name: "pull-off force over that unfiltered"},
        )
        | sampling.with_interval(
            "scale_change",
            ("side", "group", "cutoff_wavelength"),
            change,
            changes,
            one | {long_name: "relative change of the pull-off force, up or down"},
        )
        | sampling.with_interval(
            "critical_wavelength",
            ("side", "group"),
            critical,
            critical_samples,
            {"units": "nm", long_name: "cutoff where the force leaves its tolerance"},
        ),
        {
            "side": scales.side.values,
            "surface": scales.surface.values,
            "group": [*scales.surface.values.tolist(), POOLED],
            "cutoff_wavelength": scales.cutoff_wavelength,
        },
    )


def _sampled_ratios(realizations: xr.DataArray, sampling: Sampling) -> np.ndarray:
    """Return samples of the mean of ratios (realization, *AXES): (sample, *AXES)."""
    samples = [
        student_log_samples(
            sampling.generator("scales", str(surface)),
            realizations.sel(surface=surface).dropna("realization", how="all").values,
            sampling.samples,
        )
        for surface in realizations.surface.values
    ]
    return np.stack(samples, axis=2)


def _changes(ratios: np.ndarray) -> np.ndarray:
    """Return |ratio - 1| (..., group, cutoff) of ratios (..., surface, cutoff), the mean last."""
    changes = np.abs(ratios - 1)
    return np.concatenate([changes, changes.mean(axis=-2, keepdims=True)], axis=-2)


def logarithmic_limits(tolerance: float) -> tuple[float, float]:
    """Return the limits of ln(ratio) within which a force is as good as unchanged."""
    return float(np.log1p(-tolerance)), float(np.log1p(tolerance))


def critical_wavelength(
    cutoffs: np.ndarray, curve: np.ndarray, limits: tuple[float, float]
) -> float:
    """Return the cutoff (nm) where a curve leaves its limits, coming from no filter; NaN if never.

    Linear in the curve and in log wavelength. The cutoffs (k,), in nm, are in the order of growing
    effect. The curve (k,) begins within the limits, lower and upper. Of one surface it is
    ln(ratio), which passes through no change where the ratio crosses one, as |ratio - 1| does not;
    of several surfaces it is the mean of |ratio - 1|, which has no sign.
    """
    lower, upper = limits
    outside = np.flatnonzero((curve < lower) | (curve > upper))
    if not len(outside):
        return np.nan
    last, first = outside[0] - 1, outside[0]
    limit = upper if curve[first] > upper else lower
    share = (limit - curve[last]) / (curve[first] - curve[last])
    return float(np.exp(np.log(cutoffs[last]) + share * np.log(cutoffs[first] / cutoffs[last])))


def _critical_wavelengths(
    ends: np.ndarray, cutoffs: np.ndarray, ratios: np.ndarray, tolerance: float
) -> np.ndarray:
    """Return critical wavelengths (n, side, group) of ratios (n, side, surface, cutoff).

    ends: (side, group) nm, the unfiltered end: below all cutoffs, or above.
    """
    pooled = _changes(ratios)[:, :, -1:]
    of_surfaces = _along_curves(
        ends[:, :-1], cutoffs, np.log(ratios), logarithmic_limits(tolerance)
    )
    of_all = _along_curves(ends[:, -1:], cutoffs, pooled, (-np.inf, tolerance))
    return np.concatenate([of_surfaces, of_all], axis=-1)


def _along_curves(
    ends: np.ndarray, cutoffs: np.ndarray, curves: np.ndarray, limits: tuple[float, float]
) -> np.ndarray:
    """Return where curves (n, side, group, cutoff), zero without a filter, leave their limits."""
    wavelengths = np.full(curves.shape[:3], np.nan)
    for n, s, g in np.ndindex(wavelengths.shape):
        known = np.flatnonzero(np.isfinite(curves[n, s, g]))
        order = known if ends[s, g] < cutoffs[0] else known[::-1]
        wavelengths[n, s, g] = critical_wavelength(
            np.append(ends[s, g], cutoffs[order]), np.append(0.0, curves[n, s, g, order]), limits
        )
    return wavelengths
