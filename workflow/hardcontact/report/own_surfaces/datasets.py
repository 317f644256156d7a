"""The final datasets of a study of the user's surfaces, and which wavelengths are measured.

At wavelengths at which no scan is reliable roughness is artificial: random, with an extrapolated
spectrum.
"""

from collections.abc import Iterable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from hardcontact.base.number import Number
from hardcontact.contact.contact import PLASTIC
from hardcontact.inference.edges import computed_cutoffs
from hardcontact.inference.octaves import have_middle_within

#: Kinds of measurement; a substitute has a description instead. The datasets of a surface with
#: fewer measurements than another are padded, without a kind.
MEASUREMENT_KINDS = ("map", "line scan", "description")
#: Smallest share of a change that counts as the whole change: a choice.
NEARLY_ALL = 0.9
#: Lengths of each measurement, in nm.
MEASUREMENT_LENGTHS = ("size", "pixel_size", "shortest_reliable", "longest_reliable", "tip_radius")


class Datasets(NamedTuple):
    """The datasets that an answer is made from, as in the files of these names.

    Topography and spectra may have scans of the sphere. Without measured forces the fit is None.
    """

    topography: xr.Dataset
    spectra: xr.Dataset
    edges: xr.Dataset
    force: xr.Dataset
    sensitivity: xr.Dataset
    fit: xr.Dataset | None = None

    def select_surface(self, surface: str) -> "Datasets":
        """Return the datasets of one surface, with the fit to the forces of all surfaces."""
        return self._replace(
            topography=self.topography.sel(surface=surface),
            spectra=self.spectra.sel(surface=surface),
            edges=self.edges.sel(surface=surface),
            force=self.force.sel(surface=surface),
            sensitivity=self.sensitivity.sel(surface=surface),
        )

    def labels(self) -> dict[str, str]:
        """Return the printed name of each surface with a band, with a mark on substitutes."""
        topography = self.topography.sel(surface=self.edges["surface"])
        names = (topography[name].values for name in ("surface", "label", "source"))
        return {
            str(surface): f"{label} (substitute)" if source == "substitute" else str(label)
            for surface, label, source in zip(*names, strict=True)
        }


class Setting(NamedTuple):
    """The settings of a study that its datasets do not hold."""

    study: str  #: Its name.
    effort: str  #: full or quick.
    #: Inputs of the contacts as printed, such as "radius of the sphere": "250 µm".
    contact_words: Mapping[str, str]
    #: Names of those inputs that have the paper's value, because the user gave none.
    assumed: Sequence[str]
    version: str  #: Version of the software.
    #: Pairs of range and work of adhesion, rows of resources/adhesion/pairs.csv.
    pairs: Sequence[Mapping[str, Any]]


def preferred_model(force: xr.Dataset) -> str:
    """Return the name of the contact model whose force is the answer."""
    models = [str(name) for name in force["contact_model"].values]
    return PLASTIC if PLASTIC in models else models[0]


def stored_tabor_number(force: xr.Dataset) -> Number:
    """Return the Tabor parameter of the contacts, NaN if their modulus is not known."""
    return Number("tabor_parameter", force.attrs["tabor_parameter"], status=force.attrs["bodies"])


def forces_at_range(force: xr.Dataset) -> xr.Dataset:
    """Return the forces of the preferred contact model at the configured range of adhesion.

    Raises KeyError if forces were not computed at this range.
    """
    rho = force.attrs["rho"]
    return force.sel(contact_model=preferred_model(force)).sel(
        rho=rho, method="nearest", tolerance=1e-6 * rho
    )


def without_padding(spectra: xr.Dataset) -> xr.Dataset:
    """Return the spectra of one surface without the padding along `measurement`."""
    return spectra.isel(measurement=np.isin(spectra["kind"].values.astype(str), MEASUREMENT_KINDS))


def reliable_scans(spectra: xr.Dataset) -> xr.Dataset:
    """Return the spectra of one surface without measurements that are reliable nowhere."""
    measurements = without_padding(spectra)
    return measurements.isel(measurement=(measurements["reliable"].values == 1).any(axis=1))


def artificial_bands(spectra: xr.Dataset) -> list[tuple[float, float]]:
    """Return the bands of wavelengths at which no measurement of a surface is reliable.

    A band is a pair of its shortest and its longest wavelength (nm). The first begins at 0, the
    last ends at infinity; between them lie gaps between scans.
    """
    scans = reliable_scans(spectra)
    ends = (scans[name].values.tolist() for name in ("shortest_reliable", "longest_reliable"))
    longest_covered = float(spectra["shortest_measured"])
    bands = [(0.0, longest_covered)]
    for shortest, longest in sorted(zip(*ends, strict=True)):
        if shortest > longest_covered:
            bands.append((longest_covered, shortest))
        longest_covered = max(longest_covered, longest)
    return [*bands, (float(spectra["longest_measured"]), np.inf)]


