"""The purposes of forces on masters: which masters and which contacts each of them needs.

"Forces on masters" in workflow/README.md has a table of the purposes, and follows one of them from
its keys to its dataset.
"""

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from hardcontact.config.configuration import get_key, master_keys, study_contact
from hardcontact.contact.contact import Contact
from hardcontact.contact.numerical_limits import SHORT_ADHESION_RANGE
from hardcontact.surfaces.synthesis import SETS_STREAM, SIDES, STUDY_STREAM

#: Masters, or whole surfaces, in one job: few enough to keep all cores busy, but so many that a job
#: takes much longer than its start, half a second.
MASTERS_PER_JOB = 5
#: The smaller preload of `exponents`, relative to the study's. At an eighth of the paper's preload
#: a contact still has some 30 pixels on short-edge masters, and 3 on long-edge ones. Larger
#: preloads than the study's move short edges beyond the cutoffs of sets.
SMALL_PRELOAD_SHARE = 1 / 8


class Purpose(NamedTuple):
    """Which masters one purpose needs in a study, and which contacts are made on them."""

    # Masters.
    master_count: int  #: Of each substrate and side.
    #: By side the settings of its masters: pixels, cutoffs and transition, on the long side tiles.
    sides: Mapping[str, Mapping[str, Any]]
    stream: str  #: STUDY_STREAM or SETS_STREAM: which random numbers masters have.
    # Contacts. Forces are computed for all radii, loadings and ranges.
    contacts_per_row: int
    radii: Sequence[float]  #: Of the sphere, in nm.
    loadings: Sequence[Mapping[str, Any]]  #: Each has a preload, a hardness and a contact model.
    ranges: Sequence[float]  #: Ranges of adhesion in nm.
    has_rough_sphere: bool
    # How masters are made.
    #: Whether each master has another spectrum, sampled within the uncertainty of the scans.
    samples_spectra: bool = False
    #: Whether the rule synthesize_masters writes the masters into the store. Otherwise the job that
    #: computes the forces makes the masters and forgets them.
    masters_are_files: bool = False
    masters_per_job: int = MASTERS_PER_JOB


def master_purposes(study: Mapping[str, Any]) -> dict[str, Purpose]:
    """Return the purposes by the name in the paths of their forces.

    `edges` and `sampled` have the same random numbers, so that their forces differ only because
    spectra are sampled. `sets` has others, because sets are other random choices than the study.
    `exponents` and `edge_shifts` have the numbers and pixels of `sets`, so the first of its
    masters.
    """
    contact = study_contact(study)
    band_sides = _master_settings(study, "band")
    set_sides = _master_settings(study, "sets")
    has_rough_sphere = study["band"]["sphere_roughness"]
    set_contacts = study["sets"]["contacts_per_row"]
    loading, rigid_loading = _loading(contact), _loading(contact, plastic=False)
    return {
        # The edges of the study.
        "edges": Purpose(
            master_count=study["band"]["masters"], sides=band_sides, stream=STUDY_STREAM,
            contacts_per_row=contact.contacts_per_row, radii=[contact.radius], loadings=[loading],
            ranges=[contact.rho], has_rough_sphere=has_rough_sphere,
            masters_are_files=True, masters_per_job=1,
        ),
        # How far the uncertain spectra of measured surfaces move these edges.
        "sampled": Purpose(
            master_count=study["band"]["masters"], sides=band_sides, stream=STUDY_STREAM,
            contacts_per_row=contact.contacts_per_row, radii=[contact.radius], loadings=[loading],
            ranges=[contact.rho], has_rough_sphere=has_rough_sphere,
            samples_spectra=True, masters_per_job=1,
        ),
        # The edges of each set.
        "sets": Purpose(
            master_count=study["sets"]["masters"], sides=set_sides, stream=SETS_STREAM,
            contacts_per_row=set_contacts, radii=[contact.radius], loadings=[loading],
            ranges=[contact.rho], has_rough_sphere=has_rough_sphere,
        ),
        # How force and edges depend on radius and preload, on a smooth sphere.
        "exponents": Purpose(
            master_count=study["exponents"]["masters"], sides=set_sides, stream=SETS_STREAM,
            contacts_per_row=set_contacts, radii=study["exponents"]["radii"],
            loadings=[_loading(contact, SMALL_PRELOAD_SHARE), loading], ranges=[contact.rho],
            has_rough_sphere=False,
        ),
        # How far plasticity, and a long range of adhesion, move the short edge.
        "edge_shifts": Purpose(
            master_count=study["exponents"]["masters"], sides={"short": set_sides["short"]},
            stream=SETS_STREAM, contacts_per_row=set_contacts, radii=[contact.radius],
            loadings=[loading, rigid_loading], ranges=[SHORT_ADHESION_RANGE, contact.rho],
            has_rough_sphere=has_rough_sphere,
        ),
    }  # fmt: skip


def _master_settings(study: Mapping[str, Any], section: str) -> dict[str, dict[str, Any]]:
    """Return the settings of the masters of a section by side; `band` has those that it lacks."""
    return {
        side: {name: get_key(study, key) for name, key in master_keys(study, section, side).items()}
        for side in SIDES
    }


def _loading(contact: Contact, preload_share: float = 1, plastic: bool = True) -> dict[str, Any]:
    """Return the loading of a contact at a share of its preload."""
    preload = preload_share * contact.preload
    return {"preload": preload, "hardness": contact.hardness, "plastic": plastic}
