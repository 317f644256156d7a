"""The purposes for which forces on filtered masters are computed, with their settings."""

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from hardcontact.config.configuration import get_key, master_keys, study_contact
from hardcontact.config.limits import master_megabytes
from hardcontact.contact.numerical_limits import SHORT_ADHESION_RANGE
from hardcontact.surfaces.synthesis import SIDES

#: Realizations in one job: few enough to keep all cores busy, but so many that a job takes much
#: longer than its start, half a second.
MASTERS_CHUNK = 5


class Purpose(NamedTuple):
    """The settings of masters of one purpose, with keys of the configuration."""

    section: str  #: Section of the pixels and cutoffs of masters.
    contacts_key: str  #: Key of the number of contacts per row.
    realizations_key: str  #: Key of the number of masters of a surface.
    realizations_in_job: int = MASTERS_CHUNK
    masters_are_files: bool = False  #: Whether masters are files of the store.
    samples_spectra: bool = False  #: Whether each master has a sampled spectrum.
    rough_sphere: bool = True  #: Whether a study with a rough sphere uses it here.
    stream: str = "variant"  #: Name of the random numbers in masters.
    sides: Sequence[str] = SIDES
    radii_key: str = "sphere.radius"  #: Key of the radius of the sphere, or of several radii.
    preload_shares: Sequence[float] = (1,)  #: Loads, relative to the preload of the study.
    plastic: Sequence[bool] = (True,)  #: Whether contact pixels yield.
    further_ranges: Sequence[float] = ()  #: Ranges of adhesion in nm, besides that of the study.


#: By the name in the paths of their forces.
PURPOSES = {
    # The band of the study.
    "scales": Purpose(
        "scales", "contact.contacts_per_row", "scales.realizations", realizations_in_job=1,
        masters_are_files=True, stream="master",
    ),
    # The same with sampled spectra, of measured surfaces only, and with the same random numbers.
    "sampled": Purpose(
        "scales", "contact.contacts_per_row", "scales.realizations", realizations_in_job=1,
        samples_spectra=True, stream="master",
    ),
    # The edges of each set of substitutes.
    "sets": Purpose("sets", "sets.contacts_per_row", "sets.realizations"),
    # How the edges depend on radius and load, on a smooth sphere. At an eighth of the preload the
    # contact still has some 30 pixels; larger loads move short edges beyond the cutoffs of sets.
    "exponents": Purpose(
        "sets", "sets.contacts_per_row", "exponents.realizations", rough_sphere=False,
        radii_key="exponents.radii", preload_shares=(1 / 8, 1),
    ),
    # The short edge with and without plasticity and a long range of adhesion.
    "edge_shifts": Purpose(
        "sets", "sets.contacts_per_row", "exponents.realizations", sides=("short",),
        plastic=(True, False), further_ranges=(SHORT_ADHESION_RANGE,),
    ),
}  # fmt: skip


def filtered_settings(configuration: Mapping[str, Any], purpose: str) -> dict[str, Any]:
    """Return the settings of the forces on the masters of a purpose; lengths are in nm."""
    settings = PURPOSES[purpose]
    contact = study_contact(configuration)
    radii = get_key(configuration, settings.radii_key)
    return {
        "seed": configuration["seed"],
        "stream": settings.stream,
        "window": contact.window,
        "contacts_per_row": get_key(configuration, settings.contacts_key),
        "sides": {
            side: {
                name: get_key(configuration, key)
                for name, key in master_keys(configuration, settings.section, side).items()
            }
            for side in settings.sides
        },
        "radii": radii if isinstance(radii, list) else [radii],
        "loadings": [
            {"preload": share * contact.preload, "hardness": contact.hardness, "plastic": plastic}
            for share in settings.preload_shares
            for plastic in settings.plastic
        ],
        "ranges": [*settings.further_ranges, contact.rho],
    }


def filter_megabytes(settings: Mapping[str, Any]) -> int:
    """Return the memory (MB) of a job that filters masters, by its largest master."""
    return master_megabytes(max(side["pixels"] for side in settings["sides"].values()))
