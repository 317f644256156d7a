"""Pages of the report: verdicts, chapters of text, parameters and versions."""

import re
from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
import yaml
from markdown_it import MarkdownIt
from markdown_it.token import Token
from mdit_py_plugins.dollarmath import dollarmath_plugin

from hardcontact.base.formatting import format_as_paper, is_boundless
from hardcontact.paper.selection import LARGER_PIXELS, WITHOUT_SCAN
from hardcontact.paper.verdicts import BY_CONSTRUCTION, REPRODUCED_SHARE, summary
from hardcontact.report.quantities import NO_INTERVAL
from hardcontact.report.templates import Frame, rendered, unbroken

#: A link of Markdown within the repository: its words, the document without `.md`, and the anchor.
LINK = re.compile(r"\[([^\]]+)\]\((?!https?:)([^)#]+?)(?:\.md)?(#[^)]*)?\)")


class Chapter(NamedTuple):
    """A chapter in Markdown, converted for a page."""

    title: str  #: Plain text.
    html: str  #: HTML of the text below the title.
    sections: list[tuple[str, str]]  #: Anchor and heading of each section, in their order.


def pages(
    claims: pd.DataFrame,
    changed: Sequence[Mapping[str, str]],
    texts: Mapping[str, str],
    configuration: Mapping[str, Any],
    versions: Mapping[str, str],
    frame: Frame,
) -> dict[str, str]:
    """Return the HTML of the pages by their names: `claims`, each text, and `parameters`.

    `claims` comes from `verdicts.add_open_ends`, `changed` from `changed_inputs`; `texts` are
    chapters in Markdown, by name.
    """
    confidence = configuration["inference"]["confidence"]
    parameters = yaml.safe_dump(configuration, allow_unicode=True)
    facts = claim_facts(claims)
    chapters = {name: chapter(text, frame.pages) for name, text in texts.items()}
    return {
        "claims": rendered(
            "claims.html", frame, "claims", confidence=confidence, changed=changed, **facts
        ),
        **{
            name: rendered("chapter.html", frame, name, chapter=page)
            for name, page in chapters.items()
        },
        "parameters": rendered(
            "parameters.html", frame, "parameters", parameters=parameters, versions=versions
        ),
    }


def plain_rows(table: pd.DataFrame) -> list[dict[Any, Any]]:
    """Return the rows of a table as plain values, with None for NaN, which JSON lacks."""
    return table.astype(object).where(table.notna(), None).to_dict("records")


def claim_facts(claims: pd.DataFrame) -> dict[str, Any]:
    """Return the facts about claims that templates show.

    `claims` has rows by their ids, with printed numbers, `contradicted` those of independent
    findings that are not reproduced, and `counts` rows of `verdicts.summary`.
    The numbers of findings: `without_scan` reproduced without any scan, `larger_pixels` testable
    only with the paper's pixels.
    """
    pairs = zip(plain_rows(claims), claims.to_dict("records"), strict=True)
    facts = {str(row["id"]): plain | _printed_claim(row) for plain, row in pairs}
    return {
        "claims": facts,
        "contradicted": [
            row
            for row in facts.values()
            if (row["kind"], row["verdict"]) == ("independent", "not reproduced")
        ],
        "counts": summary(claims).to_dict("records"),
        "decisive_share": REPRODUCED_SHARE,
        "without_scan": sum(
            (row["kind"], row["verdict"]) == ("independent", "reproduced")
            and row["basis"] in WITHOUT_SCAN
            for row in facts.values()
        ),
        "larger_pixels": sum(
            row["kind"] == "independent" and LARGER_PIXELS in (row["note"] or "")
            for row in facts.values()
        ),
    }


