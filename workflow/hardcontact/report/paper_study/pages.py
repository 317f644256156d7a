"""Pages of the paper's study: its answer, all figures with Table 1, and the report."""

from collections.abc import Mapping, Sequence
from itertools import groupby
from typing import Any

import pandas as pd
import yaml

from hardcontact.report.answer import numbers_of_answer, render_page
from hardcontact.report.figures.listing import PAPER_FIGURES, Caption, describe_figure
from hardcontact.report.paper_study.answer import ANSWER_CLAIMS
from hardcontact.report.paper_study.chapters import convert_chapter
from hardcontact.report.paper_study.conclusions import (
    claim_facts,
    draw_conclusions,
    most_sensitive_coatings,
)
from hardcontact.report.templates import Frame, render_document


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
    *coatings, _ = answer["surfaces"]  # the last one is the sphere
    coating_numbers = {row["label"]: numbers_of_answer(answer, row["name"]) for row in coatings}
    numbers = numbers_of_answer(answer)
    facts = claim_facts(claims) | draw_conclusions(numbers) | {"captions": captions}
    facts["most_sensitive"] = most_sensitive_coatings(coating_numbers)
    facts["artificial_claims"] = [
        claim
        for name, claim in ANSWER_CLAIMS.items()
        if name in numbers and numbers[name].source == "artificial"
    ]
    return render_page(answer, figures, citation, frame, **facts)


def figures_page(
    answer: Mapping[str, Any],
    table1: Sequence[Sequence[str]],
    figures: Mapping[str, bytes],
    captions: Mapping[str, Caption],
    frame: Frame,
) -> str:
    """Return the page of all figures of the paper's study, and of Table 1 from `table1_rows`."""
    chapters = groupby(PAPER_FIGURES, key=lambda name: describe_figure(name).chapter)
    return render_document(
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


def report_pages(
    claims: pd.DataFrame,
    changed: Sequence[Mapping[str, str]],
    texts: Mapping[str, str],
    configuration: Mapping[str, Any],
    versions: Mapping[str, str],
    frame: Frame,
) -> dict[str, str]:
    """Return the HTML of the pages of the report by name: `claims`, each text, and `parameters`.

    `claims` comes from `verdicts.add_open_ends`, `changed` from `changed_inputs`; `texts` are
    chapters in Markdown, by name.
    """
    confidence = configuration["inference"]["confidence"]
    facts = claim_facts(claims) | {"changed": changed, "confidence": confidence}
    pages = {"claims": render_document("claims.html", frame, "claims", **facts)}
    for name, text in texts.items():
        chapter = convert_chapter(text, frame.pages)
        pages[name] = render_document("chapter.html", frame, name, chapter=chapter)
    parameters = yaml.safe_dump(configuration, allow_unicode=True)
    pages["parameters"] = render_document(
        "parameters.html", frame, "parameters", parameters=parameters, versions=versions
    )
    return pages
