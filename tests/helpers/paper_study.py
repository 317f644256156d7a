"""Small inputs of the page of the paper's study: claims, datasets, figures, captions."""

import json
from functools import cache

import numpy as np
import yaml
from paper_datasets import (
    band,
    band_forces,
    edge_shifts,
    features,
    filtered_forces,
    fit,
    published_table1,
    scan_size,
    sensitivity,
    sets,
    topography,
)
from paper_numbers import CLAIMS, CONSTANTS
from repository import PAPER, ROOT

from hardcontact.paper.claims.verdicts import JUDGED_COLUMNS, VERDICTS
from hardcontact.report.figures.listing import PAPER_FIGURES, Description
from hardcontact.report.paper_study.answer import paper_answer
from hardcontact.report.paper_study.pages import figures_page, paper_page
from hardcontact.report.paper_study.tables import table1_rows
from hardcontact.report.quantities import answer_text
from hardcontact.report.templates import Frame

CITATION = yaml.safe_load((ROOT / "CITATION.cff").read_text("utf-8"))
PAGES = yaml.safe_load((ROOT / "workflow/report/pages.yaml").read_text("utf-8"))
FRAME = Frame("1.2.3", {name: category for name, (category, _) in PAGES.items()})


def claims():
    """Return every statement of the paper with its own numbers; the verdicts alternate."""
    numbers = np.arange(len(CLAIMS)) + 1.0
    return CLAIMS.assign(
        computed=1.01 * numbers,
        low=np.where(numbers % 3, 0.9 * numbers, np.nan),
        high=np.where(numbers % 3, 1.1 * numbers, np.nan),
        open_end="",
        accepted_low=0.8 * numbers,
        accepted_high=np.where(numbers % 2, 1.25 * numbers, np.inf),
        agreeing_share=np.where(numbers % 3, 0.58, np.nan),
        verdict=[VERDICTS[number % len(VERDICTS)] for number in range(len(CLAIMS))],
        basis="substitute scans",
    )[list(JUDGED_COLUMNS)]


@cache
def datasets(contacts=20, pixels=512):
    """Return the datasets of the page, not to be changed; the band has two edges."""
    return {
        "topography": topography(pixels),
        "filtered_forces": filtered_forces(contacts),
        "edges": band(),
        "edge_shifts": edge_shifts(),
        "sensitivity": sensitivity(),
        "band_forces": band_forces(),
        "sets": sets(),
        "features": features(),
        "fit": fit(),
        "scan_size": scan_size(),
    }


def answer(judged_claims=None, configuration=PAPER, **changed_datasets):
    """Return answer.json of the study, from other claims or datasets if given."""
    content = paper_answer(
        claims() if judged_claims is None else judged_claims,
        datasets() | changed_datasets,
        constants=CONSTANTS,
        table1=published_table1(),
        configuration=configuration,
        version=CITATION["version"],
    )
    return json.loads(answer_text(content))


def svg(colour):
    """Return a picture of one colour, as bytes."""
    return f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 6" fill="{colour}"/>'.encode()


def figures():
    """Return a picture for each figure of the study, with different colours."""
    return {name: svg(f"#{index:03}") for index, name in enumerate(PAPER_FIGURES)}


def captions():
    """Return a caption for each figure."""
    return {
        name: Description(f"Of {name}: a < b", f"It shows {name}: 1 < 2.", "And more.")
        for name in PAPER_FIGURES
    }


def make_page(judged_claims=None, configuration=PAPER):
    """Return the page of the answer."""
    content = answer(judged_claims, configuration)
    table = claims() if judged_claims is None else judged_claims
    return paper_page(content, table, figures(), captions(), CITATION, FRAME)


def make_figures_page():
    """Return the page of all figures."""
    table1 = table1_rows(datasets()["topography"], published_table1())
    return figures_page(answer(), table1, figures(), captions(), FRAME)
