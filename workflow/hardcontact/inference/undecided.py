"""What the scans leave open about the range of adhesion, in words."""

import numpy as np
import xarray as xr

from hardcontact.statistics import bounds

__all__ = ["undecided"]


def undecided(inferred: xr.Dataset, threshold: float) -> str:
    """Return the limits of what the scans say about the range of adhesion, in one sentence.

    Parameters
    ----------
    inferred : xarray.Dataset
        Of one contact model: best_error, the minima, range_of_adhesion with its interval, rho.
    threshold : float
        Of the mean relative error.

    Returns
    -------
    str
        Without what the interval says if there is none.
    """
    error = float(inferred.best_error)
    limits = []
    if error >= threshold:
        limits.append(
            f"no range and work of adhesion bring the mean relative error below "
            f"{threshold:g} (least {error:.2f})"
        )
    minima = inferred[["minimum_range", "minimum_error"]].dropna("minimum")
    if minima.sizes["minimum"] > 1:
        both = zip(minima.minimum_range.values, minima.minimum_error.values, strict=True)
        places = [f"{rho:.3g} nm ({least:.2f})" for rho, least in both]
        limits.append(f"the error has several minima: {', '.join(places)}")
    return "; ".join(limits + _limits_of_interval(inferred))


def _limits_of_interval(inferred: xr.Dataset) -> list[str]:
    """Return what the interval of the range leaves open; nothing where there is no interval."""
    low, high = (float(end) for end in bounds(inferred, "range_of_adhesion"))
    least, greatest = (float(inferred.rho[end]) for end in (0, -1))
    if not np.isfinite(low):
        return []
    limits = []
    if high >= 0.99 * greatest:
        limits.append(
            f"the interval reaches the largest range computed, {greatest:g} nm: "
            "there is no upper bound"
        )
    if low <= 1.02 * least:
        limits.append(
            f"the interval reaches the smallest range computed, {least:g} nm: "
            "there is no lower bound"
        )
    limits.append(
        f"ranges of adhesion between {low:.2g} and {high:.2g} nm cannot be told apart "
        "by these scans"
    )
    return limits
