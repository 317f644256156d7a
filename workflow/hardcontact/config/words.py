"""The pages of the report that are no figures.

What the contacts of own surfaces are computed for, in words, and what of it is the paper's.
"""

from collections.abc import Mapping
from typing import Any

from hardcontact.numbers.units import magnitude, printed

__all__ = ["CHAPTERS", "PAGES", "contact_words", "of_paper"]

#: Chapters that are written beforehand, one Markdown file each in workflow/report.
CHAPTERS = ("departures", "methods", "performance", "cluster", "faults")

#: Category and title of each page in the report.
PAGES = {
    "claims": ("9. Verdicts", "verdicts on the paper's statements"),
    "departures": ("A. Departures, parameters", "where the study departs from the paper"),
    "parameters": ("A. Departures, parameters", "parameters and versions"),
    "methods": ("B. The study itself", "methods"),
    "performance": ("B. The study itself", "performance"),
    "cluster": ("B. The study itself", "on a cluster"),
    "faults": ("B. The study itself", "faults and what becomes of them"),
}


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
