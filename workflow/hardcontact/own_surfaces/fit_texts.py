"""What measured forces say about range and work of adhesion, in words."""

import numpy as np
import xarray as xr

from hardcontact.own_surfaces.scan_parts import Parts

__all__ = ["fit_note", "fit_text"]


def fit_note(parts: Parts, tests: int) -> str:
    """Return what the interval of the work of adhesion of one surface comes from."""
    if tests < 2:
        return "no interval: the scatter of a single test is unknown"
    return f"{tests} tests; computed forces: {parts.note()}"


def fit_text(fitted: xr.Dataset) -> str:
    """Return what the forces allow, in one sentence.

    Parameters
    ----------
    fitted : xarray.Dataset
        Of one contact model: work_of_adhesion (surface, rho), best fit and region.

    Returns
    -------
    str
        Energies in mJ/m².
    """
    if fitted.sizes["surface"] == 1:
        return "one mean force: every range of adhesion has its own work of adhesion"
    best = (
        f"range {float(fitted.best_range):.2g} nm, "
        f"work {1e3 * float(fitted.best_work):.2g} mJ/m² "
        f"(mean relative error {float(fitted.best_error):.2g})"
    )
    if fitted.work_of_adhesion_interval.isnull().any():
        return f"{best}; no region: a surface has no interval"
    allowed = np.isfinite(fitted.region.values).all(axis=-1)
    if not allowed.any():
        return f"no range and work of adhesion agree with all forces; nearest: {best}"
    return f"{best}; region: {_range_text(fitted)}{_gap_text(fitted.rho.values, allowed)}"


def _range_text(fitted: xr.Dataset) -> str:
    """Return the extent of the region in words."""
    least, greatest = (float(fitted.rho[end]) for end in (0, -1))
    low, high = fitted.region_range.values
    limits = [
        f"{low:.2g} nm" if np.isfinite(low) else f"below {least:.2g} nm, the least computed,",
        f"{high:.2g} nm"
        if np.isfinite(high)
        else f"above {greatest:.2g} nm, the greatest computed",
    ]
    text = f"ranges from {' to '.join(limits)}"
    low, high = 1e3 * fitted.region_work.values
    return f"{text}, works from {low:.2g} to {high:.2g} mJ/m²" if np.isfinite(low) else text


def _gap_text(rho: np.ndarray, allowed: np.ndarray) -> str:
    """Return between which ranges the region has gaps, in words."""
    change = np.diff(allowed.astype(int))
    ends, begins = np.flatnonzero(change == -1), np.flatnonzero(change == 1) + 1
    begins = begins[begins > ends[0]] if len(ends) else begins[:0]
    gaps = [
        f"{rho[end]:.2g} and {rho[begin]:.2g} nm" for end, begin in zip(ends, begins, strict=False)
    ]
    return f", but none between {' nor between '.join(gaps)}" if gaps else ""
