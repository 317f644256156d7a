"""Power spectral densities (PSDs): tables, rms values of tables, and PSDs of scans.

- C_iso = |h~|²/A in nm⁴ of a map, with h_rms² = 1/(2 pi) ∫ q C_iso dq;
- C_1D = |h~|²/L in nm³ of profiles along a line, with h_rms² = (1/pi) ∫ C_1D dq.

Wavevectors q = 2 pi/lambda are in rad/nm. Source: Jacobs, Junge, Pastewka, Surf. Topogr.: Metrol.
Prop. 5 (2017) 013001.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from hardcontact.base.arrays import Floats
from hardcontact.base.dataset import read_dataset
from hardcontact.base.formatting import format_length
from hardcontact.base.units import NM4, RAD_PER_NM
from hardcontact.surfaces.height_map import HeightMap, to_surface_topography

if TYPE_CHECKING:
    from matplotlib.axes import Axes

#: A function that returns C_iso at wavevectors of any shape.
SpectrumFunction = Callable[[Floats], Floats]
#: Wavevectors (rad/nm) of tables: 40 points a decade, wavelengths 1 mm to 0.1 nm.
WAVEVECTORS = 2 * np.pi * np.logspace(-6, 1, 281)
LOG_WAVEVECTORS = np.log(WAVEVECTORS)
#: Edges (rad/nm) of the bins of measured PSDs: ten a decade, 100 µm to 0.1 nm.
BIN_EDGES = 2 * np.pi * np.logspace(-5, 1, 61)
BIN_CENTRES = np.sqrt(BIN_EDGES[1:] * BIN_EDGES[:-1])
#: Width of a bin in ln q.
BIN_WIDTH = float(np.log(BIN_EDGES[1] / BIN_EDGES[0]))
#: Bins in half a decade.
HALF_DECADE_BINS = 5
#: Fewest bins of a spectrum from scans: a slope with an error needs three.
MIN_BINS = 3
#: Arguments of SurfaceTopography for all wavelengths; reliable ones: `scans.reliable_wavelengths`.
PSD_ARGUMENTS = {"window": "hann", "reliable": False, "collocation": BIN_EDGES}


def too_few_bins_message(noun: str, count: int, lines: Iterable[str]) -> str:
    """Return the message that scans, named by a noun, are reliable in fewer than MIN_BINS bins."""
    return (
        f"expected {noun} that are reliable in at least {MIN_BINS} bins of wavelengths (ten a "
        f"decade from 0.1 nm to 100 µm), found {count}: {'; '.join(lines)}"
    )


@dataclass(frozen=True, eq=False)
class Spectrum:
    """A table of C_iso over wavevectors, which a call interpolates."""

    wavevector: Floats  #: Growing wavevectors (points,) in rad/nm.
    density: Floats  #: C_iso (points,) in nm⁴.

    @property
    def wavelength(self) -> Floats:
        """The wavelengths (points,) in nm, the longest first."""
        return 2 * np.pi / self.wavevector

    def __repr__(self) -> str:
        """Return the number of wavelengths, the shortest and the longest."""
        longest, shortest = self.wavelength[[0, -1]]
        return (
            f"Spectrum({len(self.wavevector)} wavelengths from {format_length(shortest)} to "
            f"{format_length(longest)})"
        )

    def plot(self, axes: "Axes | None" = None) -> "Axes":
        """Draw C_iso in nm⁴ over wavelengths in nm, in new axes if none are given."""
        import matplotlib.pyplot as plt

        axes = plt.subplots()[1] if axes is None else axes
        axes.loglog(self.wavelength, self.density)
        axes.set(xlabel="wavelength (nm)", ylabel="power spectral density (nm⁴)")
        return axes

    def __call__(self, wavevector: ArrayLike) -> Floats:
        """Return C_iso in nm⁴ at wavevectors in rad/nm by interpolation in log q and log C.

        C_iso is constant above the longest wavelength, and zero below the shortest one.
        """
        log_density = np.log(np.maximum(self.density, 1e-290))  # Zero has no logarithm.
        with np.errstate(divide="ignore"):
            log_wavevector = np.log(wavevector)
        log_table = np.log(self.wavevector)
        return np.exp(np.interp(log_wavevector, log_table, log_density, right=-np.inf))


def nearest_bin(wavelength: float) -> int:
    """Return the index of the bin of measured PSDs that is nearest to a wavelength (nm)."""
    return int(np.abs(np.log(BIN_CENTRES * wavelength / (2 * np.pi))).argmin())


def load_spectrum(path: str) -> Spectrum:
    """Load a spectrum from a file of the study; raises ValueError if it is unreadable."""
    return spectrum_of_dataset(read_dataset(path))


def spectrum_of_dataset(spectrum_data: xr.Dataset) -> Spectrum:
    """Return the spectrum in a dataset that `spectrum_dataset` made."""
    return Spectrum(spectrum_data["wavevector"].values, spectrum_data["spectrum"].values)


def spectrum_dataset(density: Floats) -> xr.Dataset:
    """Return C_iso (nm⁴) on WAVEVECTORS as a dataset: ``spectrum`` (wavevector)."""
    return xr.Dataset(
        {"spectrum": ("wavevector", density, NM4 | {"long_name": "C_iso"})},
        {"wavevector": ("wavevector", WAVEVECTORS, RAD_PER_NM)},
    )


def measured_psds(scan: HeightMap) -> tuple[Floats, Floats, Floats]:
    """Return the power spectral densities of a map at all its wavelengths, with a Hann window.

    Parameters
    ----------
    scan : HeightMap
        A levelled map.

    Returns
    -------
    wavevector : numpy.ndarray
        Centres (bins,) of the bins in rad/nm, ten a decade.
    profile : numpy.ndarray
        C_1D (bins,) along x in nm³, NaN in empty bins.
    isotropic : numpy.ndarray
        C_iso (bins,) in nm⁴, NaN in empty bins.

    Examples
    --------
    >>> scan = hc.read_scan("scan.nc")
    >>> wavevector, profile, isotropic = hc.measured_psds(scan)
    """
    isotropic = to_surface_topography(scan).power_spectrum_from_area(**PSD_ARGUMENTS)[1]
    return BIN_CENTRES, profile_psd(scan), _mark_empty_bins(isotropic)


def profile_psd(scan: HeightMap) -> Floats:
    """Return C_1D along x (bins,) in nm³, measured with a Hann window; NaN in empty bins."""
    profile = to_surface_topography(scan).power_spectrum_from_profile(**PSD_ARGUMENTS)[1]
    return _mark_empty_bins(profile)


def _mark_empty_bins(density: ArrayLike) -> Floats:
    """Return a PSD with NaN in empty bins, where SurfaceTopography has 0."""
    density = np.asarray(density, float)
    return np.where(density > 0, density, np.nan)


def spectral_moment(spectrum: Spectrum, order: int) -> float:
    """Return (1/2 pi) ∫ q^(1 + order) C_iso dq: the squared rms height if the order is 0."""
    q = spectrum.wavevector
    integrand = spectrum.density * q ** (1 + order)
    return float(np.trapezoid(integrand * q, np.log(q)) / (2 * np.pi))


def all_scales_rms(spectrum: Spectrum) -> Floats:
    """Return rms height (nm), gradient and half-Laplacian (1/nm) over all scales: (3,)."""
    moments = [spectral_moment(spectrum, order) for order in (0, 2, 4)]
    return np.sqrt(np.array(moments) / [1, 1, 4])


def peak_wavelength(spectrum: Spectrum) -> float:
    """Return the wavelength (nm) of the largest q² C_iso: the roll-off of a self-affine surface."""
    return float(spectrum.wavelength[(spectrum.wavevector**2 * spectrum.density).argmax()])
