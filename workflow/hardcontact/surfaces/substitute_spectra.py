"""Spectra of substitutes from descriptions: bands of wavelengths, each with its model."""

import io
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from hardcontact.surfaces import spectral_models
from hardcontact.surfaces.calibration import (
    Weights,
    calibrate_self_affine,
    calibrate_tail,
    calibrate_varying_hurst,
    expected_moments,
    transfer_weights,
)
from hardcontact.surfaces.descriptions import (
    CALIBRATED,
    KNOWN,
    PARAMETERS,
    TAIL_ROWS,
    is_calibrated,
)
from hardcontact.surfaces.spectrum import (
    BIN_CENTRES,
    WAVEVECTORS,
    Spectrum,
    all_scales_moments,
    spectrum_dataset,
    spectrum_from,
)

if TYPE_CHECKING:
    import xarray as xr

Floats = NDArray[np.float64]


def from_description(
    path: str | Path, table1: pd.DataFrame, weights: Weights
) -> tuple[Floats, pd.DataFrame, list[str]]:
    """Return C_iso (nm⁴) on WAVEVECTORS, its bands with all parameters, rows of Table 1 used.

    The file is a CSV of bands from long to short wavelengths, each with its model, parameters and
    basis. A band of CALIBRATED without Hurst exponent is calibrated to Table 1 (of
    `rows_of_surface`). A band that cannot be made is a ValueError that names it and the file.
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
    last = bands.iloc[-1]
    if last.model == "power law":
        density *= spectral_models.share_of_cells(last.shortest_nm)
    return density, bands, calibrated


def described_rms_height(path: str | Path, longest: float) -> float:
    """Return the rms height (nm) of the waves up to a wavelength (nm), from a description alone.

    A ValueError is that of `from_description`, or says that parameters are left to Table 1.
    """
    if is_calibrated(pd.read_csv(path)):
        raise ValueError(f"{path}: expected all parameters, found some to calibrate to Table 1")
    nothing = np.empty(0)
    density, _, _ = from_description(path, pd.DataFrame(), (nothing, np.empty((3, 0))))
    short_enough = 2 * np.pi / WAVEVECTORS <= longest
    return float(all_scales_moments(Spectrum(WAVEVECTORS, density * short_enough))[0])


def _calibrated(
    band: pd.Series, above: Floats, table1: pd.DataFrame, weights: Weights
) -> tuple[pd.Series, list[str]]:
    """Return the band with its parameters filled in, and the rows of Table 1 that filled them."""
    if not pd.isna(band.hurst) or band.model not in CALIBRATED:
        return band, []
    filled = band.copy()
    if band.model == "self-affine":
        filled[["plateau_nm4", "rolloff_nm", "hurst"]] = calibrate_self_affine(table1, weights)
    elif band.model == "varying Hurst":
        filled[["plateau_nm4", "hurst", "hurst_change"]] = calibrate_varying_hurst(
            table1, weights, band.rolloff_nm
        )
    else:
        gradient, half_laplacian = table1.loc[list(TAIL_ROWS), "value"]
        filled[["hurst", "shortest_nm"]] = calibrate_tail(above, (gradient, half_laplacian))
    return filled, list(CALIBRATED[band.model])


def _band_density(band: pd.Series, above: Floats, folder: Path) -> Floats:
    """Return C_iso of one band on WAVEVECTORS, zero outside it."""
    if band.model == "power law":
        reached = spectral_models.share_of_cells(band.shortest_nm) > 0
        return spectral_models.continued(above, band.hurst) * reached
    shape = band.plateau_nm4, band.rolloff_nm
    if band.model == "self-affine":
        model = spectral_models.self_affine(WAVEVECTORS, *shape, band.hurst)
    elif band.model == "varying Hurst":
        model = spectral_models.varying_hurst(WAVEVECTORS, *shape, (band.hurst, band.hurst_change))
    elif band.model == "smooth roll-off":
        model = spectral_models.smooth_rolloff(WAVEVECTORS, *shape, band.hurst)
    elif band.model == "profile":
        points = pd.read_csv(folder / band.table).astype({"wavelength_nm": float, "c1d_nm3": float})
        model = spectral_models.profile_points(
            WAVEVECTORS, points["wavelength_nm"].to_numpy(), points["c1d_nm3"].to_numpy()
        )
    else:
        raise ValueError(
            "expected the model self-affine, varying Hurst, smooth roll-off, profile or power law, "
            f"found {band.model!r}"
        )
    wavelength = 2 * np.pi / WAVEVECTORS
    return np.where((wavelength <= band.longest_nm) & (wavelength > band.shortest_nm), model, 0.0)


def substitute_spectrum(
    description: str | Path, table1: pd.DataFrame, constants: pd.DataFrame
) -> "xr.Dataset":
    """Return the spectrum of a substitute from a description, as of `from_description`.

    Table 1, of `rows_of_surface` or empty, is for scans of the paper's pixels and size, which the
    constants have, not those of this study. `spectrum` (wavevector) is in nm⁴ as it is stored;
    attributes are the bands, the rows of Table 1 that they were calibrated to, and the moments
    expected of one of the paper's scans.
    """
    window = int(constants["value"]["scan_pixels"])
    weights = transfer_weights(4 * window, constants["value"]["scan_size"] / window, window)
    density, bands, calibrated = from_description(description, table1, weights)
    return spectrum_dataset(density).assign_attrs(
        basis="substitute",
        calibrated_to_table1=",".join(calibrated),
        bands=bands.to_csv(index=False),
        expected_scan_moments=expected_moments(Spectrum(WAVEVECTORS, density), weights),
    )


class _Run(NamedTuple):
    """Neighbouring known bands of one source: their wavelengths in nm."""

    longest: float
    shortest: float
    source: str


def described_spectrum(stored: "xr.Dataset", path: str) -> "xr.Dataset":
    """Return a stored `substitute_spectrum` as `joined_spectrum` returns that of a measurement.

    Its known bands stand for measurements, neighbours of one source for one: nothing was measured
    here, but they were fitted to measurements, and their wavelengths are not artificial. What only
    a measurement has is NaN or empty. The path is that of the description; a ValueError of one line
    tells that no band is known.
    """
    bands = pd.read_csv(io.StringIO(stored.attrs["bands"]))
    runs = _runs(bands)
    if not runs:
        raise ValueError(f"{path}: expected a band that is {' or '.join(KNOWN)}, found none")
    wavelength, density = 2 * np.pi / BIN_CENTRES, spectrum_from(stored)(BIN_CENTRES)
    reliable = np.array([(run.shortest < wavelength) & (wavelength <= run.longest) for run in runs])
    nm4, nm, unknown = {"units": "nm4"}, {"units": "nm"}, np.full(len(runs), np.nan)
    both, along = ("measurement", "bin_wavevector"), "measurement"
    return (
        stored[["spectrum"]]
        .assign_coords(bin_wavevector=("bin_wavevector", BIN_CENTRES, {"units": "rad nm-1"}))
        .assign(
            joined=("bin_wavevector", np.where(reliable.any(axis=0), density, np.nan), nm4),
            psd=(both, np.where(reliable, density, np.nan), nm4),
            reliable=(both, reliable.astype("int8")),
            kind=(along, ["description"] * len(runs)),
            path=(along, [path] * len(runs)),
            dataset=(along, [""] * len(runs)),
            size=(along, unknown, nm),
            pixel_size=(along, unknown, nm),
            tip_radius=(along, unknown, nm),
            shortest_reliable=(along, [run.shortest for run in runs], nm),
            longest_reliable=(along, [run.longest for run in runs], nm),
            shortest_reason=(along, ["the source ends"] * len(runs)),
            longest_reason=(along, ["the source or the table of the study ends"] * len(runs)),
            notes=(along, [run.source for run in runs]),
        )
        .assign_attrs(
            basis="substitute",
            calibrated_to_table1=stored.attrs["calibrated_to_table1"],
            shortest_measured=min(run.shortest for run in runs),
            longest_measured=max(run.longest for run in runs),
            tail_note=_rest(bands),
        )
    )


def _runs(bands: pd.DataFrame) -> list[_Run]:
    """Return the runs of known bands, no longer than the table of spectra."""
    runs: list[_Run] = []
    known = bands[bands.basis.isin(KNOWN)]
    for longest, shortest, source in zip(
        known.longest_nm, known.shortest_nm, known.source, strict=True
    ):
        if runs and (runs[-1].shortest, runs[-1].source) == (longest, source):
            runs[-1] = runs[-1]._replace(shortest=shortest)
        else:
            runs.append(_Run(min(longest, 2 * np.pi / WAVEVECTORS[0]), shortest, source))
    return runs


def _rest(bands: pd.DataFrame) -> str:
    """Return in words what the bands are that are not known."""
    return "; ".join(
        f"{band.longest_nm:g} to {band.shortest_nm:g} nm {band.basis}: {band.source}"
        for band in bands[~bands.basis.isin(KNOWN)].itertuples()
    )
