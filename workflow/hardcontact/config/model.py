"""The model of a study: its keys, and the rules across them."""

import os
from collections.abc import Iterator
from itertools import chain
from pathlib import Path
from typing import Any

from pydantic import model_validator
from pydantic.fields import FieldInfo

from hardcontact.config.faults import (
    Limit,
    refuse_lines,
    section_model,
    validate,
    violation_messages,
)
from hardcontact.config.key_types import Quantity
from hardcontact.config.keys import StudyKeys

#: Value of the key `published` in a study that is compared with the paper.
PAPER = "paper"
#: Value of the keys of tables that a study does not have, and of `published` without the paper.
NONE = "none"
#: Value of the key `sphere.surface` of a sphere without roughness.
SMOOTH_SPHERE = "smooth"
#: End of the names of study and store at quick effort.
QUICK_SUFFIX = "-quick"


class Study(StudyKeys):
    """The keys of a study, with the rules across keys."""

    @model_validator(mode="after")
    def _check_rules_across_keys(self) -> "Study":
        refuse_lines(violation_messages(chain(self._name_limits(), self._published_limits())))
        return self

    def _name_limits(self) -> Iterator[Limit]:
        """Yield the limits of the effort and of the folders."""
        effort_in_words = "quick (the quick study of the paper: --configfile config/quick.yaml)"
        has_quick_keys = self.effort != "quick" or bool(self.quick)
        accepted = "full, because the section quick has no keys"
        yield Limit(has_quick_keys, "effort", accepted, effort_in_words)
        repeated_names = sorted({"study", "store"} & self.quick.keys())
        accepted = f"neither study nor store, whose names at quick effort end in {QUICK_SUFFIX}"
        yield Limit(not repeated_names, "quick", accepted, " and ".join(repeated_names))
        if self.quick and self.effort != "quick":
            accepted = f"a name without the end {QUICK_SUFFIX}, which marks effort: quick"
            for key, name in (("study", self.study), ("store", self.store)):
                yield Limit(not name.endswith(QUICK_SUFFIX), key, accepted, name)
        folder = f"results/{self.study}"
        results = Path(os.path.realpath(folder))
        store = Path(os.path.realpath(self.store))
        is_apart = not (results.is_relative_to(store) or store.is_relative_to(results))
        yield Limit(is_apart, "store", f"a folder apart from {folder}", self.store)
        is_in_project = store.is_relative_to(os.getcwd())
        is_allowed = store.is_relative_to(results.parent) or not is_in_project
        accepted = "a folder in results or outside of the project"
        yield Limit(is_allowed, "store", accepted, self.store)

    def _published_limits(self) -> Iterator[Limit]:
        """Yield the limits that depend on whether a study is compared with the paper."""
        if self.published == PAPER:
            forces = self.forces
            contacts = self.contact.count**2
            yield Limit(forces == NONE, "forces", f"{NONE} with published: {PAPER}", forces)
            accepted = f"at most contact.count squared = {contacts}"
            for name in ("elastic", "asperities"):
                number = getattr(self, name).contacts
                yield Limit(number <= contacts, f"{name}.contacts", accepted, number)
        elif self.sphere.surface == SMOOTH_SPHERE:
            accepted = f"false with sphere.surface: {SMOOTH_SPHERE}"
            has_roughness = self.scales.sphere_roughness
            yield Limit(not has_roughness, "scales.sphere_roughness", accepted, "true")


def key_field(key: str) -> FieldInfo:
    """Return what the model declares about a key, such as ``"sphere.radius"``."""
    *sections, name = key.split(".")
    return section_model(Study, sections).model_fields[name]


def quantity_type(key: str) -> Quantity:
    """Return the unit and the bounds of a key that is a quantity."""
    return next(item for item in key_field(key).metadata if isinstance(item, Quantity))


def numeric_configuration(config: object, prefix: str = "") -> dict[str, Any]:
    """Return a configuration, as read from YAML, with every quantity as a number.

    Lengths are in nm, forces in N, pressures in Pa, energies per area in J/m². Missing keys have
    their defaults. Raises ValueError with a line, after the prefix, for each key that is unknown or
    has a wrong type or unit, or is out of bounds.
    """
    # `scans` may be a word in place of a list, of which pydantic would warn.
    return validate(Study, config, f"{prefix}config key ").model_dump(warnings=False)
