"""Spectra of substitutes from descriptions: bands of wavelengths, each with its model."""

import io
from pathlib import Path

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.surfaces.calibration import (
    Weights,
    calibrate_model,
    calibrate_tail,
    expected_moments,
    transfer_weights,
)
from hardcontact.surfaces.joined_spectrum import Tail
from hardcontact.surfaces.spectral_models import (
    CALIBRATED,
    KNOWN,
    MODELS,
    PARAMETERS,
    TAIL_ROWS,
    continued,
    is_calibrated,
    profile_points,
    share_of_cells,
)
from hardcontact.surfaces.spectrum import (
    BIN_CENTRES,
    WAVEVECTORS,
    Floats,
    Spectrum,
    all_scales_moments,
    spectrum_dataset,
    spectrum_from,
    with_measurements,
)


def from_description(
    path: str | Path, table1: pd.DataFrame, weights: Weights
) -> tuple[Floats, pd.DataFrame, list[str]]:
    """Return C_iso (nm⁴) on WAVEVECTORS, its bands with all parameters, rows of Table 1 used.

    The file is a CSV of bands from long to short wavelengths, each with its model, parameters and
    basis. A band of CALIBRATED without Hurst exponent is calibrated to Table 1 (of
    `rows_of_surface`). A band that cannot be made is a ValueError that names it and the file.
    """
    bands = _bands(path)
    density, calibrated = np.zeros_like(WAVEVECTORS), list[str]()
    for i, band in bands.iterrows():
        try:
            if pd.isna(band.hurst) and band.model in CALIBRATED:
                band = pd.Series(dict(band) | _calibrated(band, density, table1, weights))
                calibrated += CALIBRATED[band.model]
            density += _band_density(band, density, Path(path).parent)
        except (KeyError, ValueError, OSError) as error:
            raise ValueError(f"{path}: band from {band.longest_nm:g} nm: {error}") from None
        bands.loc[i] = band
    last = bands.iloc[-1]
    if last.model == "power law":
        density *= share_of_cells(last.shortest_nm)
    return density, bands, calibrated


def _bands(path: str | Path) -> pd.DataFrame:
    """Return the bands of a description; a file that is none is a ValueError of one line."""
    columns = ("model", "table", *PARAMETERS)
    try:
        bands = pd.read_csv(path)
        if missing := [name for name in columns if name not in bands]:
            raise ValueError(f"no {', '.join(missing)}")
        return bands.astype(dict.fromkeys(PARAMETERS, float))
    except (OSError, ValueError) as error:
        reason = " ".join(str(error).split())
        raise ValueError(
            f"{path}: expected bands of a spectrum, with the columns {', '.join(columns)} "
            f"(resources/README.md), found: {reason}"
        ) from None


def described_rms_height(path: str | Path, longest: float) -> float:
    """Return the rms height (nm) of the waves up to a wavelength (nm), from a description alone.

    A ValueError is that of `from_description`, or says that parameters are left to Table 1.
    """
    if is_calibrated(_bands(path)):
        raise ValueError(f"{path}: expected all parameters, found some to calibrate to Table 1")
    nothing = np.empty(0)
    density, _, _ = from_description(path, pd.DataFrame(), (nothing, np.empty((3, 0))))
    short_enough = 2 * np.pi / WAVEVECTORS <= longest
    return float(all_scales_moments(Spectrum(WAVEVECTORS, density * short_enough))[0])


def _calibrated(
    band: pd.Series, above: Floats, table1: pd.DataFrame, weights: Weights
) -> dict[str, float]:
    """Return the parameters of a band that Table 1 fixes."""
    if band.model in MODELS:
        return calibrate_model(band, table1, weights)
    gradient, half_laplacian = table1.loc[list(TAIL_ROWS), "value"]
    hurst, shortest = calibrate_tail(above, (gradient, half_laplacian))
    return {"hurst": hurst, "shortest_nm": shortest}


def _band_density(band: pd.Series, above: Floats, folder: Path) -> Floats:
    """Return C_iso of one band on WAVEVECTORS, zero outside it."""
    if band.model == "power law":
        return continued(above, band.hurst) * (share_of_cells(band.shortest_nm) > 0)
    if band.model in MODELS:
        density, parameters = MODELS[band.model]
        model = density(WAVEVECTORS, *(band[name] for name in parameters))
    elif band.model == "profile":
        points = pd.read_csv(folder / band.table).astype({"wavelength_nm": float, "c1d_nm3": float})
        model = profile_points(
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
) -> xr.Dataset:
    """Return the spectrum of a substitute from a description, as of `from_description`.

    Table 1, of `rows_of_surface` or empty, is for scans of the paper's pixels and size, which the
    constants have. Attributes are the bands, the rows of Table 1 that they were calibrated to, and
    the moments expected of one of the paper's scans.
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


def described_spectrum(stored: xr.Dataset, path: str) -> xr.Dataset:
    """Return a stored `substitute_spectrum` as `joined_spectrum` returns that of a measurement.

    Its known bands stand for measurements, neighbours of one source for one: they were fitted to
    measurements, and their wavelengths are not artificial. What only a measurement has is NaN or
    empty. The path is that of the description; if no band is known, it is a ValueError.
    """
    bands = pd.read_csv(io.StringIO(stored.attrs["bands"]))
    known = bands[bands.basis.isin(KNOWN)]
    if known.empty:
        raise ValueError(f"{path}: expected a band that is {' or '.join(KNOWN)}, found none")
    before = known.shift()
    begins = (known.longest_nm != before.shortest_nm) | (known.source != before.source)
    runs = known.groupby(begins.cumsum()).agg(
        longest=("longest_nm", "first"),
        shortest=("shortest_nm", "last"),
        source=("source", "first"),
    )
    runs["longest"] = runs.longest.clip(upper=2 * np.pi / WAVEVECTORS[0])  # as in the table
    wavelength, density = 2 * np.pi / BIN_CENTRES, spectrum_from(stored)(BIN_CENTRES)
    shortest, longest = runs[["shortest", "longest"]].to_numpy().T[..., None]
    reliable = (shortest < wavelength) & (wavelength <= longest)
    measurements = [
        {
            "kind": "description",
            "path": path,
            "dataset": "",
            "size": np.nan,
            "pixel_size": np.nan,
            "tip_radius": np.nan,
            "shortest_reliable": run.shortest,
            "longest_reliable": run.longest,
            "limited_by": "source",
            "notes": run.source,
        }
        for run in runs.itertuples()
    ]
    joined = np.where(reliable.any(axis=0), density, np.nan)
    return with_measurements(
        stored[["spectrum"]].assign(joined=("bin_wavevector", joined, {"units": "nm4"})),
        np.where(reliable, density, np.nan),
        reliable,
        measurements,
    ).assign_attrs(
        basis="substitute",
        calibrated_to_table1=stored.attrs["calibrated_to_table1"],
        shortest_measured=runs.shortest.min(),
        longest_measured=runs.longest.max(),
        **Tail()._asdict(),
        rolloff=np.nan,
    )
