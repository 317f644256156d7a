"""Datasets of spectra with the measurements, or the segments of a description, behind them."""

import io
from collections.abc import Mapping, Sequence

import numpy as np
import pandas as pd
import xarray as xr
from numpy.typing import NDArray

from hardcontact.base.arrays import Floats
from hardcontact.base.units import NM4, RAD_PER_NM
from hardcontact.scans.defects import DEFECT_UNITS
from hardcontact.scans.extrapolation import Tail
from hardcontact.scans.reliable_band import ReliableBand
from hardcontact.scans.scan_pairs import earlier_scans_of_areas
from hardcontact.surfaces.height_map import HeightMap
from hardcontact.surfaces.spectrum import BIN_CENTRES, WAVEVECTORS, spectrum_of_dataset
from hardcontact.surfaces.substitute_spectra import DATA_EVIDENCE

#: Attributes of a spectrum about its ends, with their units; no unit for a text.
END_UNITS = dict.fromkeys(("shortest_measured", "longest_measured", "rolloff"), "nm") | dict(
    zip((*Tail._fields, "tail_known"), ("1", "1", "nm", "nm", "", "1"), strict=True)
)


def measurement_descriptions(
    measurements: Sequence[HeightMap], radii: Sequence[float | None], bands: Sequence[ReliableBand]
) -> pd.DataFrame:
    """Return the properties of measurements, such as sizes and bands in nm, defects and paths."""
    earlier_measurements = earlier_scans_of_areas(measurements)
    rows = [
        {
            "kind": measurement.kind,
            "size": measurement.size,
            "pixel_size": measurement.pixel_size,
            "shortest_reliable": band.shortest,
            "longest_reliable": band.longest,
            "limited_by": band.limited_by,
            "path": measurement.path,
            "dataset": measurement.dataset,
            "tip_radius": np.nan if radius is None else radius,
            "notes": "\n".join(measurement.notes),
            "earlier_scan": "" if earlier is None else measurements[earlier].name,
            **dict.fromkeys(DEFECT_UNITS, np.nan),
            **{name: defect[name] for defect in measurement.defects.values() for name in defect},
        }
        for measurement, radius, band, earlier in zip(
            measurements, radii, bands, earlier_measurements, strict=True
        )
    ]
    return pd.DataFrame(rows)


def add_measurements(
    spectrum: xr.Dataset,
    joined_density: Floats,
    psds: Floats,
    reliable: NDArray[np.bool_],
    descriptions: pd.DataFrame,
) -> xr.Dataset:
    """Add to a joined spectrum the measurements behind it.

    `joined_density` (bins,) is NaN where no measurement is reliable; PSDs and `reliable` are
    (measurement, bins). Descriptions become variables over `measurement`.
    """
    axis = "bin_wavevector"
    axes = ("measurement", axis)
    columns = {}
    for name, values in descriptions.to_dict("list").items():
        unit = DEFECT_UNITS.get(str(name), "" if isinstance(values[0], str) else "nm")
        columns[name] = ("measurement", values, {"units": unit} if unit else {})
    return spectrum.assign(
        {
            "psd": (axes, psds, NM4),
            "reliable": (axes, reliable.astype("int8"), {}),
            **columns,
            "joined_psd": (axis, joined_density, NM4),
        }
    ).assign_coords({axis: (axis, BIN_CENTRES, RAD_PER_NM)})


def convert_described_spectrum(substitute: xr.Dataset, path: str) -> xr.Dataset:
    """Return a substitute spectrum in the form of a joined spectrum.

    Its segments with DATA_EVIDENCE take the place of measurements. Adjacent segments from one
    reference become one. Properties of measurements alone are NaN or empty.
    """
    segments = pd.read_csv(io.StringIO(substitute.attrs["segments"]))
    runs = _runs_of_one_reference(segments[segments.evidence.isin(DATA_EVIDENCE)])
    descriptions = runs.assign(
        longest_reliable=runs.longest_reliable.clip(upper=2 * np.pi / WAVEVECTORS[0]),
        kind="description",
        path=path,
        dataset="",
        limited_by="source",
        **dict.fromkeys(("size", "pixel_size", "tip_radius", *DEFECT_UNITS), np.nan),
    )
    wavelength = 2 * np.pi / BIN_CENTRES
    density = spectrum_of_dataset(substitute)(BIN_CENTRES)
    shortest = descriptions.shortest_reliable.to_numpy()[:, None]
    longest = descriptions.longest_reliable.to_numpy()[:, None]
    reliable = (shortest < wavelength) & (wavelength <= longest)
    joined_density = np.where(reliable.any(axis=0), density, np.nan)
    psds = np.where(reliable, density, np.nan)
    return add_measurements(
        substitute[["spectrum"]], joined_density, psds, reliable, descriptions
    ).assign_attrs(
        source="substitute",
        table1_rows_met=substitute.attrs["table1_rows_met"],
        shortest_measured=descriptions.shortest_reliable.min(),
        longest_measured=descriptions.longest_reliable.max(),
        **Tail()._asdict(),
        tail_known=1,
        rolloff=np.nan,
    )


def _runs_of_one_reference(segments: pd.DataFrame) -> pd.DataFrame:
    """Return the wavelengths and the reference of adjacent segments with the same reference."""
    previous = segments.shift()
    has_gap = segments.longest_nm != previous.shortest_nm
    begins = has_gap | (segments.source != previous.source)
    return segments.groupby(begins.cumsum()).agg(
        shortest_reliable=("shortest_nm", "last"),
        longest_reliable=("longest_nm", "first"),
        notes=("source", "first"),
    )


def stack_spectra(spectra: Mapping[str, xr.Dataset], labels: Mapping[str, str]) -> xr.Dataset:
    """Stack the joined spectra of all surfaces, with labels and END_UNITS by surface.

    Missing measurements are NaN, 0 or "".
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
    table = xr.concat(
        numbered, names, join="outer", fill_value=fill, combine_attrs="override"
    ).drop_vars("measurement")
    for name, unit in END_UNITS.items():
        ends = [spectrum.attrs[name] for spectrum in spectra.values()]
        table[name] = ("surface", ends, {"units": unit} if unit else {})
    return table.assign(label=("surface", [labels[name] for name in spectra]))
