"""The purposes for which forces on filtered masters are computed, with their settings.

A master is a scan with artificial roughness; filtered, it lacks all waves beyond a cutoff.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, NamedTuple

from hardcontact.config.configuration import get_key, master_keys, study_contact
from hardcontact.config.grids import master_megabytes
from hardcontact.paper.edge_shifts import SHORT_ADHESION_RANGE
from hardcontact.paper.exponents import PRELOAD_SHARES
from hardcontact.surfaces.synthesis import SIDES

#: Realizations in one job: few enough to keep all cores busy, and so many that a job takes much
#: longer than the half second in which it starts.
MASTERS_CHUNK = 5


class Purpose(NamedTuple):
    """The settings of masters of one purpose, with keys of the configuration."""

    section: str  #: Section of the pixels and cutoffs of masters.
    contacts_key: str  #: Key of the number of contacts per row.
    realizations_key: str  #: Key of the number of masters of a surface.
    realizations_in_job: int = MASTERS_CHUNK
    masters_are_files: bool = False  #: Whether masters are files of the store.
    stream: str = "variant"  #: Name of the random numbers in masters.
    sides: Sequence[str] = SIDES


_STUDY_BAND = ("scales", "contact.contacts_per_row", "scales.realizations", 1)
#: By the name in the paths of their forces.
PURPOSES = {
    # The band of the study.
    "scales": Purpose(*_STUDY_BAND, masters_are_files=True, stream="master"),
    # The same with sampled spectra, of measured surfaces only, and with the same random numbers.
    "sampled": Purpose(*_STUDY_BAND, stream="master"),
    # The edges of each set of substitutes.
    "sets": Purpose("sets", "sets.contacts_per_row", "sets.realizations"),
    # How the edges depend on radius and load, on a smooth sphere.
    "exponents": Purpose("sets", "sets.contacts_per_row", "exponents.realizations"),
    # The short edge with and without plasticity and a long range of adhesion.
    "edge_shifts": Purpose(
        "sets", "sets.contacts_per_row", "exponents.realizations", sides=("short",)
    ),
}


def contact_sweep(configuration: Mapping[str, Any], purpose: str) -> dict[str, list[Any]]:
    """Return radii (nm), loadings (N, Pa) and ranges (nm) at which forces on masters are computed.

    ``"exponents"`` varies radius and preload, ``"edge_shifts"`` plasticity and range.
    """
    contact = study_contact(configuration)
    contacts, radii, ranges = [contact], [contact.radius], [contact.rho]
    if purpose == "exponents":
        contacts = [replace(contact, preload=share * contact.preload) for share in PRELOAD_SHARES]
        radii = configuration["exponents"]["radii"]
    elif purpose == "edge_shifts":
        contacts = [contact, replace(contact, plastic=False)]
        ranges = [SHORT_ADHESION_RANGE, contact.rho]
    keys = ("preload", "hardness", "plastic")
    loadings = [{key: getattr(loaded, key) for key in keys} for loaded in contacts]
    return {"radii": radii, "loadings": loadings, "ranges": ranges}


def filter_settings(configuration: Mapping[str, Any], purpose: str) -> dict[str, Any]:
    """Return the settings of masters and filters on each side, and the contacts per row."""
    settings = PURPOSES[purpose]
    sides = {
        side: {
            name: get_key(configuration, key)
            for name, key in master_keys(configuration, settings.section, side).items()
        }
        for side in settings.sides
    }
    return {"contacts_per_row": get_key(configuration, settings.contacts_key), "sides": sides}


def filter_megabytes(configuration: Mapping[str, Any], purpose: str) -> int:
    """Return the memory of a job that filters masters, by the larger of its two masters."""
    sides = filter_settings(configuration, purpose)["sides"]
    return master_megabytes(max(side["pixels"] for side in sides.values()))
