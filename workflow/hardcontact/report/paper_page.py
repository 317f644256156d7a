"""Pages of the paper's study: its answer, and all its figures with Table 1."""

from collections.abc import Mapping, Sequence
from itertools import groupby
from typing import Any

import pandas as pd

from hardcontact.report.figures.listing import PAPER_FIGURES, Caption, describe_figure
from hardcontact.report.page import render_page
from hardcontact.report.paper_answer import ANSWER_CLAIMS
from hardcontact.report.report_pages import claim_facts
from hardcontact.report.templates import Frame, rendered


def paper_page(
    answer: Mapping[str, Any],
    claims: pd.DataFrame,
    figures: Mapping[str, bytes],
    captions: Mapping[str, Caption],
    citation: Mapping[str, Any],
    frame: Frame,
) -> str:
    """Return the page of the paper's study.

    `claims` comes from `verdicts.add_open_ends`; SVG and captions are by the name of the figure.
    """
    return render_page(
        answer,
        figures,
        citation,
        frame,
        answer_claims=ANSWER_CLAIMS,
        captions=captions,
        **claim_facts(claims),
    )


def figures_page(
    answer: Mapping[str, Any],
    table1: Sequence[Sequence[str]],
    figures: Mapping[str, bytes],
    captions: Mapping[str, Caption],
    frame: Frame,
) -> str:
    """Return the page of all figures of the paper's study, and of Table 1 from `table1_rows`."""
    chapters = groupby(PAPER_FIGURES, key=lambda name: describe_figure(name).chapter)
    return rendered(
        "figures.html",
        frame,
        "figures",
        notes=answer["notes"],
        surfaces=answer["surfaces"],
        table1=table1,
        figures=figures,
        captions=captions,
        chapters=[(heading, list(names)) for heading, names in chapters],
    )
