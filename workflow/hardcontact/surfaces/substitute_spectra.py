"""Spectra of substitutes from descriptions: bands of wavelengths, each with its model."""

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from hardcontact.surfaces import spectrum
from hardcontact.surfaces.calibration import (
    SELF_AFFINE_ROWS,
    TAIL_ROWS,
    Weights,
    calibrate_self_affine,
    calibrate_tail,
    expected_moments,
    transfer_weights,
)
from hardcontact.surfaces.spectrum import WAVEVECTORS, Spectrum
from hardcontact.surfaces.substitute_scans import scan_to_scan_spread

if TYPE_CHECKING:
    import xarray as xr

__all__ = ["PARAMETERS", "from_description", "substitute_spectrum"]

#: Columns of a description that hold numbers.
PARAMETERS = ("longest_nm", "shortest_nm", "plateau_nm4", "rolloff_nm", "hurst")


def from_description(
    path: str | Path, table1: pd.DataFrame, weights: Weights
) -> tuple[NDArray[np.float64], pd.DataFrame, list[str]]:
    """Return C_iso from the description of a surface, and what it was calibrated to.

    Parameters
    ----------
    path : str or Path
        CSV of bands from long to short wavelengths, each with its model, parameters and basis. A
        self-affine band or a power law without Hurst exponent is calibrated to Table 1.
    table1 : pandas.DataFrame
        Of `rows_of_surface`.
    weights : Weights
        Of `transfer_weights`.

    Returns
    -------
    density : numpy.ndarray
        In nm⁴ on WAVEVECTORS.
    bands : pandas.DataFrame
        The description with all parameters filled in.
    calibrated : list of str
        Rows of Table 1 that were used.

    Raises
    ------
    ValueError
        Naming the file and the band if one cannot be made.
    """
    bands = pd.read_csv(path).astype(dict.fromkeys(PARAMETERS, float))
    density, calibrated = np.zeros_like(WAVEVECTORS), list[str]()
    for i, band in bands.iterrows():
        try:
            filled, used = _calibrated(band, density, table1, weights)
            density += _band_density(filled, density, Path(path).parent)
        except (KeyError, ValueError, OSError) as error:
            raise ValueError(f"{path}: band from {band.longest_nm:g} nm: {error}") from None
        bands.loc[i] = filled
        calibrated += used
    return density, bands, calibrated


def _calibrated(
    band: pd.Series, above: NDArray[np.float64], table1: pd.DataFrame, weights: Weights
) -> tuple[pd.Series, list[str]]:
    """Return the band with its parameters filled in, and the rows of Table 1 that filled them."""
    if not pd.isna(band.hurst) or band.model not in ("self-affine", "power law"):
        return band, []
    if band.model == "self-affine":
        plateau, rolloff, hurst = calibrate_self_affine(table1, weights)
        values = {"plateau_nm4": plateau, "rolloff_nm": rolloff, "hurst": hurst}
        return pd.Series({**band, **values}), list(SELF_AFFINE_ROWS)
    gradient, half_laplacian = table1.loc[list(TAIL_ROWS), "value"]
    hurst, shortest = calibrate_tail(
        above, band.longest_nm, _level_above(band, above), (gradient, half_laplacian)
    )
    return pd.Series({**band, "hurst": hurst, "shortest_nm": shortest}), list(TAIL_ROWS)


def _level_above(band: pd.Series, above: NDArray[np.float64]) -> float:
    """Return C_iso at the shortest wavelength of the bands above this one."""
    return float(above[WAVEVECTORS < 2 * np.pi / band.longest_nm][-1])


def _band_density(band: pd.Series, above: NDArray[np.float64], folder: Path) -> NDArray[np.float64]:
    """Return C_iso of one band on WAVEVECTORS, zero outside it."""
    wavelength = 2 * np.pi / WAVEVECTORS
    inside = (wavelength <= band.longest_nm) & (wavelength > band.shortest_nm)
    if band.model == "self-affine":
        model = spectrum.self_affine(WAVEVECTORS, band.plateau_nm4, band.rolloff_nm, band.hurst)
    elif band.model == "smooth roll-off":
        model = spectrum.smooth_rolloff(WAVEVECTORS, band.plateau_nm4, band.rolloff_nm, band.hurst)
    elif band.model == "power law":
        relative = WAVEVECTORS * band.longest_nm / (2 * np.pi)
        model = _level_above(band, above) * relative ** (-2 - 2 * band.hurst)
    elif band.model == "profile":
        points = pd.read_csv(folder / band.table).astype({"wavelength_nm": float, "c1d_nm3": float})
        model = spectrum.profile_points(
            WAVEVECTORS, points["wavelength_nm"].to_numpy(), points["c1d_nm3"].to_numpy()
        )
    else:
        raise ValueError(
            "expected the model self-affine, smooth roll-off, profile or power law, "
            f"found {band.model!r}"
        )
    return np.where(inside, model, 0.0)


def substitute_spectrum(
    description: str | Path,
    table1: pd.DataFrame,
    constants: pd.DataFrame,
    skewness: float,
    rng: np.random.Generator,
) -> "xr.Dataset":
    """Return the spectrum of a substitute, with what its scans need beside it.

    Table 1 is for scans of the paper's pixels and size, not those of this study.

    Parameters
    ----------
    description : str or Path
        See `from_description`.
    table1 : pandas.DataFrame
        Of `rows_of_surface`; empty if the paper has no such surface.
    constants : pandas.DataFrame
        Of `published.constants`: pixels and size of the paper's scans.
    skewness : float
        Of the heights, kept as an attribute.
    rng : numpy.random.Generator
        Of the random surfaces from which the scan-to-scan spread is computed.

    Returns
    -------
    xarray.Dataset
        `spectrum` (wavevector) in nm⁴ as it is stored; attributes skewness, spread, the bands and
        what they were calibrated to.
    """
    window = int(constants["value"]["scan_pixels"])
    pixels, pixel_size = 4 * window, constants["value"]["scan_size"] / window
    weights = transfer_weights(pixels, pixel_size, window)
    density, bands, calibrated = from_description(description, table1, weights)
    table = Spectrum(WAVEVECTORS, density)
    spread = 0.0
    if "afm_rms_height" in table1.index:
        height = table1.loc[["afm_rms_height"]]
        relative = float((height["uncertainty"] / height["value"]).iloc[0])
        spread = scan_to_scan_spread(rng, pixels, pixel_size, window, table, relative)
    return spectrum.spectrum_dataset(density).assign_attrs(
        basis="substitute",
        calibrated_to_table1=",".join(calibrated),
        bands=bands.to_csv(index=False),
        skewness=skewness,
        spread=spread,
        expected_scan_moments=expected_moments(table, weights),
    )
