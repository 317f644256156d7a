"""The parts of a study, and why its data do not allow the others."""

from collections.abc import Mapping
from typing import Any

__all__ = ["NONE", "PAPER", "SMOOTH", "left_out", "made"]

#: Value of the key `published` in a study that is compared with the paper.
PAPER = "paper"
#: What stands for a table that the study does not have.
NONE = "none"
#: Value of the key `sphere.surface` of a sphere without roughness.
SMOOTH = "smooth"

#: Targets of a study that is compared with the paper.
OF_PAPER = (
    "topography", "adhesion", "elastic", "plasticity", "asperities", "scales", "classical", "sets",
    "robustness", "claims", "figures", "pages", "answer", "insight",
)  # fmt: skip
#: Targets of a study of own surfaces; `fit` needs own forces.
OF_OWN_SURFACES = ("topography", "adhesion", "scales", "force", "fit", "answer")

#: Why a target belongs to a study that is compared with the paper.
REASONS = {
    "elastic": "its moduli and its work of adhesion are those of the paper's materials",
    "plasticity": "indents are computed for comparison with the paper's images of its sphere",
    "asperities": "patches are computed for comparison with statements of the paper",
    "classical": "classical models are fitted to the paper's forces",
    "sets": "sets are drawn from substitutes for the paper's surfaces",
    "robustness": "it varies how substitutes for the paper's surfaces are made",
    "claims": "claims are statements of the paper about its own surfaces",
    "figures": "the figures are the paper's; those of own surfaces are in the answer",
    "atomic": "it is computed on the reference surface of the paper",
    "insight": "its parts are made of substitutes for the paper's surfaces",
    "pages": "the pages tell of the paper's statements; the answer tells of own surfaces",
}
NO_FORCES = "a fit needs pull-off forces measured on these surfaces (config key forces)"


def made(configuration: Mapping[str, Any]) -> list[str]:
    """Return the targets that the data of a study allow, in their order."""
    if configuration["published"] == PAPER:
        return list(OF_PAPER)
    without = left_out(configuration)
    return [target for target in OF_OWN_SURFACES if target not in without]


def left_out(configuration: Mapping[str, Any]) -> dict[str, str]:
    """Return the reason for each target that the data of a study do not allow."""
    if configuration["published"] == PAPER:
        return {}
    of_forces = {"fit": NO_FORCES} if configuration["forces"] == NONE else {}
    return REASONS | of_forces
