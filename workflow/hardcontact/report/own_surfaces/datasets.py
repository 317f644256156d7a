"""The final datasets of a study of the user's surfaces, and the settings that they do not hold."""

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import xarray as xr

from hardcontact.base.number import Number
from hardcontact.contact.contact import PLASTIC


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
        surface_datasets = (dataset.sel(surface=surface) for dataset in self[:5])
        return Datasets(*surface_datasets)._replace(fit=self.fit)

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
