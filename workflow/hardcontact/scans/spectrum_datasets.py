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
from hardcontact.scans.reliable_wavelengths import ReliableWavelengths
from hardcontact.scans.scan_pairs import earlier_scans_of_areas
from hardcontact.surfaces.height_map import HeightMap
from hardcontact.surfaces.spectrum import BIN_CENTRES, WAVEVECTORS, spectrum_of_dataset
from hardcontact.surfaces.substitute_spectra import DATA_EVIDENCE

#: Attributes of a spectrum about its ends, with their units: "1" if dimensionless, "" for a text.
END_ATTRIBUTE_UNITS = {
    "shortest_measured": "nm", "longest_measured": "nm", "rolloff": "nm", "tail_hurst": "1",
    "tail_hurst_error": "1", "tail_fit_shortest": "nm", "tail_fit_longest": "nm",
    "tail_ended_by": "", "tail_known": "1",
}  # fmt: skip
#: Properties of a measurement, a scan or a segment of a description, with their units.
PROPERTY_UNITS = {
    "kind": "", "path": "", "dataset": "", "notes": "", "earlier_scan": "", "limited_by": "",
    "size": "nm", "pixel_size": "nm", "shortest_reliable": "nm", "longest_reliable": "nm",
    "tip_radius": "nm", **DEFECT_UNITS,
}  # fmt: skip


def scan_properties(
    scans: Sequence[HeightMap],
    tip_radii: Sequence[float | None],
    scan_waves: list[ReliableWavelengths],
) -> pd.DataFrame:
    """Return properties of scans (PROPERTY_UNITS), a row each, without defects that none has."""
    columns = zip(scans, tip_radii, scan_waves, earlier_scans_of_areas(scans), strict=True)
    rows = [
        {
            "kind": scan.kind,
            "size": scan.size,
            "pixel_size": scan.pixel_size,
            "shortest_reliable": waves.shortest,
            "longest_reliable": waves.longest,
            "limited_by": waves.limited_by,
            "path": scan.path,
            "dataset": scan.dataset,
            "tip_radius": np.nan if tip_radius is None else tip_radius,
            "notes": "\n".join(scan.notes),
            "earlier_scan": "" if earlier is None else scans[earlier].name,
            **{name: defect[name] for defect in scan.defects.values() for name in defect},
        }
        for scan, tip_radius, waves, earlier in columns
    ]
    return pd.DataFrame(rows)


def add_measurements(
    spectrum: xr.Dataset,
    joined_density: Floats,
    densities: Floats,
    reliable: NDArray[np.bool_],
    properties: pd.DataFrame,
) -> xr.Dataset:
    """Return a joined spectrum with the measurements behind it.

    PSDs (nm⁴) and `reliable` are (measurement, bins). All PROPERTY_UNITS become variables over
    `measurement`, NaN or "" if `properties` (a row per measurement) does not have them.
    """
    axis = "bin_wavevector"
    axes = ("measurement", axis)
    columns = {}
    for name, unit in PROPERTY_UNITS.items():
        fills = [np.nan if unit else ""] * len(properties)
        column = properties[name].to_list() if name in properties else fills
        columns[name] = ("measurement", column, {"units": unit} if unit else {})
    return spectrum.assign(
        {
            "psd": (axes, densities, NM4),
            "reliable": (axes, reliable.astype("int8"), {}),
            **columns,
            "joined_psd": (axis, joined_density, NM4),
        }
    ).assign_coords({axis: (axis, BIN_CENTRES, RAD_PER_NM)})


def convert_described_spectrum(spectrum_data: xr.Dataset, path: str) -> xr.Dataset:
    """Return a substitute spectrum like a joined one, so that pages treat both alike.

    Segments with DATA_EVIDENCE become measurements.
    """
    segments = pd.read_csv(io.StringIO(spectrum_data.attrs["segments"]))
    segments = segments[segments.evidence.isin(DATA_EVIDENCE)]
    # Adjacent segments, from long to short wavelengths, with the same `source` become one.
    previous = segments.shift()
    has_gap = segments.longest_nm != previous.shortest_nm
    is_new_run = has_gap | (segments.source != previous.source)
    runs = segments.groupby(is_new_run.cumsum()).agg(
        shortest_reliable=("shortest_nm", "last"),
        longest_reliable=("longest_nm", "first"),
        notes=("source", "first"),
    )
    properties = runs.assign(
        longest_reliable=runs.longest_reliable.clip(upper=2 * np.pi / WAVEVECTORS[0]),
        kind="description",
        path=path,
        limited_by="source",
    )
    wavelength = 2 * np.pi / BIN_CENTRES
    density = spectrum_of_dataset(spectrum_data)(BIN_CENTRES)
    shortest = properties.shortest_reliable.to_numpy()[:, None]
    longest = properties.longest_reliable.to_numpy()[:, None]
    reliable = (shortest < wavelength) & (wavelength <= longest)
    return add_measurements(
        spectrum_data[["spectrum"]],
        joined_density=np.where(reliable.any(axis=0), density, np.nan),
        densities=np.where(reliable, density, np.nan),
        reliable=reliable,
        properties=properties,
    ).assign_attrs(
        source="substitute",
        table1_rows_met=spectrum_data.attrs["table1_rows_met"],
        shortest_measured=properties.shortest_reliable.min(),
        longest_measured=properties.longest_reliable.max(),
        **Tail()._asdict(),
        tail_known=1,
        rolloff=np.nan,
    )


def stack_spectra(spectra: Mapping[str, xr.Dataset], labels: Mapping[str, str]) -> xr.Dataset:
    """Stack the joined spectra of all surfaces, with labels and END_ATTRIBUTE_UNITS by surface.

    Surfaces with fewer measurements than others get empty ones.
    """
    numbered = [
        spectrum.drop_attrs(deep=False).assign_coords(
            measurement=range(spectrum.sizes["measurement"])
        )
        for spectrum in spectra.values()
    ]
    fill = {  # by kind of dtype: texts, objects, integers, else floats
        name: {"U": "", "O": "", "i": 0}.get(values.dtype.kind, np.nan)
        for name, values in numbered[0].data_vars.items()
    }
    surfaces = pd.Index(list(spectra), name="surface")
    stacked = xr.concat(
        numbered, surfaces, join="outer", fill_value=fill, combine_attrs="override"
    ).drop_vars("measurement")
    for name, unit in END_ATTRIBUTE_UNITS.items():
        ends = [spectrum.attrs[name] for spectrum in spectra.values()]
        stacked[name] = ("surface", ends, {"units": unit} if unit else {})
    return stacked.assign(label=("surface", [labels[surface] for surface in surfaces]))
