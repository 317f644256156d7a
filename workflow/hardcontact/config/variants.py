"""The variants of robustness: the study with one other choice at a time."""

from collections.abc import Mapping
from dataclasses import asdict, dataclass, replace
from typing import Any

from hardcontact.base.units import format_exact, path_token
from hardcontact.config.patterns import STUDY_VARIANT
from hardcontact.config.selection import Selection
from hardcontact.contact.contact import Contact

#: The readings of rms slope and curvature in Table 1; the paper defines neither.
TABLE1_DEFINITIONS = {"slope": "gradient", "curvature": "half_laplacian"}
#: The other reading of the curvature.
OTHER_CURVATURE = "laplacian"
#: The sphere of the critical band in place of that of the study.
OTHER_PROBE = {"rough": "smooth", "smooth": "rough"}


@dataclass(frozen=True)
class SurfaceVariant:
    """One way to make substitutes; None means the choice of the study itself."""

    name: str  #: The name in paths.
    label: str  #: The printed name.
    group: str  #: The choice that this variant changes.
    surface: str | None = None  #: The only surface that this variant changes.
    curvature: str | None = None  #: Reading of the curvature of Table 1.
    skewness: float | None = None  #: Skewness of the heights.

    @property
    def spectrum(self) -> str:
        """Name of the surface variant with the same spectrum and conditioning."""
        return STUDY_VARIANT if self.curvature is None else self.name

    @property
    def table1_definitions(self) -> dict[str, str]:
        """The readings of slope and curvature in Table 1."""
        return TABLE1_DEFINITIONS | ({"curvature": self.curvature} if self.curvature else {})

    def heights(self, skewness: float) -> float:
        """Return the skewness of heights, given the skewness of the surface in the study."""
        return skewness if self.skewness is None else self.skewness

    def changes(self, selection: Selection, surface: str) -> bool:
        """Return True if the variant of a surface differs from the study's surface."""
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
        values = {name: value for name, value in asdict(self).items() if name != "contact"}
        return values | {"load": self.contact.load}


def study_contact(configuration: Mapping[str, Any]) -> Contact:
    """Return the contact of the study."""
    return Contact(
        **configuration["contact"],
        radius=configuration["sphere"]["radius"],
        range=configuration["scales"]["range"],
    )


def surface_variants(configuration: Mapping[str, Any]) -> dict[str, SurfaceVariant]:
    """Return the ways to make substitutes by their names, the study's own way first."""
    curvature = OTHER_CURVATURE
    heights = configuration["robustness"]["heights"]
    choices = [SurfaceVariant(STUDY_VARIANT, "as the study", "baseline")]
    choices.append(
        SurfaceVariant(
            curvature, f"curvature of Table 1: {curvature}", "curvature", curvature=curvature
        )
    )
    for value in heights["skewness"]:
        name = f"skewness{value:+.12g}"
        label = f"skewness {value:+.12g}"
        choices.append(SurfaceVariant(name, label, "heights", heights["surface"], skewness=value))
    return {variant.name: variant for variant in choices}


def variants(configuration: Mapping[str, Any], selection: Selection) -> list[Variant]:
    """Return the variants of robustness, the study itself first."""
    contact = study_contact(configuration)
    substrates = selection.substrates
    probe = "rough" if configuration["scales"]["sphere_roughness"] else "smooth"
    study = dict.fromkeys(substrates, STUDY_VARIANT)
    group = "baseline"
    baseline = Variant(group, "as the study", group, study, contact, probe)
    variants_made = [baseline]
    _, *surface_choices = surface_variants(configuration).values()
    for choice in surface_choices:
        surface = f"{selection.labels[choice.surface]}: " if choice.surface else ""
        changed_surfaces = {
            name: choice.name for name in substrates if choice.changes(selection, name)
        }
        variants_made.append(
            Variant(
                choice.name,
                surface + choice.label,
                choice.group,
                study | changed_surfaces,
                contact,
                probe,
            )
        )
    probe = OTHER_PROBE[probe]
    label = f"{probe} sphere in Fig. 6"
    variants_made.append(Variant(f"{probe}_sphere", label, "sphere", study, contact, probe))
    for quantity, values, unit, printed_unit in (
        ("preload", configuration["robustness"]["preloads"], "uN", "N"),
        ("hardness", configuration["robustness"]["hardnesses"], "GPa", "Pa"),
    ):
        variants_made += [
            replace(
                baseline,
                name=f"{quantity}-{path_token(value, unit)}",
                label=f"{quantity} {format_exact(value, printed_unit)}",
                group=quantity,
                contact=replace(contact, **{quantity: value}),
            )
            for value in values
        ]
    return variants_made
