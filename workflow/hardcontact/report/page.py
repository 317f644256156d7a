"""The page of a study: answer.json as HTML, with figures and citation."""

from collections.abc import Mapping
from typing import Any

from hardcontact.report.artificial import NEARLY_ALL
from hardcontact.report.quantities import numbers_by_name
from hardcontact.report.templates import Frame, rendered
from hardcontact.surfaces.reliable_band import LIMIT_NAMES, MIN_PIXELS, MIN_WAVES_IN_SIZE


def render_page(
    answer: Mapping[str, Any],
    figures: Mapping[str, bytes],
    citation: Mapping[str, Any],
    frame: Frame,
    **facts: Any,
) -> str:
    """Return the page as HTML from the content of answer.json and the SVG of each figure.

    Own surfaces have no further facts; `paper_page` gives those for the paper.
    """
    surfaces = [
        {**surface, "numbers": numbers_by_name(answer, surface["name"])}
        for surface in answer["surfaces"]
    ]
    return rendered(
        "answer.html",
        frame,
        "answer",
        answer=answer,
        numbers=numbers_by_name(answer),
        surfaces=surfaces,
        figures=figures,
        citation=citation,
        limit_names=LIMIT_NAMES,
        min_pixels=MIN_PIXELS,
        min_waves=MIN_WAVES_IN_SIZE,
        nearly_all=NEARLY_ALL,
        **facts,
    )
