"""Whether contacts yield, from the slope of the waves of a surface down to a shortest one.

The mean pressure of elastic contact is E* h'/k, where h' is the rms slope of the gap over the area
of contact. For a smooth sphere, k = 1.67 exactly. For a rough flat it is 1.6 (Persson, J. Chem.
Phys. 115 (2001) 3840) to 2.5 (Bush, Gibson and Thomas, Wear 35 (1975) 87). The sphere's k is used.
Contacts yield if this pressure exceeds the hardness.
"""

from collections.abc import Mapping

import numpy as np
import pandas as pd
import xarray as xr
from scipy.integrate import cumulative_trapezoid

from hardcontact.surfaces.spectrum import Spectrum

#: The number k of a smooth sphere: E* h' relative to the mean pressure, 3 pi/(4 sqrt(2)).
SLOPE_OVER_PRESSURE = 3 * np.pi / (4 * np.sqrt(2))


def pressure_over_hardness(
    spectra: Mapping[str, Spectrum], modulus: float, hardness: float
) -> xr.DataArray:
    """Return the mean pressure of elastic contact relative to the hardness: E* h'/(k H).

    The rms slope h' of all waves down to the shortest follows from h'² = 1/(2 pi) ∫ q³ C_iso dq.

    spectra: spectrum by surface.
    modulus, hardness: effective modulus E* and hardness H in Pa.
    Returns (surface, shortest_wavelength), wavelengths in nm, ascending.
    """
    surface_ratios = []
    for spectrum in spectra.values():
        q = spectrum.wavevector
        squared_slope = cumulative_trapezoid(q**4 * spectrum.density, np.log(q), initial=0)
        slope = np.sqrt(squared_slope / (2 * np.pi))
        ratio = modulus * slope / (SLOPE_OVER_PRESSURE * hardness)
        wavelength = {"shortest_wavelength": 2 * np.pi / q}
        surface_ratios.append(xr.DataArray(ratio, wavelength, ["shortest_wavelength"]))
    ratios: xr.DataArray = xr.concat(surface_ratios, pd.Index(list(spectra), name="surface"))
    ratios["shortest_wavelength"].attrs = {"units": "nm"}
    return ratios.sortby("shortest_wavelength").assign_attrs(units="1")
