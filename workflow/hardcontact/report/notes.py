"""Notes of an answer: cautions and explanations beside its numbers, in words."""

from collections.abc import Sequence
from typing import Any

from hardcontact.report.templates import render_text


def note(
    kind: str, text: str, code: str = "", surface: str = "", *, grave: bool = False
) -> dict[str, Any]:
    """Return a note for answer.json; grave ones stand at the top of the page."""
    # A comparison with an attribute of a dataset is a NumPy truth value, which JSON lacks.
    is_grave = bool(grave)
    return {"surface": surface, "kind": kind, "code": code, "grave": is_grave, "text": text}


def substitutes_note(labels: Sequence[str]) -> list[dict[str, Any]]:
    """Return the note that these surfaces are substitutes, or none if all are measured."""
    if not labels:
        return []
    text = render_text("substitutes.txt", substitutes=labels)
    return [note("caution", text, "substitutes", grave=True)]
