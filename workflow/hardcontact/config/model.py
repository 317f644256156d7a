"""The model of a study: its keys, and the rules across them."""

import os
from pathlib import Path
from typing import Any

from pydantic import model_validator
from pydantic.fields import FieldInfo

from hardcontact.config.faults import key_fault, raise_faults, section_model, validate
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
#: Minimum number of positions on a rough sphere that touch each surface of the user. With 16 an
#: interval is 1.1 times as wide as with many positions; each position costs computing time.
SPHERE_POSITIONS = 16
#: Contacts per row at each of several positions.
POSITION_CONTACTS_PER_ROW = 6
#: By the quantities of a contact: their keys, and their names in print.
CONTACT_QUANTITIES = {
    "radius": ("sphere.radius", "radius of the sphere"),
    "hardness": ("contact.hardness", "hardness"),
    "preload": ("contact.preload", "preload"),
    "range": ("adhesion.range", "range of adhesion"),
    "work": ("adhesion.work", "work of adhesion"),
}


class Study(StudyKeys):
    """The keys of a study, with the rules across keys."""

    @model_validator(mode="after")
    def _check_rules_across_keys(self) -> "Study":
        faults = self._effort_faults() + self._folder_faults()
        faults += self._paper_faults() if self.published == PAPER else self._sphere_faults()
        raise_faults(faults)
        return self

    def _effort_faults(self) -> list[str]:
        """Return the faults of the effort and of the names that depend on it."""
        faults = []
        if self.effort == "quick" and not self.quick:
            accepted = "full, because the section quick has no keys"
            found = "quick (the quick study of the paper: --configfile config/quick.yaml)"
            faults.append(key_fault("effort", accepted, found))
        repeated_names = sorted({"study", "store"} & self.quick.keys())
        if repeated_names:
            accepted = f"neither study nor store, whose names at quick effort end in {QUICK_SUFFIX}"
            faults.append(key_fault("quick", accepted, " and ".join(repeated_names)))
        for key in ("study", "store"):
            name = getattr(self, key)
            if self.quick and self.effort != "quick" and name.endswith(QUICK_SUFFIX):
                accepted = f"a name without the end {QUICK_SUFFIX}, which marks effort: quick"
                faults.append(key_fault(key, accepted, name))
        return faults

    def _folder_faults(self) -> list[str]:
        """Return the faults of the store relative to the results."""
        faults = []
        folder = f"results/{self.study}"
        results = Path(os.path.realpath(folder))
        store = Path(os.path.realpath(self.store))
        if results.is_relative_to(store) or store.is_relative_to(results):
            faults.append(key_fault("store", f"a folder apart from {folder}", self.store))
        if store.is_relative_to(os.getcwd()) and not store.is_relative_to(results.parent):
            accepted = "a folder in results or outside of the project"
            faults.append(key_fault("store", accepted, self.store))
        paths = Path(folder), Path(self.store)
        for link in dict.fromkeys(part for path in paths for part in (path, *path.parents)):
            if link.is_symlink() and not link.exists():
                found = f"{link}, a link to {link.readlink()}, which is missing"
                faults.append(key_fault("study and store", "folders, or links to folders", found))
        return faults

    def _paper_faults(self) -> list[str]:
        """Return the faults of a study that is compared with the paper."""
        if self.forces != NONE:
            return [key_fault("forces", f"{NONE} with published: {PAPER}", self.forces)]
        return []

    def _sphere_faults(self) -> list[str]:
        """Return the fault of a smooth sphere that is to have roughness."""
        if self.sphere.surface == SMOOTH_SPHERE and self.scales.sphere_roughness:
            accepted = f"false with sphere.surface: {SMOOTH_SPHERE}"
            return [key_fault("scales.sphere_roughness", accepted, "true")]
        return []


def key_field(key: str) -> FieldInfo:
    """Return the declaration of a key, such as ``"sphere.radius"``."""
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
