"""The study's choices and what else they could be, one at a time: the variants of robustness."""

from collections.abc import Mapping
from dataclasses import asdict, dataclass, replace
from typing import Any

from hardcontact.config.patterns import STUDY_VARIANT
from hardcontact.config.selection import Selection
from hardcontact.contact.contact import Contact
from hardcontact.numbers.units import printed, token

OTHER_CURVATURE = {"half_laplacian": "laplacian", "laplacian": "half_laplacian"}
OTHER_PROBE = {"rough": "smooth", "smooth": "rough"}


@dataclass(frozen=True)
class SurfaceVariant:
    """One way to make substitutes; None stands for what the study itself takes.

    The name stands in paths, the label in print, and the group says which choice it is of. One
    surface alone may be made so; the curvature of Table 1 may be read as another, or heights have
    another skewness.
    """

    name: str
    label: str
    group: str
    surface: str | None = None
    curvature: str | None = None
    skewness: float | None = None

    @property
    def spectrum(self) -> str:
        """Name of the way to make substitutes whose spectrum and conditioning this one has."""
        return STUDY_VARIANT if self.curvature is None else self.name

    def table1(self, definitions: Mapping[str, str]) -> dict[str, str]:
        """Return what slope and curvature of Table 1 are read as, given the study's reading."""
        other = {} if self.curvature is None else {"curvature": self.curvature}
        return dict(definitions) | other

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
    """The study with one other choice, in files and in print; variants of one choice are a group.

    `variant` names that of each substrate; the contact has another load, and the probe, rough or
    smooth, is the sphere of the critical band.
    """

    name: str
    label: str
    group: str
    variant: Mapping[str, str]
    contact: Contact
    probe: str

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
    curvature = OTHER_CURVATURE[configuration["topography"]["curvature"]]
    heights = configuration["robustness"]["heights"]
    label = f"curvature of Table 1: {curvature.replace('_', ' ')}"
    made = [
        SurfaceVariant(STUDY_VARIANT, "as the study", "baseline"),
        SurfaceVariant(curvature, label, "curvature", curvature=curvature),
    ]
    for value in heights["skewness"]:
        name, label = f"skewness{value:+g}", f"skewness {value:+g}"
        made.append(SurfaceVariant(name, label, "heights", heights["surface"], skewness=value))
    return {variant.name: variant for variant in made}


def variants(configuration: Mapping[str, Any], selection: Selection) -> list[Variant]:
    """Return the variants of robustness, the study itself first."""
    baseline = Variant(
        "baseline",
        "as the study",
        "baseline",
        dict.fromkeys(selection.substrates, STUDY_VARIANT),
        study_contact(configuration),
        "rough" if configuration["scales"]["sphere_roughness"] else "smooth",
    )
    made = [baseline]
    _, *others = surface_variants(configuration).values()
    for one in others:
        label = f"{selection.labels[one.surface]}: {one.label}" if one.surface else one.label
        of_surface = {
            surface: one.name if one.changes(selection, surface) else STUDY_VARIANT
            for surface in selection.substrates
        }
        made.append(
            replace(baseline, name=one.name, label=label, group=one.group, variant=of_surface)
        )
    probe = OTHER_PROBE[baseline.probe]
    name, label = f"{probe}_sphere", f"{probe} sphere in Fig. 6"
    made.append(replace(baseline, name=name, label=label, group="sphere", probe=probe))
    for preload in configuration["robustness"]["preloads"]:
        name, label = f"preload-{token(preload, 'uN')}", f"preload {printed(preload, 'N')}"
        contact = replace(baseline.contact, preload=preload)
        made.append(replace(baseline, name=name, label=label, group="preload", contact=contact))
    for hardness in configuration["robustness"]["hardnesses"]:
        name, label = f"hardness-{token(hardness, 'GPa')}", f"hardness {printed(hardness, 'Pa')}"
        contact = replace(baseline.contact, hardness=hardness)
        made.append(replace(baseline, name=name, label=label, group="hardness", contact=contact))
    return made
