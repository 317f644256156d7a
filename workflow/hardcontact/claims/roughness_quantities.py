"""Numbers about roughness: of all scales over that of the AFM scans alone.

Each function returns a number as `numbers.number` does; in brackets its dimensions.
"""

import json

import xarray as xr

from hardcontact.claims.numbers import quotient, variable_as_number

__all__ = ["curvature_over_height", "slope_by_scales", "slope_over_height"]


def slope_by_scales(topography: xr.Dataset) -> xr.Dataset:
    """Return the rms slope of all scales over that of the AFM scans (surface)."""
    return _all_over_afm(topography, "slope")


def slope_over_height(topography: xr.Dataset) -> xr.Dataset:
    """Return `slope_by_scales` over the same ratio of the rms heights (surface)."""
    return quotient(_all_over_afm(topography, "slope"), _all_over_afm(topography, "height"))


def curvature_over_height(topography: xr.Dataset) -> xr.Dataset:
    """Return the ratio of rms curvatures over that of the rms heights (surface)."""
    return quotient(_all_over_afm(topography, "curvature"), _all_over_afm(topography, "height"))


def _all_over_afm(topography: xr.Dataset, quantity: str) -> xr.Dataset:
    """Return a row of Table 1 for all scales over that for the AFM scans."""
    names = json.loads(topography.attrs["table1_variables"])
    both = (names[f"{scales}_rms_{quantity}"] for scales in ("all", "afm"))
    return quotient(*(variable_as_number(topography, name) for name in both))
