"""The study's choices and what else they could be, one at a time: the variants of robustness."""

from collections.abc import Mapping
from dataclasses import asdict, dataclass, replace
from typing import Any

from hardcontact.base.units import printed, token
from hardcontact.config.patterns import STUDY_VARIANT
from hardcontact.config.selection import Selection
from hardcontact.contact.contact import Contact

#: What rms slope and curvature of Table 1 are read as; the paper defines neither.
TABLE1_DEFINITIONS = {"slope": "gradient", "curvature": "half_laplacian"}
#: The other reading of the curvature.
OTHER_CURVATURE = "laplacian"
#: The sphere of the critical band in place of that of the study.
OTHER_PROBE = {"rough": "smooth", "smooth": "rough"}


@dataclass(frozen=True)
class SurfaceVariant:
    """One way to make substitutes; None stands for what the study itself takes."""

    name: str  #: As it stands in paths.
    label: str  #: As it is printed.
    group: str  #: The choice that it is of.
    surface: str | None = None  #: The one surface that is made so.
    curvature: str | None = None  #: Reading of the curvature of Table 1.
    skewness: float | None = None  #: Skewness of the heights.

    @property
    def spectrum(self) -> str:
        """Name of the way to make substitutes whose spectrum and conditioning this one has."""
        return STUDY_VARIANT if self.curvature is None else self.name

    @property
    def table1(self) -> dict[str, str]:
        """What slope and curvature of Table 1 are read as."""
        return TABLE1_DEFINITIONS | ({"curvature": self.curvature} if self.curvature else {})

    def heights(self, skewness: float) -> float:
        """Return the skewness of heights made so, given that of the surface in the study."""
        return skewness if self.skewness is None else self.skewness

    def changes(self, selection: Selection, surface: str) -> bool:
        """Return whether a surface made so differs from that of the study."""
        if selection.basis[surface] == "measured" or self.surface not in (None, surface):
            return False
        if self.curvature is not None:
            return selection.reads_curvature(surface)
        return self.skewness not in (None, selection.skewness(surface))


@dataclass(frozen=True)
class Variant:
    """The study with one other choice; variants of one choice are a group."""

    name: str
    label: str
    group: str
    variant: Mapping[str, str]  #: Name of the `SurfaceVariant` of each substrate.
    contact: Contact
    probe: str  #: The sphere of the critical band, rough or smooth.

    def parameters(self) -> dict[str, Any]:
        """Return it as parameters of a rule, with the name of the load of its contact."""
        named = {name: value for name, value in asdict(self).items() if name != "contact"}
        return named | {"load": self.contact.load}


def study_contact(configuration: Mapping[str, Any]) -> Contact:
    """Return the contact of the study."""
    return Contact(
        **configuration["contact"],
        radius=configuration["sphere"]["radius"],
        range=configuration["scales"]["range"],
    )


def surface_variants(configuration: Mapping[str, Any]) -> dict[str, SurfaceVariant]:
    """Return the ways to make substitutes by their names, that of the study first."""
    other, heights = OTHER_CURVATURE, configuration["robustness"]["heights"]
    made = [SurfaceVariant(STUDY_VARIANT, "as the study", "baseline")]
    made.append(
        SurfaceVariant(other, f"curvature of Table 1: {other}", "curvature", curvature=other)
    )
    for value in heights["skewness"]:
        name, label = f"skewness{value:+.12g}", f"skewness {value:+.12g}"
        made.append(SurfaceVariant(name, label, "heights", heights["surface"], skewness=value))
    return {variant.name: variant for variant in made}


def variants(configuration: Mapping[str, Any], selection: Selection) -> list[Variant]:
    """Return the variants of robustness, the study itself first."""
    contact, substrates = study_contact(configuration), selection.substrates
    probe = "rough" if configuration["scales"]["sphere_roughness"] else "smooth"
    study, group = dict.fromkeys(substrates, STUDY_VARIANT), "baseline"
    baseline = Variant(group, "as the study", group, study, contact, probe)
    made = [baseline]
    _, *others = surface_variants(configuration).values()
    for other in others:
        surface = f"{selection.labels[other.surface]}: " if other.surface else ""
        changed = {name: other.name for name in substrates if other.changes(selection, name)}
        made.append(
            Variant(other.name, surface + other.label, other.group, study | changed, contact, probe)
        )
    probe = OTHER_PROBE[probe]
    label = f"{probe} sphere in Fig. 6"
    made.append(Variant(f"{probe}_sphere", label, "sphere", study, contact, probe))
    for quantity, values, unit, shown in (
        ("preload", configuration["robustness"]["preloads"], "uN", "N"),
        ("hardness", configuration["robustness"]["hardnesses"], "GPa", "Pa"),
    ):
        made += [
            replace(
                baseline,
                name=f"{quantity}-{token(value, unit)}",
                label=f"{quantity} {printed(value, shown)}",
                group=quantity,
                contact=replace(contact, **{quantity: value}),
            )
            for value in values
        ]
    return made
