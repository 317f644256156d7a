"""The spectrum of a substitute beside those of measured surfaces: what of it is known."""

import io
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import pandas as pd

from hardcontact.surfaces.spectrum import BIN_EDGES, WAVEVECTORS, spectrum_from

if TYPE_CHECKING:
    import xarray as xr

__all__ = ["KNOWN", "described_spectrum"]

#: Bases of bands that are known; all others are inferred or assumed.
KNOWN = ("published", "measured")


class _Run(NamedTuple):
    """Neighbouring known bands of one source: their wavelengths in nm."""

    longest: float
    shortest: float
    source: str


def described_spectrum(stored: "xr.Dataset", path: str) -> "xr.Dataset":
    """Return the spectrum of a substitute as `joined_spectrum` returns that of a measured surface.

    Its known bands stand for measurements, neighbours of one source for one: nothing was measured
    here, but they were fitted to measurements, and their wavelengths are not artificial.

    Parameters
    ----------
    stored : xarray.Dataset
        Of `substitute_spectra.substitute_spectrum`.
    path : str
        Of the description.

    Returns
    -------
    xarray.Dataset
        Over measurement, wavevector and bin_wavevector; what only a measurement has is NaN or
        empty.

    Raises
    ------
    ValueError
        In one line, if no band is known.
    """
    bands = pd.read_csv(io.StringIO(stored.attrs["bands"]))
    runs = _runs(bands)
    if not runs:
        raise ValueError(f"{path}: expected a band that is {' or '.join(KNOWN)}, found none")
    wavevector = np.sqrt(BIN_EDGES[1:] * BIN_EDGES[:-1])
    wavelength, density = 2 * np.pi / wavevector, spectrum_from(stored)(wavevector)
    reliable = np.array([(run.shortest < wavelength) & (wavelength <= run.longest) for run in runs])
    nm4, nm, unknown = {"units": "nm4"}, {"units": "nm"}, np.full(len(runs), np.nan)
    both, along = ("measurement", "bin_wavevector"), "measurement"
    return (
        stored[["spectrum"]]
        .assign_coords(bin_wavevector=("bin_wavevector", wavevector, {"units": "rad nm-1"}))
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
