"""Indices of slopes that grow from surface to surface."""

import xarray as xr

from figure_inputs.building import named


def elastic_limit() -> xr.Dataset:
    """Return indices that fall with the root of the shortest wavelength."""
    wavelengths = xr.Variable("shortest_wavelength", [0.1, 1.0, 10.0, 100.0])
    slope = xr.Variable("surface", [0.1, 1.0, 2.0, 4.0]) * wavelengths**-0.5
    index = xr.DataArray(slope, {"shortest_wavelength": wavelengths})
    return named().assign(slope_index=index)
