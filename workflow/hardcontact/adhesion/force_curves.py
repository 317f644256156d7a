"""Mean pull-off forces against the range of adhesion, of all scans and of resampled ones."""

from typing import Any

import numpy as np
import xarray as xr
from scipy.interpolate import make_interp_spline

from hardcontact.adhesion.bootstrap import Bootstrap
from hardcontact.statistics import resampling_counts

__all__ = ["at_range", "force_curves", "mean_forces", "on_fine_grid", "resampled_means"]


def mean_forces(forces: xr.DataArray, bootstrap: Bootstrap) -> tuple[np.ndarray, np.ndarray]:
    """Average forces over all scans, and over resampled ones.

    Parameters
    ----------
    forces : xarray.DataArray (surface, scan, sphere_scan, rho, contact_y, contact_x)
        In N, NaN where a scan is missing.
    bootstrap : Bootstrap
        How scans are resampled.

    Returns
    -------
    means : ndarray (surface, rho)
        In N.
    sampled : ndarray (sample, surface, rho)
        In N.
    """
    pairs = forces.mean(["contact_y", "contact_x"]).values
    scans = np.isfinite(pairs).any(axis=(2, 3))
    spheres = np.isfinite(pairs).any(axis=(0, 1, 3))
    rng, samples = bootstrap.generator("adhesion"), bootstrap.samples
    drawn = np.stack([resampling_counts(rng, known, samples) for known in scans], axis=1)
    drawn_spheres = resampling_counts(rng, spheres, samples)
    once = scans[None].astype(float), spheres[None].astype(float)
    return resampled_means(pairs, *once)[0], resampled_means(pairs, drawn, drawn_spheres)


def resampled_means(
    pair_means: np.ndarray, substrate_counts: np.ndarray, sphere_counts: np.ndarray
) -> np.ndarray:
    """Average forces over resampled scans.

    Parameters
    ----------
    pair_means : ndarray (surface, scan, sphere_scan, rho)
        Each a mean over the contacts of one pair, NaN where a surface has no such scan.
    substrate_counts : ndarray (sample, surface, scan)
        How often each scan is drawn.
    sphere_counts : ndarray (sample, sphere_scan)
        Likewise.

    Returns
    -------
    ndarray (sample, surface, rho)
        In the unit of `pair_means`.
    """
    total = np.einsum(
        "nsi,nj,sijr->nsr",
        substrate_counts,
        sphere_counts,
        np.nan_to_num(pair_means),
        optimize=True,
    )
    weight = substrate_counts.sum(axis=2) * sphere_counts.sum(axis=1)[:, None]
    means: np.ndarray = total / weight[:, :, None]
    return means


def force_curves(
    forces: xr.DataArray,
    means: np.ndarray,
    sampled: np.ndarray,
    reference: int,
    bootstrap: Bootstrap,
) -> dict[str, Any]:
    """Return mean forces, their ratios to a reference surface, and the spread over contacts.

    Parameters
    ----------
    forces : xarray.DataArray (surface, scan, sphere_scan, rho, contact_y, contact_x)
        In N, NaN where a scan is missing.
    means : ndarray (surface, rho)
        As from `mean_forces`, in N.
    sampled : ndarray (sample, surface, rho)
        Likewise.
    reference : int
        Index of the surface.
    bootstrap : Bootstrap
        Its confidence is that of the intervals.

    Returns
    -------
    dict
        Variables over surface and rho, ready for `xarray.Dataset`.
    """
    dimensions, newton, one = ("surface", "rho"), {"units": "N"}, {"units": "1"}
    ratio, ratios = means / means[reference], sampled / sampled[:, [reference]]
    spread = forces.std(["scan", "sphere_scan", "contact_y", "contact_x"]).values
    return {
        "contact_spread": (dimensions, spread, newton),
        "ratio_contact_spread": (dimensions, spread / means[reference], one),
        **bootstrap.with_interval("mean_force", dimensions, means, sampled, newton),
        **bootstrap.with_interval("ratio", dimensions, ratio, ratios, one),
    }


def on_fine_grid(forces: np.ndarray, rhos: np.ndarray, fine: np.ndarray) -> np.ndarray:
    """Return forces (..., rho) on a fine grid of rho, by a cubic spline in log F and log rho."""
    degree = min(3, len(rhos) - 1)
    spline = make_interp_spline(np.log(rhos), np.log(forces), k=degree, axis=-1)
    return np.exp(spline(np.log(fine)))


def at_range(forces: xr.DataArray, rho: float) -> xr.DataArray:
    """Return forces (..., rho, ...) at one rho in nm: linear in log F and log rho."""
    logarithms = xr.apply_ufunc(np.log, forces).assign_coords(rho=np.log(forces.rho.values))
    interpolated: xr.DataArray = xr.apply_ufunc(np.exp, logarithms.interp(rho=np.log(rho)))
    return interpolated
