"""Configurations: a `config` has quantities as written, a `study` has them as numbers."""

from collections.abc import Mapping
from functools import reduce
from operator import getitem
from typing import Any

from pydantic.fields import FieldInfo

from hardcontact.base.units import format_exact
from hardcontact.config.faults import section_model, validate
from hardcontact.config.key_types import Quantity
from hardcontact.config.keys import PAPER, QUICK_SUFFIX, Study
from hardcontact.contact.contact import Contact

#: The key, and the name in print, of each quantity of a contact.
CONTACT_QUANTITIES = {
    "radius": ("sphere.radius", "radius of the sphere"),
    "hardness": ("contact.hardness", "hardness"),
    "preload": ("contact.preload", "preload"),
    "range": ("adhesion.range", "range of adhesion"),
    "work": ("adhesion.work", "work of adhesion"),
}


def key_field(key: str) -> FieldInfo:
    """Return the declaration of a key, such as ``"sphere.radius"``."""
    *sections, name = key.split(".")
    return section_model(Study, sections).model_fields[name]


def quantity_type(key: str) -> Quantity:
    """Return the unit and the bounds of a key that is a quantity."""
    return next(item for item in key_field(key).metadata if isinstance(item, Quantity))


def numeric_configuration(config: object, prefix: str = "") -> dict[str, Any]:
    """Return a configuration with all keys, and with quantities as numbers in nm, N, Pa, J/m²."""
    # `scans` may be a word in place of a list, of which pydantic would warn.
    return validate(Study, config, f"{prefix}config key ").model_dump(warnings=False)


def get_key(tree: Mapping[str, Any], key: str) -> Any:
    """Return the value of a key such as ``"sphere.radius"``."""
    return reduce(getitem, key.split("."), tree)


def merge_overlay(config: Mapping[str, Any], overlay: Mapping[str, Any]) -> dict[str, Any]:
    """Return a configuration with the values of an overlay, merged as Snakemake does."""
    merged = dict(config)
    for key, value in overlay.items():
        section = merged.get(key)
        if isinstance(section, Mapping) and isinstance(value, Mapping):
            value = merge_overlay(section, value)
        merged[key] = value
    return merged


def apply_effort(config: Mapping[str, Any]) -> dict[str, Any]:
    """Return the configuration that a run uses.

    At quick effort, keys of the section `quick` replace others, and the names of study and store
    end in QUICK_SUFFIX.
    """
    quick = config.get("quick")
    if config.get("effort") != "quick" or not isinstance(quick, dict):
        return dict(config)
    merged = merge_overlay(config, quick)
    for name in ("study", "store"):
        merged[name] = str(merged[name]).removesuffix(QUICK_SUFFIX) + QUICK_SUFFIX
    return merged


def is_paper_study(study: Mapping[str, Any]) -> bool:
    """Return whether a study is compared with the paper, and not about your surfaces."""
    return bool(study["published"] == PAPER)


def set_keys(config: Mapping[str, Any], values: Mapping[str, Any]) -> dict[str, Any]:
    """Return a copy of a configuration with new values, by keys such as ``"sphere.radius"``."""
    updated = dict(config)
    for key, value in values.items():
        *sections, name = key.split(".")
        section = updated
        for section_name in sections:
            section[section_name] = dict(section.get(section_name, {}))
            section = section[section_name]
        section[name] = value
    return updated


def contact_arguments(study: Mapping[str, Any]) -> dict[str, Any]:
    """Return the arguments of class Contact from the keys, without range and work of adhesion."""
    return {**study["contact"], "radius": study["sphere"]["radius"]}


def study_contact(study: Mapping[str, Any]) -> Contact:
    """Return the contact of the study, without a work of adhesion: forces are those at 1 J/m²."""
    return Contact(**contact_arguments(study), rho=study["adhesion"]["range"])


def reading_arguments(study: Mapping[str, Any]) -> dict[str, Any]:
    """Return the arguments of `read_scan` that all scans of a study share."""
    return {name: study["scan"][name] for name in ("undefined_pixels", "unit", "map_size", "mask")}


def master_keys(study: Mapping[str, Any], section: str, side: str) -> dict[str, str]:
    """Return the key of each setting of the masters of a side, by the name of the setting.

    The section `sets` has only some settings; the others are in `band`. For example, on the short
    side of `sets`, ``pixels`` is the key ``sets.short.pixels``, but ``transition`` is
    ``band.short.transition``.
    """
    return {
        name: f"{section_name}.{side}.{name}"
        for section_name in ("band", section)
        for name in study[section_name][side]
    }


def contact_words(study: Mapping[str, Any]) -> dict[str, str]:
    """Return the surface of the sphere and CONTACT_QUANTITIES as printed, by their names."""
    words = {"sphere": str(study["sphere"]["surface"])}
    for key, name in CONTACT_QUANTITIES.values():
        words[name] = format_exact(get_key(study, key), quantity_type(key).unit)
    return words


def assumed_quantities(study: Mapping[str, Any]) -> list[str]:
    """Return the names of CONTACT_QUANTITIES with the paper's value that the user did not give."""
    paper = Study().model_dump(warnings=False)
    return [
        name
        for quantity, (key, name) in CONTACT_QUANTITIES.items()
        if quantity not in study["given_quantities"] and get_key(study, key) == get_key(paper, key)
    ]