def fails_hindcast(data: Datasets, side: str) -> bool:
    """Return whether artificial roughness in place of measured roughness changes the force."""
    fails = data.force.get("hindcast_fails")
    return fails is not None and fails.sel(side=side).item() == 1


def overlaps_any(low: float, high: float, bands: Iterable[tuple[float, float]]) -> bool:
    """Return whether wavelengths from low to high (nm) overlap any band; False if either is NaN."""
    return any(shortest < high and low < longest for shortest, longest in bands)


def shown_octaves(data: Datasets) -> np.ndarray:
    """Return a mask (octave,) of the octaves at whose middle a scan of one surface is reliable."""
    octaves = data.sensitivity["octave"].values
    hidden = [have_middle_within(octaves, *band) for band in artificial_bands(data.spectra)]
    return np.asarray(np.logical_not(hidden).all(axis=0))


def reliable_and_artificial_change(
    data: Datasets, side: str, shortest: float = 0.0, longest: float = np.inf
) -> tuple[float, float]:
    """Return the change of the force by reliable and by artificial wavelengths of one surface.

    Roughness is removed on the `side`. Each change is the sum of |d ln F| over wavelengths
    between `shortest` and `longest` (nm); ln F is interpolated linearly over the logarithm of the
    cutoff.
    """
    side_edges = data.edges.sel(side=side)
    cutoffs = computed_cutoffs(side_edges["filtered_force_ratio"])
    log_ratio = np.log(side_edges["filtered_force_ratio"].sel(cutoff_wavelength=cutoffs).values)
    # At the end of the extrapolated spectrum nothing is removed, and the ratio is one.
    end_index = 0 if side == "short" else len(cutoffs)
    end = data.force["extrapolation_end"].sel(side=side).item()
    wavelength = np.insert(cutoffs, end_index, end)
    log_ratio = np.insert(log_ratio, end_index, 0.0)
    bands = artificial_bands(data.spectra)
    limits = max(shortest, wavelength[0]), min(longest, wavelength[-1])
    ends = np.unique(np.clip([*wavelength, *limits, *np.ravel(bands)], *limits))
    change = np.abs(np.diff(np.interp(np.log(ends), np.log(wavelength), log_ratio)))
    middle = np.sqrt(ends[1:] * ends[:-1])
    artificial = np.any([(low < middle) & (middle < high) for low, high in bands], axis=0)
    return float(change[~artificial].sum()), float(change[artificial].sum())


def reliable_share(changes: tuple[float, float]) -> float:
    """Return the share of the first of `reliable_and_artificial_change`, NaN without any change."""
    return changes[0] / sum(changes) if sum(changes) > 0 else np.nan


def measured_share_at_edge(data: Datasets, side: str) -> float:
    """Return the share of reliable wavelengths in the change at an edge, NaN for an open edge."""
    edge = data.edges["edge"].sel(side=side).item()
    ends = (0.0, edge) if side == "short" else (edge, np.inf)
    if np.isnan(edge):
        return np.nan
    return reliable_share(reliable_and_artificial_change(data, side, *ends))


def edge_source(data: Datasets, side: str) -> str:
    """Return whether an edge rests on artificial roughness, as the source of its number.

    "artificial": the edge, or its bound, lies at an artificial wavelength, or artificial roughness
    causes more than 90 % of the change. "partly_artificial": it causes 10 to 90 % of the change.
    "interval_artificial": only the interval reaches artificial wavelengths. Otherwise "measured".
    """
    side_edges = data.edges.sel(side=side)
    bands = artificial_bands(data.spectra)
    edge = float(side_edges["edge"].fillna(side_edges["edge_bound"]))
    share = measured_share_at_edge(data, side)
    if overlaps_any(edge, edge, bands) or share < 1 - NEARLY_ALL:
        return "artificial"
    if share < NEARLY_ALL:
        return "partly_artificial"
    low, high = side_edges["edge_interval"].fillna(edge).values
    return "interval_artificial" if overlaps_any(low, high, bands) else "measured"


def measurement_name(measurement: xr.Dataset) -> str:
    """Return the path of a measurement and, if the file is a container, the dataset in it."""
    path = str(measurement["path"].item())
    dataset = str(measurement["dataset"].item())
    return f"{path}: {dataset}" if dataset else path


def split_scans(measurements: xr.Dataset) -> list[xr.Dataset]:
    """Return a dataset for each measurement."""
    count = measurements.sizes["measurement"]
    return [measurements.isel(measurement=index) for index in range(count)]
