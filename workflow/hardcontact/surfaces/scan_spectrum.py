"""The spectrum of scans as programs and predictions use it: C_iso, and the scans it comes from."""

from dataclasses import dataclass

import numpy as np
import xarray as xr

from hardcontact.surfaces.spectrum import Spectrum, spectrum_of_dataset


@dataclass(frozen=True, eq=False, repr=False)
class ScanSpectrum(Spectrum):
    """C_iso in nm⁴ of the scans of a surface, over growing wavevectors in rad/nm.

    joined: from `joined_spectrum`: the spectrum over all scales, and where each scan is reliable.
    skewness: the largest skewness of the heights of a map; 0 without a map.
    is_extrapolated: whether C_iso goes on beyond the reliable wavelengths of the scans.
    """

    joined: xr.Dataset
    skewness: float
    is_extrapolated: bool

    def measured(self) -> "ScanSpectrum":
        """Return C_iso at the reliable wavelengths alone."""
        return reliable_spectrum(self.joined, self.skewness)

    def extrapolated(self) -> "ScanSpectrum":
        """Return C_iso extrapolated beyond the reliable wavelengths, as in spectra of masters."""
        spectrum = spectrum_of_dataset(self.joined)
        return ScanSpectrum(
            spectrum.wavevector, spectrum.density, self.joined, self.skewness, is_extrapolated=True
        )


def reliable_spectrum(joined: xr.Dataset, skewness: float) -> ScanSpectrum:
    """Return the spectrum of `joined_spectrum` at the reliable wavelengths of the scans.

    The skewness is the largest of the heights of a map, 0 without a map.
    """
    is_measured = np.isfinite(joined.joined_psd.values)
    return ScanSpectrum(
        joined.bin_wavevector.values[is_measured],
        joined.joined_psd.values[is_measured],
        joined,
        skewness,
        is_extrapolated=False,
    )
