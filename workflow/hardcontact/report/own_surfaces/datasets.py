"""The final datasets of a study of your surfaces, and the wavelengths that scans show."""

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from hardcontact.base.number import Number
from hardcontact.contact.contact import PLASTIC
from hardcontact.scans.both_bodies import sphere_share

#: Kinds of measurements of a spectrum in spectra.nc: scans, and those segments of the description
#: of a substitute that come from data. Surfaces with fewer measurements than others have padding
#: without a kind.
MEASUREMENT_KINDS = ("map", "line scan", "description")
#: Lengths of each measurement, in nm.
MEASUREMENT_LENGTHS = ("size", "pixel_size", "shortest_reliable", "longest_reliable", "tip_radius")


class Datasets(NamedTuple):
    """The datasets of all surfaces, or of one.

    The former are called `datasets`, the latter `surface_data`. Topography and spectra may have the
    sphere, too.
    """

    topography: xr.Dataset
    spectra: xr.Dataset
    edges: xr.Dataset
    force: xr.Dataset
    sensitivity: xr.Dataset
    fit: xr.Dataset | None = None  #: None without measured forces.

    def select_surface(self, surface: str) -> "Datasets":
        """Return the datasets of one surface, with the fit to the forces of all surfaces."""
        names = [name for name in self._fields if name != "fit"]
        return self._replace(**{name: getattr(self, name).sel(surface=surface) for name in names})

    def labels(self) -> dict[str, str]:
        """Return the printed name of each surface of edges.nc, with a mark on substitutes."""
        topography = self.topography.sel(surface=self.edges["surface"])
        columns = (topography[name].values for name in ("surface", "label", "source"))
        return {
            str(surface): f"{label} (substitute)" if source == "substitute" else str(label)
            for surface, label, source in zip(*columns, strict=True)
        }


class Setting(NamedTuple):
    """The settings of a study that its datasets do not hold."""

    study: str
    effort: str  #: full or quick.
    #: Inputs of the contacts as printed, such as "radius of the sphere": "250 µm".
    contact_words: Mapping[str, str]
    #: Names of those inputs that have the paper's value, because the user gave none.
    assumed: Sequence[str]
    version: str
    #: Pairs of range and work of adhesion, rows of resources/adhesion/pairs.csv.
    pairs: Sequence[Mapping[str, Any]]


def preferred_model(force: xr.Dataset) -> str:
    """Return the name of the contact model whose force is the answer."""
    models = [str(name) for name in force["contact_model"].values]
    return PLASTIC if PLASTIC in models else models[0]


def stored_tabor_number(force: xr.Dataset) -> Number:
    """Return the Tabor parameter of the contacts; its status says whether the bodies are hard."""
    return Number("tabor_parameter", force.attrs["tabor_parameter"], status=force.attrs["bodies"])


def select_preferred_model(dataset: xr.Dataset) -> xr.Dataset:
    """Return the forces, or the fit, of the preferred contact model."""
    return dataset.sel(contact_model=preferred_model(dataset))


def forces_at_range(force: xr.Dataset) -> xr.Dataset:
    """Return the forces of the preferred contact model at the configured range of adhesion."""
    rho = force.attrs["rho"]
    return select_preferred_model(force).sel(rho=rho, method="nearest", tolerance=1e-6 * rho)


def drop_padding(spectra: xr.Dataset) -> xr.Dataset:
    """Return the spectra of one surface without the padding along `measurement`."""
    return spectra.isel(measurement=np.isin(spectra["kind"].values.astype(str), MEASUREMENT_KINDS))


def fails_hindcast(surface_data: Datasets, side: str) -> bool:
    """Return whether the hindcast of a side fails or tests no octave; False without a hindcast.

    The hindcast (`own.hindcast`) tests whether artificial roughness can stand for that of a scan.
    """
    fails = surface_data.force.get("hindcast_fails")
    return fails is not None and fails.sel(side=side).item() == 1


def measurement_name(measurement: xr.Dataset) -> str:
    """Return the path of a measurement and, if the file is a container, the dataset in it."""
    path = str(measurement["path"].item())
    dataset = str(measurement["dataset"].item())
    return f"{path}: {dataset}" if dataset else path


def split_measurements(spectra: xr.Dataset) -> list[xr.Dataset]:
    """Return a dataset for each measurement of one surface."""
    scans = drop_padding(spectra)
    return [scans.isel(measurement=index) for index in range(scans.sizes["measurement"])]


def unreliable_wavelengths(spectra: xr.Dataset) -> list[tuple[float, float]]:
    """Return the wavelengths (nm) at which no measurement of a surface is reliable.

    They are pairs, from the shortest to the longest wavelength: first from 0 to the shortest
    reliable wavelength, then the gaps between scans, if any, and last to infinity.
    """
    scans = drop_padding(spectra)
    scans = scans.isel(measurement=(scans["reliable"].values == 1).any(axis=1))
    ends = (scans[name].values.tolist() for name in ("shortest_reliable", "longest_reliable"))
    covered_up_to = float(spectra["shortest_measured"])
    unreliable = [(0.0, covered_up_to)]
    for shortest, longest in sorted(zip(*ends, strict=True)):
        if shortest > covered_up_to:
            unreliable.append((covered_up_to, shortest))
        covered_up_to = max(covered_up_to, longest)
    return [*unreliable, (float(spectra["longest_measured"]), np.inf)]


def is_any_unreliable(spectra: xr.Dataset, low: float, high: float) -> bool:
    """Return whether a wavelength from low to high (nm) is unreliable; False if either is NaN."""
    return any(start < high and low < end for start, end in unreliable_wavelengths(spectra))


def octave_sphere_share(spectra: xr.Dataset, octave: float) -> float:
    """Return the sphere's share of the power at the middle of an octave; NaN for a smooth sphere.

    `octave` is the shortest wavelength (nm) of the octave.
    """
    return sphere_share(spectra, np.sqrt(2) * octave)


def shown_octaves(surface_data: Datasets) -> np.ndarray:
    """Return a mask (octave,) of the octaves at whose middle a scan of one surface is reliable."""
    middles = np.sqrt(2) * surface_data.sensitivity["octave"].values
    spectra = surface_data.spectra
    return np.array([not is_any_unreliable(spectra, middle, middle) for middle in middles])
