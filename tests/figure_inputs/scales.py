"""Datasets of scales of roughness: critical band, single realizations."""

import numpy as np
import xarray as xr
from paper_numbers import SUBSTRATES

from figure_inputs.building import bounded, generator, named

REALIZATIONS = 5
SMALL_CUTOFFS = np.array([20.0, 30, 36, 43, 52, 62, 80, 120, 250])
LARGE_CUTOFFS = np.array([500.0, 800, 1100, 1400, 1600, 1800, 2000, 2300, 2700, 3500])
CUTOFFS = np.array([*SMALL_CUTOFFS, *LARGE_CUTOFFS])
SIDES = ["small", "large"]
TOLERANCE = 0.1
#: Where the force of each surface leaves the tolerance, in nm by side; once never among CUTOFFS.
EDGES = np.array([[160.0, 32, 45, 95], [400, 1950, 2360, 1860]])
#: The same of each group, NaN where it never does, as the dataset of the study has it.
CRITICAL = np.array([[160.0, 32, 45, 95, 60], [np.nan, 1950, 2360, 1860, 5000 / 3]])
RATIO_DIMS = ("side", "surface", "cutoff_wavelength")
CHANGE_DIMS = ("side", "group", "cutoff_wavelength")


def ratios(edges: np.ndarray) -> np.ndarray:
    """Return ratio curves (..., side, surface, cutoff) that leave the tolerance at edges (nm)."""
    small, large = edges[..., 0, :, None], edges[..., 1, :, None]
    rising = 1 + TOLERANCE * (CUTOFFS / small) ** 1.2
    rising[..., ~np.isin(CUTOFFS, SMALL_CUTOFFS)] = np.nan
    falling = 1 + TOLERANCE * (large / CUTOFFS) ** 1.2
    falling[..., ~np.isin(CUTOFFS, LARGE_CUTOFFS)] = np.nan
    return np.stack([rising, falling], axis=-3)


def changes(ratio: np.ndarray) -> np.ndarray:
    """Return |ratio - 1| of each surface and its mean over them, (..., side, group, cutoff)."""
    change = abs(ratio - 1)
    return np.concatenate([change, change.mean(axis=-2, keepdims=True)], axis=-2)


def critical_wavelengths(change: np.ndarray) -> np.ndarray:
    """Return where changes (..., side, group, cutoff) reach the tolerance (nm), NaN if nowhere."""
    critical = np.full(change.shape[:-1], np.nan)
    for *place, side, group in np.ndindex(critical.shape):
        curve = change[(*place, side, group)]
        order = np.argsort(curve)[: np.isfinite(curve).sum()]
        if curve[order[-1]] > TOLERANCE:
            logarithm = np.interp(TOLERANCE, curve[order], np.log(CUTOFFS[order]))
            critical[(*place, side, group)] = np.exp(logarithm)
    return critical


def band() -> xr.Dataset:
    """Return ratio curves that leave the tolerance but for one, NaN where a side has no cutoff."""
    ratio = ratios(EDGES)
    change = changes(ratio)
    return (
        named()
        .assign_coords(side=SIDES, group=[*SUBSTRATES, "pooled"], cutoff_wavelength=CUTOFFS)
        .assign(
            bounded("scale_ratio", RATIO_DIMS, ratio, 0.95, 1.05)
            | bounded("scale_change", CHANGE_DIMS, change, 0.5, 1.5)
            | bounded("critical_wavelength", ("side", "group"), CRITICAL, 0.7, 1.5, "nm")
        )
        .assign_attrs(scale_tolerance=TOLERANCE, confidence=0.9)
    )


def scales() -> xr.Dataset:
    """Return single realizations about the curves of `band`."""
    scatter = xr.DataArray(generator().lognormal(0, 0.15, REALIZATIONS), dims="realization")
    realization = np.arange(1, REALIZATIONS + 1)
    return (
        named()
        .assign(ratio=band()["scale_ratio"] ** scatter)
        .assign_coords(realization=realization)
        .assign(transition=("side", [20.0, 1000.0]))
        .assign_attrs(rho=5.6)
    )
