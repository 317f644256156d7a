"""What an answer is drawn from: the final datasets of a study, and what they do not say of it."""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import xarray as xr

#: The contact model whose force stands in the answer, where it was computed.
PREFERRED = "plastic"


class Datasets(NamedTuple):
    """The datasets that an answer is drawn from.

    Topography and spectra may be of the scans of the sphere too, which no answer is asked for.

    Attributes
    ----------
    topography, spectra, edges, force : xarray.Dataset
        As topography.nc, spectra.nc, edges.nc and force.nc.
    fit : xarray.Dataset or None
        As fit.nc, if the user has own forces.
    """

    topography: xr.Dataset
    spectra: xr.Dataset
    edges: xr.Dataset
    force: xr.Dataset
    fit: xr.Dataset | None = None

    def of_surface(self, surface: str) -> "Datasets":
        """Return the parts of one surface, without a fit, which is of all surfaces."""
        return Datasets(*(part.sel(surface=surface) for part in self[:4]))

    def labels(self) -> dict[str, str]:
        """Return the printed name of each surface with a band; a substitute is called so."""
        topography = self.topography.sel(surface=self.edges["surface"])
        names = (topography[name].values for name in ("surface", "label", "basis"))
        return {
            str(surface): f"{label} (substitute)" if basis == "substitute" else str(label)
            for surface, label, basis in zip(*names, strict=True)
        }


class Setting(NamedTuple):
    """What the datasets do not say of a study.

    Attributes
    ----------
    study : str
        Its name.
    effort : str
        full or quick.
    contact : mapping of str to str
        What contacts were computed for, as printed: for example "radius of the sphere": "250 µm".
    of_paper : sequence of str
        What of these is the paper's: of its sphere, not of the user's bodies.
    left_out : sequence of (str, str)
        Parts that these data do not allow, and why.
    citation : mapping of str to str
        Title and version of the software, as in CITATION.cff.
    """

    study: str
    effort: str
    contact: Mapping[str, str]
    of_paper: Sequence[str]
    left_out: Sequence[tuple[str, str]]
    citation: Mapping[str, str]


def model_of(force: xr.Dataset) -> str:
    """Return the contact model whose force stands in the answer."""
    models = [str(name) for name in force["contact_model"].values]
    return PREFERRED if PREFERRED in models else models[0]


def at_range(force: xr.Dataset) -> xr.Dataset:
    """Return the forces at the range of adhesion that was asked for, of the model of the answer.

    Parameters
    ----------
    force : xarray.Dataset
        As force.nc, over contact_model and rho (nm); the attribute `range_of_adhesion` (nm) is
        one of its rho.

    Returns
    -------
    xarray.Dataset
        Without these dimensions.

    Raises
    ------
    KeyError
        If the range was not computed.
    """
    asked = force.attrs["range_of_adhesion"]
    return force.sel(contact_model=model_of(force)).sel(
        rho=asked, method="nearest", tolerance=1e-6 * asked
    )