def _printed_claim(row: Mapping[Any, Any]) -> dict[str, Any]:
    """Return the numbers of a claim as printed, and its kind."""
    unit = row["unit"]
    interval = (row["low"], row["high"])
    kind = "follows" if row["follows_from"] else "independent"
    computed_text = format_as_paper(row["computed"], unit, interval, open_end=row["open_end"])
    if row["low"] == row["high"]:
        computed_text = format_as_paper(row["computed"], unit)
    elif is_boundless(row["computed"], *interval, unit):
        computed_text = f"{format_as_paper(row['computed'], unit)} ({NO_INTERVAL['no_interval']})"
    return {
        "published_text": format_as_paper(row["published"], unit),
        "accepted_text": _print_accepted_range(row["accepted_low"], row["accepted_high"], unit),
        "computed_text": computed_text,
        "kind": BY_CONSTRUCTION if row["verdict"] == BY_CONSTRUCTION else kind,
    }


def _print_accepted_range(low: float, high: float, unit: str) -> str:
    """Return the range of numbers that agree with a statement, in words."""
    if np.isinf(low):
        return f"below {format_as_paper(high, unit)}"
    if np.isinf(high):
        return f"above {format_as_paper(low, unit)}"
    return f"{format_as_paper(low, unit)} to {format_as_paper(high, unit)}"


def chapter(text: str, pages: Sequence[str] = ()) -> Chapter:
    """Return a chapter in Markdown as HTML, with anchors at its headings and formulas as MathML.

    Links to documents that are pages lead there, others into the repository become plain text.
    Raises ValueError if the text does not begin with a title, ``# ...``.
    """
    heading, _, body = text.partition("\n")
    if not heading.startswith("# "):
        raise ValueError(f"expected a text that begins with '# ' and a title, found {heading!r}")
    markdown = MarkdownIt("commonmark").enable("table")
    markdown.use(dollarmath_plugin, allow_space=False, allow_digits=False, renderer=_mathml)
    tokens = markdown.parse(LINK.sub(lambda link: _page_link(link, pages), body))
    _keep_units(tokens)
    _label_cells(tokens)
    sections = _set_anchors(tokens)
    return Chapter(heading[2:], markdown.renderer.render(tokens, markdown.options, {}), sections)


def _mathml(formula: str, options: Mapping[str, bool]) -> str:
    """Return a formula in LaTeX as MathML; `options` says whether it has a line of its own."""
    from latex2mathml.converter import convert  # here, because it takes long to load

    return convert(formula, display="block" if options["display_mode"] else "inline")


def _page_link(link: re.Match[str], pages: Sequence[str]) -> str:
    """Return a link to a page in place of one to its document, the words of any other link."""
    words, document, anchor = link.groups(default="")
    return f"[{words}]({document}.html{anchor})" if document in pages else words


def _keep_units(tokens: Sequence[Token]) -> None:
    """Keep numbers and their units on a line, except in code."""
    for token in tokens:
        for part in token.children or []:
            if part.type == "text":
                part.content = unbroken(part.content)


def _set_anchors(tokens: Sequence[Token]) -> list[tuple[str, str]]:
    """Set the anchor of each heading, as GitHub does; return the anchors and headings."""
    sections = []
    for token, content in pairwise(tokens):
        if token.type == "heading_open":
            anchor = re.sub(r"[^\w\- ]", "", content.content.lower()).replace(" ", "-")
            token.attrSet("id", anchor)
            sections.append((anchor, content.content))
    return sections


def _label_cells(tokens: Sequence[Token]) -> None:
    """Mark the headings of Markdown tables as column headings, and label each cell with one.

    Cells show the label on a page that is too narrow for a header.
    """
    labels: list[str] = []
    column = 0
    for token, content in pairwise(tokens):
        if token.type == "table_open":
            token.attrSet("class", "stacked")
            labels = []
        elif token.type == "tr_open":
            column = 0
        elif token.type == "th_open":
            token.attrSet("scope", "col")
            labels.append(content.content)
        elif token.type == "td_open":
            token.attrSet("data-label", labels[column])
            column += 1
