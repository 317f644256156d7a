"""The page of the paper's study: question, answer, figures, verdicts, what it stands on."""

from collections.abc import Mapping
from itertools import groupby
from typing import Any

from hardcontact.answer.captions import Caption
from hardcontact.answer.paper_answer import MAIN_FINDINGS, PaperAnswer
from hardcontact.answer.report_pages import chapter, claim_facts
from hardcontact.answer.templates import rendered
from hardcontact.figures.catalogue import OF_PAPER
from hardcontact.numbers.printing import DIGITS, print_as_paper

#: Level of the headings within the departures, which are one section of the page.
WITHIN_SECTION = 3


def paper_page(
    answer: PaperAnswer,
    figures: Mapping[str, bytes],
    captions: Mapping[str, Caption],
    departures: str,
    citation: Mapping[str, Any],
) -> str:
    """Write the page.

    Parameters
    ----------
    answer : PaperAnswer
        Of the study.
    figures : mapping of str to bytes
        PNG of each figure, by its name in the catalogue.
    captions : mapping of str to Caption
        Of the same figures.
    departures : str
        The chapter of that name in Markdown, as `report_pages.chapter` takes it.
    citation : mapping
        CITATION.cff.

    Returns
    -------
    str
        HTML.

    Raises
    ------
    ValueError
        If the departures do not begin with a title.
    """
    return rendered(
        "paper.html",
        answer=answer,
        said={name: _said(row) for name, row in answer.numbers.items()},
        main=[name for name in MAIN_FINDINGS if name in set(answer.claims["id"])],
        chapters=[
            (heading, [name for name, _ in members])
            for heading, members in groupby(OF_PAPER.items(), key=lambda pair: pair[1].chapter)
        ],
        catalogue=OF_PAPER,
        figures=figures,
        captions=captions,
        departures=chapter(departures, level=WITHIN_SECTION),
        citation=citation,
        **claim_facts(answer.claims),
    )


def _said(row: Any) -> dict[str, str]:
    """Return the numbers of a claim with as many digits as its interval gives reason for."""
    interval = row.low, row.high
    return {
        "alone": print_as_paper(row.computed, row.unit, digits=DIGITS),
        "computed": print_as_paper(row.computed, row.unit, interval, DIGITS, row.open_end),
        "published": print_as_paper(row.published, row.unit),
    }
