"""Pages and notes from templates: a page is one HTML document, with its style and its script."""

import base64
import hashlib
import math
import re
import subprocess
from collections.abc import Iterable, Mapping, Sequence
from functools import cache
from typing import Any, NamedTuple

from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup, escape

from hardcontact.base.formatting import format_share
from hardcontact.report import TEXTS, quantities
from hardcontact.report.figures.listing import render_description

TEMPLATES = TEXTS / "templates"

#: A space before or within an interval, before a unit, or beside ±.
NO_BREAK = re.compile(
    r"(?<=\d) (?=[\[±])|(?<=\d,) (?=[-−.\d]+\])"
    r"|(?<=[\d\]]) (?=(?:[pnµm]?[Nm]|m?J/m²|[GM]?Pa|%)(?![A-Za-z]))|(?<=±) "
)


class Frame(NamedTuple):
    """The facts that all pages of a study share."""

    version: str  #: Version of this program.
    pages: Mapping[str, str] = {}  #: Category of each page in the folder `report`, by its name.


def render_document(template: str, frame: Frame, page: str, **facts: Any) -> str:
    """Return a page, by its name, as one HTML document that needs no network.

    `facts` are what the template shows, by the names that it uses.
    """
    script = (TEMPLATES / "page.js").read_text("utf-8")
    style = (TEMPLATES / "style.css").read_text("utf-8")
    facts |= {"frame": frame, "page": page, "commit": _code_commit()}
    facts |= {"style": Markup(style), "script": Markup(script)}
    digest = base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()
    allowed = f"img-src data: file: 'self'; style-src 'unsafe-inline'; script-src 'sha256-{digest}'"
    return render_template(template, policy=f"default-src 'none'; {allowed}", **facts)


def render_page(
    answer: Mapping[str, Any],
    figures: Mapping[str, bytes],
    citation: Mapping[str, Any],
    frame: Frame,
    **facts: Any,
) -> str:
    """Return the page of an answer from answer.json, the SVG of each figure, and further facts."""
    surfaces = [
        {**surface, "numbers": quantities.numbers_of_answer(answer, surface["name"])}
        for surface in answer["surfaces"]
    ]
    facts |= {"answer": answer, "figures": figures, "citation": citation}
    facts |= {"numbers": quantities.numbers_of_answer(answer), "surfaces": surfaces}
    return render_document("answer.html", frame, "answer", **facts)


def render_template(template: str, **facts: Any) -> str:
    """Return the text that a template makes of facts, by the names that it uses."""
    return str(_environment().get_template(template).render(**facts))


def render_lines(template: str, **facts: Any) -> list[str]:
    """Return the lines of a template that are not empty, as plain text."""
    return _plain_texts(render_template(template, **facts).splitlines())


def render_paragraphs(template: str, **facts: Any) -> list[str]:
    """Return the paragraphs of a template, which blank lines separate, each as plain text."""
    return _plain_texts(render_template(template, **facts).split("\n\n"))


def _plain_texts(texts: Iterable[str]) -> list[str]:
    """Return texts without tags, each in one line; drop empty ones."""
    plain_texts = [Markup(text).striptags() for text in texts]
    return [text for text in plain_texts if text]


def render_note(
    template: str, kind: str, code: str = "", surface: str = "", grave: bool = False, **facts: Any
) -> dict[str, Any]:
    """Return a note for answer.json, one paragraph; grave ones stand at the top of the page."""
    text = Markup(render_template(template, **facts)).striptags()
    # A comparison with an attribute of a dataset is a NumPy truth value, which JSON lacks.
    return {"surface": surface, "kind": kind, "code": code, "grave": bool(grave), "text": text}


def substitutes_note(labels: Sequence[str]) -> list[dict[str, Any]]:
    """Return a list with the note that the surfaces of these labels are substitutes, if any."""
    if not labels:
        return []
    note = render_note("substitutes.txt", "caution", "substitutes", grave=True, substitutes=labels)
    return [note]


@cache
def _environment() -> Environment:
    """Return the environment that renders templates; it compiles each once."""
    environment = Environment(
        loader=FileSystemLoader(TEMPLATES), autoescape=True, undefined=StrictUndefined,
        trim_blocks=True, lstrip_blocks=True,
    )  # fmt: skip
    environment.filters |= {
        "format_number": quantities.format_number, "in_words": quantities.describe_number,
        "two_digit_words": lambda number: quantities.describe_number(number, 2),
        "without_interval": quantities.describe_without_interval,
        "unbroken": unbroken, "linked": _link_claims,
        "percent": format_share, "share_of_decades": _share_of_decades,
        # A point before a digit, as in Eq. 2, ends no sentence.
        "first_sentence": lambda text: re.split(r"(?<=\.) (?=[\"A-Z])", text, maxsplit=1)[0],
        "base64": lambda data: base64.b64encode(data).decode("ascii"),
    }  # fmt: skip
    environment.globals["caption"] = render_description
    environment.tests["known"] = math.isfinite
    return environment


def _code_commit() -> str:
    """Return the commit of the code that makes a page, empty outside of a git repository."""
    command = ["git", "describe", "--always", "--exclude=*", "--dirty"]
    try:
        run = subprocess.run(command, cwd=TEMPLATES, capture_output=True, text=True, check=False)
    except FileNotFoundError:  # git is not installed
        return ""
    return run.stdout.strip()


def _share_of_decades(value: float, low: float, high: float) -> float:
    """Return the position of a value on a logarithmic axis from 0, its low end, to 1, its high."""
    return min(max(math.log(value / low) / math.log(high / low), 0.0), 1.0)


def unbroken(text: Any) -> str:
    """Return a text whose lines do not break between a number, its interval and its unit."""
    unbroken_text = NO_BREAK.sub("\N{NO-BREAK SPACE}", str(text))
    return Markup(unbroken_text) if isinstance(text, Markup) else unbroken_text


def _link_claims(text: str, claims: Mapping[str, Mapping[str, Any]]) -> Markup:
    """Return a text in which each id of a claim is a link, printed as "statement 3"."""
    words = re.split(r"(\w+)", text)
    link = Markup('<a href="#{}">statement {}</a>')
    return Markup("").join(
        link.format(word, claims[word]["position"]) if word in claims else escape(word)
        for word in words
    )
