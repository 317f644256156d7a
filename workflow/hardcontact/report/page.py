"""The page of a study: answer.json as HTML, with figures and citation."""

from collections.abc import Mapping
from typing import Any

from hardcontact.report.quantities import numbers_of_answer
from hardcontact.report.templates import Frame, render_document


def render_page(
    answer: Mapping[str, Any],
    figures: Mapping[str, bytes],
    citation: Mapping[str, Any],
    frame: Frame,
    **facts: Any,
) -> str:
    """Return the page as HTML from the content of answer.json and the SVG of each figure.

    `own_page` and `paper_page` give the further facts that the templates of their studies need.
    """
    surfaces = [
        {**surface, "numbers": numbers_of_answer(answer, surface["name"])}
        for surface in answer["surfaces"]
    ]
    facts |= {"answer": answer, "figures": figures, "citation": citation}
    facts |= {"numbers": numbers_of_answer(answer), "surfaces": surfaces}
    return render_document("answer.html", frame, "answer", **facts)
