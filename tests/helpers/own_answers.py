"""Answers of studies of your surfaces, and their pages, made of small datasets."""

import json

import numpy as np
from own_datasets import RANGE, WORK, datasets, fit, open_edges, spectra, topography
from paper_study import CITATION, svg

from hardcontact.report.figures.listing import OWN_FIGURES
from hardcontact.report.own_surfaces.answer import LIMITS, own_answer, surface_answers
from hardcontact.report.own_surfaces.datasets import Setting
from hardcontact.report.quantities import answer_text
from hardcontact.report.templates import Frame, render_page

PAIRS = [
    {"pair": "published", "range_of_adhesion_nm": RANGE, "work_of_adhesion_J_m2": WORK,
     "share_of_sets": np.nan},
    {"pair": "long_range", "range_of_adhesion_nm": 10.0, "work_of_adhesion_J_m2": WORK / 2,
     "share_of_sets": 0.58},
    {"pair": "short_range", "range_of_adhesion_nm": 0.5, "work_of_adhesion_J_m2": 2 * WORK,
     "share_of_sets": 0.42},
]  # fmt: skip


def setting():
    """Return the setting of a study."""
    contact = {
        "sphere": "smooth", "radius of the sphere": "250 µm", "hardness": "25 GPa",
        "preload": "10 µN", "range of adhesion": "5.6 nm", "work of adhesion": "46.3 mJ/m²",
    }  # fmt: skip
    paper_values = ["hardness", "work of adhesion"]
    return Setting("my-coating", "full", contact, paper_values, "1.0.0", PAIRS)


def numbers_of(own_setting=None, **others):
    """Return the numbers of the answer of the first surface by name; `others` replace datasets."""
    return surface_answers(datasets(**others), own_setting or setting())[0].numbers


#: Too long for the width of a table.
LONG_NAME = "/scans/" + "a-very-long-name-of-a-scan-" * 5 + "1.spm"
FORCES = "two substitutes, forces"
#: Datasets of studies that differ in what they have.
CASES = {
    "one": datasets(),
    "open, one force": datasets(
        edges=open_edges(),
        fit=fit(),
        spectra=spectra().assign(path=spectra()["path"].astype(object) + LONG_NAME),
    ),
    FORCES: datasets(2, topography=topography(2, "substitute"), fit=fit(2)),
}


def make_answer(own_datasets):
    """Return the content of answer.json."""
    return json.loads(answer_text(own_answer(own_datasets, setting())))


def make_page(own_datasets):
    """Return the page of an answer as answer.json has it."""
    pictures = {name: svg(f"#{index:03}") for index, name in enumerate(OWN_FIGURES)}
    return render_page(make_answer(own_datasets), pictures, CITATION, Frame("1.2.3"), **LIMITS)
