"""The cutoffs at which one side of a filtered surface was computed."""

import numpy as np
import xarray as xr

__all__ = ["computed_cutoffs", "last_cutoff"]


def computed_cutoffs(values: xr.DataArray) -> np.ndarray:
    """Return the cutoffs (nm), growing, at which any value of one side is known.

    Parameters
    ----------
    values : xarray.DataArray (..., cutoff_wavelength)
        NaN at cutoffs of the other side.

    Returns
    -------
    numpy.ndarray
        In nm.
    """
    others = [dim for dim in values.dims if dim != "cutoff_wavelength"]
    known = values["cutoff_wavelength"].values[values.notnull().any(others).values]
    return np.sort(known)


def last_cutoff(values: xr.DataArray, side: str) -> float:
    """Return the cutoff of a side that removes most, which stands for all beyond it.

    Parameters
    ----------
    values : xarray.DataArray (..., cutoff_wavelength)
        NaN at cutoffs of the other side.
    side : str
        "small" or "large".

    Returns
    -------
    float
        In nm.
    """
    return float(computed_cutoffs(values)[-1 if side == "small" else 0])
