"""Datasets of the spectra of surfaces: with measurements, with descriptions, of all surfaces."""

import io
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr
from numpy.typing import NDArray

from hardcontact.surfaces.extrapolated_spectrum import Tail
from hardcontact.surfaces.measured_spectrum import size_of
from hardcontact.surfaces.reliable_band import ReliableBand
from hardcontact.surfaces.scan_defects import DEFECT_UNITS
from hardcontact.surfaces.scans import Measurement
from hardcontact.surfaces.spectrum import BIN_CENTRES, KNOWN, WAVEVECTORS, Floats, spectrum_from

#: What a spectrum says of its ends, with units; it stands in its attributes.
ENDS = dict.fromkeys(("shortest_measured", "longest_measured", "rolloff"), "nm") | dict(
    zip((*Tail._fields, "tail_known"), ("1", "1", "nm", "nm", "1", "1"), strict=True)
)


def measurement_descriptions(
    measurements: Sequence[Measurement],
    radii: Sequence[float | None],
    bands: Sequence[ReliableBand],
) -> list[dict[str, Any]]:
    """Return the properties of measurements: sizes and bands in nm, their defects, words.

    Radii are of their tips in nm, None where they are not known.
    """
    return [
        {
            "kind": measurement.kind,
            "size": size_of(measurement),
            "pixel_size": measurement.pixel_size,
            "shortest_reliable": band.shortest,
            "longest_reliable": band.longest,
            "limited_by": band.limited_by,
            "path": measurement.path,
            "dataset": measurement.dataset,
            "tip_radius": np.nan if radius is None else radius,
            "notes": "; ".join(measurement.notes),
            **dict.fromkeys(DEFECT_UNITS, np.nan),
            **{
                name: number
                for numbers in measurement.defects.values()
                for name, number in numbers.items()
            },
        }
        for measurement, radius, band in zip(measurements, radii, bands, strict=True)
    ]


def with_measurements(
    spectrum: xr.Dataset,
    joined: Floats,
    psds: Floats,
    reliable: NDArray[np.bool_],
    descriptions: Sequence[Mapping[Any, Any]],
) -> xr.Dataset:
    """Return a spectrum with the measurements that it was joined of.

    Parameters
    ----------
    spectrum : xarray.Dataset
        Of `spectrum_dataset`.
    joined : numpy.ndarray
        (bins,) C_iso in nm⁴, NaN where no measurement is reliable.
    psds, reliable : numpy.ndarray
        (measurement, bins) C_iso in nm⁴, and where it is reliable.
    descriptions : sequence of mapping
        Words and numbers of each measurement, lengths in nm.

    Returns
    -------
    xarray.Dataset
        The spectrum with variables over `measurement` and `bin_wavevector`.
    """
    axes, axis = ("measurement", "bin_wavevector"), "bin_wavevector"
    columns = {
        name: (
            "measurement",
            [description[name] for description in descriptions],
            {} if isinstance(value, str) else {"units": DEFECT_UNITS.get(name, "nm")},
        )
        for name, value in descriptions[0].items()
    }
    return spectrum.assign(
        {
            "psd": (axes, psds, {"units": "nm4", "long_name": "isotropic PSD"}),
            "reliable": (axes, reliable.astype("int8"), {"long_name": "1 where it is reliable"}),
            **columns,
            "joined": (axis, joined, {"units": "nm4", "long_name": "joined PSD"}),
        }
    ).assign_coords({axis: (axis, BIN_CENTRES, {"units": "rad nm-1"})})


def described_spectrum(stored: xr.Dataset, path: str) -> xr.Dataset:
    """Return a stored substitute spectrum in the form of a joined spectrum.

    Its known bands take the place of measurements, neighbours of one source as one. Variables that
    only a measurement has are NaN or empty. The path is the file of the description.
    """
    bands = pd.read_csv(io.StringIO(stored.attrs["bands"]))
    known_bands = bands[bands.basis.isin(KNOWN)]
    previous = known_bands.shift()
    has_gap = known_bands.longest_nm != previous.shortest_nm
    begins = has_gap | (known_bands.source != previous.source)
    runs = known_bands.groupby(begins.cumsum()).agg(
        shortest_reliable=("shortest_nm", "last"),
        longest_reliable=("longest_nm", "first"),
        notes=("source", "first"),
    )
    longest = runs.longest_reliable.clip(upper=2 * np.pi / WAVEVECTORS[0])  # as in the table
    descriptions = runs.assign(
        longest_reliable=longest, kind="description", path=path, dataset="", limited_by="source"
    ).assign(**dict.fromkeys(("size", "pixel_size", "tip_radius", *DEFECT_UNITS), np.nan))
    wavelength, density = 2 * np.pi / BIN_CENTRES, spectrum_from(stored)(BIN_CENTRES)
    ends = descriptions[["shortest_reliable", "longest_reliable"]].to_numpy()
    shortest, longest = ends.T[..., None]
    reliable = (shortest < wavelength) & (wavelength <= longest)
    joined = np.where(reliable.any(axis=0), density, np.nan)
    psds = np.where(reliable, density, np.nan)
    return with_measurements(
        stored[["spectrum"]], joined, psds, reliable, descriptions.to_dict("records")
    ).assign_attrs(
        basis="substitute",
        calibrated_to_table1=stored.attrs["calibrated_to_table1"],
        shortest_measured=descriptions.shortest_reliable.min(),
        longest_measured=descriptions.longest_reliable.max(),
        **Tail()._asdict(),
        tail_known=1,
        rolloff=np.nan,
    )


def stacked_spectra(spectra: Mapping[str, xr.Dataset], labels: Mapping[str, str]) -> xr.Dataset:
    """Return the joined spectra of all surfaces, given by surface, with their names in print.

    Variables have a leading dimension `surface`, filled with NaN, 0 or "". Variables (surface) hold
    `label` and ENDS.
    """
    numbered = [
        spectrum.drop_attrs(deep=False).assign_coords(
            measurement=range(spectrum.sizes["measurement"])
        )
        for spectrum in spectra.values()
    ]
    fill = {
        name: {"U": "", "O": "", "i": 0}.get(values.dtype.kind, np.nan)
        for name, values in numbered[0].data_vars.items()
    }
    names = pd.Index(list(spectra), name="surface")
    stacked = xr.concat(
        numbered, names, join="outer", fill_value=fill, combine_attrs="override"
    ).drop_vars("measurement")
    for name, unit in ENDS.items():
        ends = [spectrum.attrs[name] for spectrum in spectra.values()]
        stacked[name] = ("surface", ends, {"units": unit})
    return stacked.assign(label=("surface", [labels[name] for name in spectra]))
