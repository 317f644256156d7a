"""Inputs of a study of the paper's kind that differ from the paper's."""

from collections.abc import Mapping, Sequence
from typing import Any

import pandas as pd

from hardcontact.config.configuration import contact_words
from hardcontact.config.keys import Study


def contact_inputs(configuration: Mapping[str, Any]) -> dict[str, str]:
    """Return the inputs of the contacts of a study, in words, by their names on pages."""
    words = contact_words(configuration)
    del words["work of adhesion"]  # no input, because it is fitted to the published forces
    sphere = "rough" if configuration["band"]["sphere_roughness"] else "smooth"
    return words | {"sphere in computations of the band": sphere}


def changed_inputs(
    study_inputs: Mapping[str, str], substrates: Sequence[str], table1: pd.DataFrame
) -> list[dict[str, str]]:
    """Return inputs, from `contact_inputs`, and coatings that differ, with both values."""
    # The inputs of the paper are the defaults of a study.
    paper_inputs = contact_inputs(Study().model_dump(warnings=False))
    paper_inputs["coatings"] = ", ".join(sorted(set(table1["surface"])))
    inputs = {**study_inputs, "coatings": ", ".join(sorted(substrates))}
    return [
        {"input": name, "paper": paper_value, "study": inputs[name]}
        for name, paper_value in paper_inputs.items()
        if inputs[name] != paper_value
    ]
