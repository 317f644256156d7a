"""Inputs of a study of the paper's kind that differ from the paper's."""

from collections.abc import Mapping, Sequence
from typing import Any

import pandas as pd

from hardcontact.config.configuration import CONTACT_QUANTITIES, contact_words
from hardcontact.config.keys import Study

#: The name of `band.sphere_roughness` among the inputs of contacts.
SPHERE_AT_CUTOFFS = "sphere in computations of the band"


def contact_inputs(configuration: Mapping[str, Any]) -> dict[str, str]:
    """Return the inputs of the contacts of a study, in words, by their names on pages."""
    words = contact_words(configuration)
    # The work of adhesion is no input, because it is fitted to the published forces.
    _, name_of_work = CONTACT_QUANTITIES["work"]
    del words[name_of_work]
    sphere = "rough" if configuration["band"]["sphere_roughness"] else "smooth"
    return words | {SPHERE_AT_CUTOFFS: sphere}


def changed_inputs(
    contact: Mapping[str, str], substrates: Sequence[str], table1: pd.DataFrame
) -> list[dict[str, str]]:
    """Return the inputs of contacts, and the coatings, that differ from the paper's.

    `contact` comes from `contact_inputs`; `substrates` are the coatings of the study.
    """
    # The inputs of the paper are the defaults of a study.
    paper_inputs = contact_inputs(Study().model_dump(warnings=False))
    paper_inputs["coatings"] = _join_surfaces(table1["surface"])
    inputs = {**contact, "coatings": _join_surfaces(substrates)}
    return [
        {"input": name, "paper": paper_value, "study": inputs[name]}
        for name, paper_value in paper_inputs.items()
        if inputs[name] != paper_value
    ]


def _join_surfaces(surfaces: Sequence[str] | pd.Series) -> str:
    """Return the ids of surfaces in words, in alphabetical order."""
    return ", ".join(sorted(set(surfaces)))
