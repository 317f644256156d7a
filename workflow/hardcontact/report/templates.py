"""Pages from templates: one self-contained HTML document, with its style and its script."""

import base64
import hashlib
import math
import re
from pathlib import Path
from typing import Any

from hardcontact.base.formatting import format_share
from hardcontact.report import quantities
from hardcontact.report.figures.listing import caption

FOLDER = Path(__file__).parents[2] / "report/templates"

#: A space between a number and its interval, or between either and its unit.
BEFORE_UNIT = re.compile(r"(?<=\d) (?=\[)|(?<=[\d\]]) (?=(?:[pnµm]?[Nm]|m?J/m²|[GM]?Pa|%)(?!\w))")


def rendered(template: str, **facts: Any) -> str:
    """Return a page as one HTML document that needs no network.

    The template is a file of workflow/report/templates. The facts are the names that it uses.
    Raises jinja2.UndefinedError if one is missing. Everything that a template prints is escaped.
    The policy of the page allows no script but its own, which it names by its digest.
    """
    # Imported here: it takes longer than most jobs compute.
    from markupsafe import Markup

    script = _file("page.js")
    page = _environment().get_template(template)
    return str(
        page.render(
            style=Markup(_file("style.css")),
            script=Markup(script),
            policy=_policy(script),
            **facts,
        )
    )


def rendered_lines(template: str, **facts: Any) -> list[str]:
    """Return the lines of a template that are not empty, as plain text."""
    from markupsafe import Markup

    text = _environment().get_template(template).render(**facts)
    lines = [Markup(line).striptags() for line in text.splitlines()]
    return [line for line in lines if line]


def rendered_text(template: str, **facts: Any) -> str:
    """Return a template as one paragraph of plain text."""
    return " ".join(rendered_lines(template, **facts))


def _environment() -> Any:
    """Return the environment in which templates of pages are rendered."""
    from jinja2 import Environment, FileSystemLoader, StrictUndefined

    environment = Environment(
        loader=FileSystemLoader(FOLDER), autoescape=True, undefined=StrictUndefined,
        trim_blocks=True, lstrip_blocks=True,
    )  # fmt: skip
    environment.filters |= {
        "printed": quantities.printed, "words": quantities.in_words, "rounded": quantities.rounded,
        "bare": quantities.bare,
        "percent": format_share, "share_of_decades": _share_of_decades,
        "unbroken": _unbroken, "base64": _base64,
    }  # fmt: skip
    environment.globals["caption"] = caption
    environment.tests["known"] = math.isfinite
    return environment


def _file(name: str) -> str:
    return (FOLDER / name).read_text("utf-8")


def _policy(script: str) -> str:
    """Return the security policy of a page: it may load its own pictures, styles and script."""
    digest = base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()
    allowed = f"img-src data:; style-src 'unsafe-inline'; script-src 'sha256-{digest}'"
    return f"default-src 'none'; {allowed}"


def _share_of_decades(value: float, low: float, high: float) -> float:
    """Return where a value lies between two others on a logarithmic axis, from 0 to 1."""
    share = math.log(value / low) / math.log(high / low)
    return min(max(share, 0.0), 1.0)


def _unbroken(text: Any) -> str:
    """Return a text whose lines do not break between a number and its unit."""
    unbroken = BEFORE_UNIT.sub("\N{NO-BREAK SPACE}", str(text))
    return type(text)(unbroken) if hasattr(text, "__html__") else unbroken  # stays escaped


def _base64(data: bytes) -> str:
    return base64.b64encode(data).decode("ascii")
