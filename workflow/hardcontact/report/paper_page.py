"""The page of the paper's study: answer.json, claims, Table 1, figures and their captions."""

from collections.abc import Mapping, Sequence
from itertools import groupby
from typing import Any

import pandas as pd

from hardcontact.report.figures.listing import PAPER_FIGURES, Caption, describe_figure
from hardcontact.report.page import render_page
from hardcontact.report.paper_answer import ANSWER_CLAIMS
from hardcontact.report.report_pages import claim_facts


def paper_page(
    answer: Mapping[str, Any],
    claims: pd.DataFrame,
    table1: Sequence[Sequence[str]],
    figures: Mapping[str, bytes],
    captions: Mapping[str, Caption],
    citation: Mapping[str, Any],
) -> str:
    """Return the page of the paper's study.

    `claims` comes from `verdicts.add_open_ends`, `table1` from `table1.table1_rows`; SVG and
    captions are by the name of the figure.
    """
    chapters = groupby(PAPER_FIGURES, key=lambda name: describe_figure(name).chapter)
    return render_page(
        answer,
        figures,
        citation,
        answer_claims=ANSWER_CLAIMS,
        chapters=[(heading, list(names)) for heading, names in chapters],
        table1=table1,
        captions=captions,
        **claim_facts(claims),
    )
