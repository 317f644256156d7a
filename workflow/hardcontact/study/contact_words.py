"""What the contacts of own surfaces are computed for, in words, and what of it is the paper's."""

from collections.abc import Mapping
from typing import Any

from hardcontact.study.units import magnitude, printed

__all__ = ["contact_words", "of_paper"]

#: What a quantity is called, its key and its unit.
QUANTITIES = {
    "radius of the sphere": ("sphere", "radius", "nm"),
    "hardness": ("contact", "hardness", "Pa"),
    "preload": ("contact", "preload", "N"),
    "range of adhesion": ("scales", "range", "nm"),
    "work of adhesion": ("adhesion", "work", "J/m2"),
}


def contact_words(config: Mapping[str, Any]) -> dict[str, str]:
    """Return what contacts are computed for, by what it is called: for example a radius "250 µm".

    Parameters
    ----------
    config : mapping
        Configuration of a study, with quantities as they are written.

    Returns
    -------
    dict of str to str
        The surface of the sphere and QUANTITIES.
    """
    quantities = {name: printed(config[group][key]) for name, (group, key, _) in QUANTITIES.items()}
    return {"sphere": str(config["sphere"]["surface"])} | quantities


def of_paper(config: Mapping[str, Any], paper: Mapping[str, Any]) -> list[str]:
    """Return which of QUANTITIES are those of the paper, a ruby sphere on diamond.

    Parameters
    ----------
    config, paper : mapping
        Configuration of a study and that of the paper, with quantities as they are written.

    Returns
    -------
    list of str
        What they are called.
    """
    return [
        name
        for name, (group, key, unit) in QUANTITIES.items()
        if magnitude(config[group][key], unit) == magnitude(paper[group][key], unit)
    ]
