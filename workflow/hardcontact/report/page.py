"""The page of a study: answer.json as HTML, with figures and citation."""

from collections.abc import Mapping
from typing import Any

from hardcontact.report.quantities import numbers_by_name
from hardcontact.report.templates import rendered
from hardcontact.surfaces.reliable_band import LIMIT_NAMES, MIN_PIXELS, MIN_WAVES_IN_SIZE


def render_page(
    answer: Mapping[str, Any],
    figures: Mapping[str, bytes],
    citation: Mapping[str, Any],
    **facts: Any,
) -> str:
    """Return the page, HTML.

    answer: the content of answer.json.
    figures: SVG by the name of the figure.
    facts: of own surfaces `left_out`, parts that the data do not allow and why; of the paper what
        `paper_page` gives.
    """
    surfaces = [
        {**surface, "numbers": numbers_by_name(answer, surface["name"])}
        for surface in answer["surfaces"]
    ]
    return rendered(
        "answer.html",
        answer=answer,
        numbers=numbers_by_name(answer),
        surfaces=surfaces,
        figures=figures,
        citation=citation,
        limit_names=LIMIT_NAMES,
        min_pixels=MIN_PIXELS,
        min_waves=MIN_WAVES_IN_SIZE,
        **facts,
    )
