"""Power spectral densities: tables, their moments, what is measured of scans.

Conventions: C_iso = |h~|²/A in nm⁴ with h_rms² = 1/(2 pi) ∫ q C_iso dq, and C_1D = |h~|²/L in nm³
with h_rms² = (1/pi) ∫ C_1D dq; q = 2 pi/lambda in rad/nm. Source: Jacobs, Junge, Pastewka,
Surf. Topogr.: Metrol. Prop. 5 (2017) 013001.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from hardcontact.records import dataset
from hardcontact.surfaces.height_map import HeightMap, library_map

if TYPE_CHECKING:
    from SurfaceTopography import Topography, UniformLineScan

Floats = NDArray[np.float64]
#: C_iso in nm⁴ as a function of wavevectors in rad/nm, of any shape.
Density = Callable[[Floats], Floats]
#: The grid on which joined spectra are tabulated: 40 points a decade, wavelengths 1 mm to 0.1 nm.
WAVEVECTORS = 2 * np.pi * np.logspace(-6, 1, 281)
#: Edges and centres of the bins of measured PSDs: ten a decade.
BIN_EDGES = 2 * np.pi * np.logspace(-5, 1, 61)
BIN_CENTRES = np.sqrt(BIN_EDGES[1:] * BIN_EDGES[:-1])
#: Bins in half a decade.
HALF_DECADE = 5
#: How SurfaceTopography measures PSDs.
MEASURED = {"window": "hann", "reliable": False, "collocation": BIN_EDGES}


@dataclass(frozen=True, eq=False)
class Spectrum:
    """C_iso (points,) in nm⁴ over growing wavevectors (points,) in rad/nm, called as a function."""

    wavevector: Floats
    density: Floats

    def __call__(self, wavevector: ArrayLike) -> Floats:
        """Return C_iso in nm⁴ at wavevectors in rad/nm by interpolation in log q and log C.

        It is constant below the table, zero above it and where the table is zero.
        """
        log_density = np.log(np.maximum(self.density, 1e-290))
        with np.errstate(divide="ignore"):
            log_wavevector = np.log(wavevector)
        log_table = np.log(self.wavevector)
        return np.exp(np.interp(log_wavevector, log_table, log_density, right=-np.inf))


def read_spectrum(path: str) -> Spectrum:
    """Read a spectrum that the study wrote; a file that cannot be read is a ValueError."""
    return spectrum_from(dataset.read(path))


def spectrum_from(stored: xr.Dataset) -> Spectrum:
    """Return a spectrum that `spectrum_dataset` holds."""
    return Spectrum(stored["wavevector"].values, stored["spectrum"].values)


def spectrum_dataset(density: Floats) -> xr.Dataset:
    """Return C_iso (nm⁴) on WAVEVECTORS as it is stored."""
    return xr.Dataset(
        {"spectrum": ("wavevector", density, {"units": "nm4", "long_name": "isotropic PSD"})},
        {"wavevector": ("wavevector", WAVEVECTORS, {"units": "rad nm-1"})},
    )


def with_measurements(
    spectrum: xr.Dataset,
    psds: Floats,
    reliable: NDArray[np.bool_],
    measurements: Sequence[Mapping[str, Any]],
) -> xr.Dataset:
    """Return a spectrum with what it was joined of.

    The PSDs (measurement, bins) are in nm⁴; of each measurement there are words, lengths in nm.
    """
    of_each = {
        name: (
            "measurement",
            [one[name] for one in measurements],
            {} if isinstance(value, str) else {"units": "nm"},
        )
        for name, value in measurements[0].items()
    }
    both, axis = ("measurement", "bin_wavevector"), "bin_wavevector"
    return (
        spectrum.assign(psd=(both, psds, {"units": "nm4", "long_name": "isotropic PSD"}))
        .assign(reliable=(both, reliable.astype("int8"), {"long_name": "1 where it is reliable"}))
        .assign(of_each)
        .assign_coords({axis: (axis, BIN_CENTRES, {"units": "rad nm-1"})})
    )


def measured_psds(scan: HeightMap) -> tuple[Floats, Floats, Floats]:
    """Return power spectral densities of a scan, measured with a Hann window.

    Parameters
    ----------
    scan : HeightMap
        Levelled.

    Returns
    -------
    wavevector : numpy.ndarray
        (bins,) rad/nm, ten a decade.
    profile, isotropic : numpy.ndarray
        (bins,) C_1D along x in nm³ and C_iso in nm⁴, NaN in empty bins.

    Examples
    --------
    >>> scan = hc.read_scan("scan.nc")
    >>> wavevector, profile, isotropic = hc.measured_psds(scan)
    """
    topography = library_map(scan)
    isotropic = topography.power_spectrum_from_area(**MEASURED)[1]
    return BIN_CENTRES, profile_psd(topography), _without_empty_bins(isotropic)


def profile_psd(topography: "Topography | UniformLineScan") -> Floats:
    """Return C_1D along x (bins,) in nm³, measured with a Hann window; NaN in empty bins."""
    return _without_empty_bins(topography.power_spectrum_from_profile(**MEASURED)[1])


def _without_empty_bins(density: ArrayLike) -> Floats:
    """Return a PSD with NaN in bins without wavevectors, for which SurfaceTopography gives 0."""
    values = np.asarray(density, float)
    return np.where(values > 0, values, np.nan)


def all_scales_moments(spectrum: Spectrum) -> Floats:
    """Return rms height (nm), gradient and half-Laplacian (1/nm) of a spectrum, all scales."""
    wavevector = spectrum.wavevector
    height, gradient, laplacian = (
        np.trapezoid(spectrum.density * wavevector**n * wavevector, np.log(wavevector))
        for n in (1, 3, 5)
    )
    return np.sqrt(np.array([height, gradient, laplacian / 4]) / (2 * np.pi))


def roll_off(spectrum: Spectrum) -> float:
    """Return the wavelength (nm) whose octave holds most of the variance of heights."""
    variance = spectrum.wavevector**2 * spectrum.density
    return float(2 * np.pi / spectrum.wavevector[variance.argmax()])
