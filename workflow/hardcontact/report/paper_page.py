"""The page of the paper's study, its first sentences, and the head of answer.json."""

from collections.abc import Mapping
from itertools import groupby
from typing import Any

from hardcontact.report.figures.listing import PAPER_FIGURES, Caption, describe_figure
from hardcontact.report.paper_answer import ANSWER_CLAIMS, PaperAnswer
from hardcontact.report.report_pages import claim_facts
from hardcontact.report.templates import rendered, rendered_lines

#: Claims of the most important findings, in the order of the page.
MAIN_FINDINGS = (
    "edge_small_first",
    "edge_large_first",
    "edge_small_pooled",
    "edge_large_pooled",
    "plasticity_moves_short_edge",
    "range_moves_short_edge",
    "interaction_radius_is_critical",
    "range_of_adhesion",
    "work_of_adhesion",
    "plastic_fits",
    "plasticity_is_crucial",
    "elastic_pressure_exceeds_hardness",
    "numerical_beats_classical",
    "few_asperities_ncd",
)


def paper_headline(answer: PaperAnswer) -> list[str]:
    """Return the first sentences of the page, which the terminal also shows.

    answer: from `paper_answer`.
    """
    facts = claim_facts(answer.claims)
    return rendered_lines("paper_headline.txt", answer=answer, numbers=answer.numbers, **facts)


def paper_head(
    answer: PaperAnswer, configuration: Mapping[str, Any], version: str
) -> dict[str, Any]:
    """Return the head of answer.json.

    answer: from `paper_answer`; coarse grids make its effort quick.
    configuration: the user's configuration.
    Returns the entries before the list of quantities. `headline` is from `paper_headline`.
    """
    contact = {"radius of the sphere": configuration["sphere"]["radius"]}
    contact |= {key: configuration["contact"][key] for key in ("hardness", "preload")}
    return {
        "study": configuration["study"],
        "version": version,
        "effort": "quick" if answer.coarse else configuration["effort"],
        "kind": "paper",
        "headline": paper_headline(answer),
        "contact": contact,
    }


def paper_page(
    answer: PaperAnswer,
    head: Mapping[str, Any],
    figures: Mapping[str, bytes],
    captions: Mapping[str, Caption],
    citation: Mapping[str, Any],
) -> str:
    """Return the page of the paper's study.

    answer: from `paper_answer`.
    head: from `paper_head`.
    figures: SVG by the name of the figure.
    captions: captions by the name of the figure.
    """
    return rendered(
        "paper.html",
        answer=answer,
        head=head,
        numbers=answer.numbers,
        main=[name for name in MAIN_FINDINGS if name in set(answer.claims["id"])],
        artificial=[
            claim
            for name, claim in ANSWER_CLAIMS.items()
            if name in answer.numbers and answer.numbers[name].source == "artificial"
        ],
        chapters=[
            (heading, list(names))
            for heading, names in groupby(
                PAPER_FIGURES, key=lambda name: describe_figure(name).chapter
            )
        ],
        figures=figures,
        captions=captions,
        citation=citation,
        **claim_facts(answer.claims),
    )
