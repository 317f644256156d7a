"""The study's choices and what else they could be, one at a time: the variants of robustness."""

from collections.abc import Mapping
from dataclasses import asdict, dataclass, replace
from typing import Any

from hardcontact.contact.bearing_area import NamedLoad
from hardcontact.study.patterns import STUDY_VARIANT
from hardcontact.study.selection import Selection
from hardcontact.study.units import magnitude, token

__all__ = ["SurfaceVariant", "Variant", "named_load", "surface_variants", "variants"]

OTHER_CURVATURE = {"half_laplacian": "laplacian", "laplacian": "half_laplacian"}
OTHER_PROBE = {"rough": "smooth", "smooth": "rough"}


@dataclass(frozen=True)
class SurfaceVariant:
    """One way to make substitutes; None stands for what the study itself takes.

    Attributes
    ----------
    name : str
        As it stands in paths.
    curvature : str or None
        What the curvature of Table 1 is read as.
    skewness : float or None
        Skewness of the heights.
    """

    name: str
    curvature: str | None = None
    skewness: float | None = None

    def parameters(self, definitions: Mapping[str, str], skewness: float) -> dict[str, Any]:
        """Return what a substitute is made with, given the study's own choices.

        Parameters
        ----------
        definitions : dict
            What slope and curvature of Table 1 are read as.
        skewness : float
            Of the heights of the surface.
        """
        other = {} if self.curvature is None else {"curvature": self.curvature}
        return {
            "table1": dict(definitions) | other,
            "skewness": skewness if self.skewness is None else self.skewness,
        }

    def changes(self, selection: Selection, surface: str) -> bool:
        """Return whether a surface made so differs from that of the study."""
        if selection.basis[surface] == "measured":
            return False
        if self.curvature is not None:
            return selection.reads_curvature(surface)
        return self.skewness not in (None, selection.skewness(surface))


@dataclass(frozen=True)
class Variant:
    """The study with one other choice.

    Attributes
    ----------
    name, label : str
        In files and in print.
    group : str
        Variants of one choice.
    variant : dict
        Variant of each substrate.
    load : NamedLoad
        On every contact.
    probe : str
        Sphere of the critical band, smooth or rough.
    """

    name: str
    label: str
    group: str
    variant: Mapping[str, str]
    load: NamedLoad
    probe: str

    def parameters(self) -> dict[str, Any]:
        """Return it as parameters of a rule, with the load by its name."""
        return asdict(self) | {"load": self.load["name"]}


def named_load(preload: str, hardness: str) -> NamedLoad:
    """Return a load from the texts of the configuration, such as ``"10 uN"`` and ``"25 GPa"``."""
    return NamedLoad(
        name=f"H{token(hardness, 'GPa')}-F{token(preload, 'uN')}",
        preload=magnitude(preload, "N"),
        hardness=magnitude(hardness, "Pa"),
    )


def surface_variants(configuration: Mapping[str, Any]) -> dict[str, SurfaceVariant]:
    """Return the ways to make substitutes by their names, that of the study first."""
    curvature = OTHER_CURVATURE[configuration["topography"]["curvature"]]
    others = [SurfaceVariant(curvature, curvature=curvature)] + [
        SurfaceVariant(f"skewness-{value:g}", skewness=float(value))
        for value in configuration["robustness"]["skewness"]
    ]
    return {variant.name: variant for variant in (SurfaceVariant(STUDY_VARIANT), *others)}


def variants(configuration: Mapping[str, Any], selection: Selection) -> list[Variant]:
    """Return the variants of robustness, the study itself first.

    Parameters
    ----------
    configuration : dict
        With its quantities as the texts that the user wrote: they name loads.
    selection : Selection
        Surfaces of the study.
    """
    contact, other = configuration["contact"], configuration["robustness"]
    baseline = Variant(
        "baseline",
        "as the study",
        "baseline",
        dict.fromkeys(selection.substrates, STUDY_VARIANT),
        named_load(contact["preload"], contact["hardness"]),
        "rough" if configuration["scales"]["sphere_roughness"] else "smooth",
    )
    probe = OTHER_PROBE[baseline.probe]
    return [
        baseline,
        *_of_surfaces(configuration, selection, baseline),
        _with(baseline, f"{probe}_sphere", f"{probe} sphere in Fig. 6", "sphere", probe=probe),
        *(
            _loaded(baseline, "preload", text, "uN", named_load(text, contact["hardness"]))
            for text in other["preloads"]
        ),
        *(
            _loaded(baseline, "hardness", text, "GPa", named_load(contact["preload"], text))
            for text in other["hardnesses"]
        ),
    ]


def _with(baseline: Variant, name: str, label: str, group: str, **choice: Any) -> Variant:
    """Return the study with another name and one other choice."""
    return replace(baseline, name=name, label=label, group=group, **choice)


def _loaded(baseline: Variant, group: str, text: str, unit: str, other: NamedLoad) -> Variant:
    label = f"{group} {text.replace(' u', ' µ')}"
    return _with(baseline, f"{group}-{token(text, unit)}", label, group, load=other)


def _of_surfaces(
    configuration: Mapping[str, Any], selection: Selection, baseline: Variant
) -> list[Variant]:
    """Return a variant for each other way to make substitutes."""
    made = []
    for name, one in surface_variants(configuration).items():
        if one.curvature is not None:
            label, group = f"curvature of Table 1: {name.replace('_', ' ')}", "curvature"
        elif one.skewness is not None:
            label, group = f"heights of skewness {one.skewness:g}", "heights"
        else:
            continue
        of_surface = {
            surface: name if one.changes(selection, surface) else STUDY_VARIANT
            for surface in selection.substrates
        }
        made.append(_with(baseline, name, label, group, variant=of_surface))
    return made
