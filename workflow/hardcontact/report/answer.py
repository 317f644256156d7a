"""The answer of a study of either kind: its notes, its numbers, its file and its page."""

import json
import math
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from hardcontact.base.number import Number, NumberStatus, json_value
from hardcontact.report.templates import Frame, render_document, render_text


def note(
    kind: str, text: str, code: str = "", surface: str = "", *, grave: bool = False
) -> dict[str, Any]:
    """Return a note for answer.json; grave ones stand at the top of the page."""
    # A comparison with an attribute of a dataset is a NumPy truth value, which JSON lacks.
    return {"surface": surface, "kind": kind, "code": code, "grave": bool(grave), "text": text}


def substitutes_note(labels: Sequence[str]) -> list[dict[str, Any]]:
    """Return the note that these surfaces are substitutes, or none if all are measured."""
    if not labels:
        return []
    text = render_text("substitutes.txt", substitutes=labels)
    return [note("caution", text, "substitutes", grave=True)]


def all_quantities(
    study_numbers: Iterable[Number], surface_numbers: Mapping[str, Iterable[Number]]
) -> list[dict[str, Any]]:
    """Return the numbers of the whole study, then of each surface, as the list of answer.json."""
    return [
        {"surface": surface, **json_value(number)}
        for surface, numbers in {"": study_numbers, **surface_numbers}.items()
        for number in numbers
    ]


def numbers_of_answer(answer: Mapping[str, Any], surface: str = "") -> dict[str, Number]:
    """Return the numbers of one surface, or of the whole study, in answer.json by name."""
    numbers = {}
    for quantity in answer["quantities"]:
        if quantity["surface"] == surface:
            values: dict[str, Any] = {
                key: math.nan if quantity[key] is None else quantity[key] for key in Number._fields
            }
            if values["status"] in (NumberStatus.KNOWN, NumberStatus.NOT_KNOWN):
                values["status"] = ""
            numbers[values["name"]] = Number(**values)
    return numbers


def answer_text(answer: Mapping[str, Any]) -> str:
    """Return the text of answer.json, as answer.schema.json describes it; refuse repeated names."""
    names = [(row["surface"], row["name"]) for row in answer["quantities"]]
    repeated = sorted({name for name in names if names.count(name) > 1})
    if repeated:
        raise ValueError(f"expected quantities with different names, found twice: {repeated}")
    return json.dumps(answer, ensure_ascii=False, allow_nan=False, indent=1) + "\n"


def render_page(
    answer: Mapping[str, Any],
    figures: Mapping[str, bytes],
    citation: Mapping[str, Any],
    frame: Frame,
    **facts: Any,
) -> str:
    """Return the page as HTML from answer.json, the SVG of each figure, and further facts."""
    surfaces = [
        {**surface, "numbers": numbers_of_answer(answer, surface["name"])}
        for surface in answer["surfaces"]
    ]
    facts |= {"answer": answer, "figures": figures, "citation": citation}
    facts |= {"numbers": numbers_of_answer(answer), "surfaces": surfaces}
    return render_document("answer.html", frame, "answer", **facts)
