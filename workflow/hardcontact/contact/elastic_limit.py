"""Whether contacts yield, by the slope of the waves of a surface down to a shortest one.

Over an area on which their gap has the rms slope h', bodies press elastically with E* h'/k on
average: k = 1.67 of a smooth sphere, exactly; of a rough flat 1.6 (Persson, J. Chem. Phys. 115
(2001) 3840) to 2.5 (Bush, Gibson and Thomas, Wear 35 (1975) 87). The first is taken here. Contacts
yield where this exceeds the hardness.
"""

from collections.abc import Mapping

import numpy as np
import pandas as pd
import xarray as xr
from scipy.integrate import cumulative_trapezoid

from hardcontact.surfaces.spectrum import Spectrum

#: E* h' over the mean pressure of a smooth sphere: 3 pi/(4 sqrt(2)).
SLOPE_OVER_PRESSURE = 3 * np.pi / (4 * np.sqrt(2))


def pressure_over_hardness(
    spectra: Mapping[str, Spectrum], modulus: float, hardness: float
) -> xr.DataArray:
    """Return E* h'/(k H), h' the rms slope of all waves down to the shortest, from spectra.

    Over surface and shortest_wavelength (nm), rising; modulus and hardness are in Pa. h'² = 1/(2
    pi) ∫ q³ C_iso dq.
    """
    indices = []
    for spectrum in spectra.values():
        q = spectrum.wavevector
        squared = cumulative_trapezoid(q**4 * spectrum.density, np.log(q), initial=0) / (2 * np.pi)
        index = modulus * np.sqrt(squared) / (SLOPE_OVER_PRESSURE * hardness)
        wavelength = {"shortest_wavelength": 2 * np.pi / q}
        indices.append(xr.DataArray(index, wavelength, ["shortest_wavelength"]))
    named: xr.DataArray = xr.concat(indices, pd.Index(list(spectra), name="surface"))
    named["shortest_wavelength"].attrs = {"units": "nm"}
    return named.sortby("shortest_wavelength").assign_attrs(units="1")
