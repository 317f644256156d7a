"""What an answer is drawn from: the final datasets of a study, and what they do not say of it."""

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import xarray as xr

from hardcontact.base.number import Number

#: The contact model whose force stands in the answer, where it was computed.
PREFERRED = "plastic"


class Datasets(NamedTuple):
    """The datasets that an answer is drawn from, as in the files of these names.

    Topography and spectra may be of the scans of the sphere too, which no answer is asked for; the
    fit is there if the user has own forces.
    """

    topography: xr.Dataset
    spectra: xr.Dataset
    edges: xr.Dataset
    force: xr.Dataset
    fit: xr.Dataset | None = None

    def of_surface(self, surface: str) -> "Datasets":
        """Return the parts of one surface, with the fit, which is of all surfaces."""
        return Datasets(*(part.sel(surface=surface) for part in self[:4]))._replace(fit=self.fit)

    def labels(self) -> dict[str, str]:
        """Return the printed name of each surface with a band; a substitute is called so."""
        topography = self.topography.sel(surface=self.edges["surface"])
        names = (topography[name].values for name in ("surface", "label", "basis"))
        return {
            str(surface): f"{label} (substitute)" if basis == "substitute" else str(label)
            for surface, label, basis in zip(*names, strict=True)
        }


class Setting(NamedTuple):
    """What the datasets do not say of a study."""

    study: str  #: Its name.
    effort: str  #: full or quick.
    #: What contacts were computed for, as printed: for example "radius of the sphere": "250 µm".
    contact: Mapping[str, str]
    #: What of these is the paper's: of its sphere, not of the user's bodies.
    of_paper: Sequence[str]
    left_out: Sequence[tuple[str, str]]  #: Parts that these data do not allow, and why.
    citation: Mapping[str, str]  #: Title and version of the software, as in CITATION.cff.
    #: Pairs of range and work of adhesion, rows of resources/adhesion/pairs.csv.
    pairs: Sequence[Mapping[str, Any]]


def model_of(force: xr.Dataset) -> str:
    """Return the contact model whose force stands in the answer."""
    models = [str(name) for name in force["contact_model"].values]
    return PREFERRED if PREFERRED in models else models[0]


def tabor_number(force: xr.Dataset) -> Number:
    """Return the Tabor parameter of the contacts, NaN where the modulus is not known."""
    return Number("tabor_parameter", force.attrs["tabor_parameter"], status=force.attrs["bodies"])


def at_range(force: xr.Dataset) -> xr.Dataset:
    """Return the forces at the range of adhesion that was asked for, of the model of the answer.

    If the range was not computed it is a KeyError.
    """
    asked = force.attrs["range_of_adhesion"]
    return force.sel(contact_model=model_of(force)).sel(
        rho=asked, method="nearest", tolerance=1e-6 * asked
    )
