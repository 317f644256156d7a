"""Pages of the report that are no figures: verdicts, chapters of text, parameters and versions."""

import re
from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
import yaml
from markdown_it import MarkdownIt
from markdown_it.token import Token

from hardcontact.base.printing import is_boundless, print_as_paper
from hardcontact.paper.selection import NO_SCAN
from hardcontact.paper.verdicts import BY_CONSTRUCTION, MIN_STABILITY, summary
from hardcontact.report.quantities import NO_INTERVAL
from hardcontact.report.templates import rendered


class Chapter(NamedTuple):
    """A chapter in Markdown as a page takes it."""

    title: str  #: Plain text.
    html: str  #: The rest.
    sections: list[tuple[str, str]]  #: Anchor and heading of each section, in their order.


def pages(
    claims: pd.DataFrame,
    texts: Mapping[str, str],
    configuration: Mapping[str, Any],
    versions: Mapping[str, str],
) -> dict[str, str]:
    """Return the HTML of `claims`, of each text under its name, and of `parameters`.

    Claims are as from `verdicts.add_open_ends`, texts are chapters in Markdown, the configuration
    is that of the study as it was given, versions are those of packages.
    """
    confidence = configuration["inference"]["confidence"]
    parameters = yaml.safe_dump(configuration, allow_unicode=True)
    return {
        "claims": rendered("claims.html", confidence=confidence, **claim_facts(claims)),
        **{name: rendered("chapter.html", chapter=chapter(text)) for name, text in texts.items()},
        "parameters": rendered("parameters.html", parameters=parameters, versions=versions),
    }


def plain_rows(table: pd.DataFrame) -> list[dict[Any, Any]]:
    """Return the rows of a table as plain values, None for NaN, which JSON lacks."""
    return table.astype(object).where(table.notna(), None).to_dict("records")


def claim_facts(claims: pd.DataFrame) -> dict[str, Any]:
    """Return what templates show of claims as from `verdicts.add_open_ends`.

    `claims` are rows by their ids, each with its `_meaning`; `counts` rows of
    `verdicts.summary`; `unstable` is the number of verdicts that may change with the seed,
    `without_scan` that of independent findings that are reproduced from printed numbers alone.
    """
    pairs = zip(plain_rows(claims), claims.to_dict("records"), strict=True)
    facts = {str(row["id"]): plain | _meaning(row) for plain, row in pairs}
    return {
        "claims": facts,
        "counts": summary(claims).to_dict("records"),
        "unstable": sum(row["may_change"] for row in facts.values()),
        "without_scan": sum(
            (row["kind"], row["verdict"], row["basis"]) == ("independent", "reproduced", NO_SCAN)
            for row in facts.values()
        ),
    }


def _meaning(row: Mapping[Any, Any]) -> dict[str, Any]:
    """Return what a row of the claims means: its numbers as printed, and its kind."""
    unit, interval = row["unit"], (row["low"], row["high"])
    kind = "follows" if row["follows_from"] else "independent"
    computed_text = print_as_paper(row["computed"], unit, interval, open_end=row["open_end"])
    if is_boundless(row["computed"], *interval, unit):
        computed_text = f"{print_as_paper(row['computed'], unit)} ({NO_INTERVAL['not_bounded']})"
    return {
        "published_text": print_as_paper(row["published"], unit),
        "accepted_text": _accepted(row["accepted_low"], row["accepted_high"], unit),
        "computed_text": computed_text,
        "may_change": row["stability"] < MIN_STABILITY,
        "kind": BY_CONSTRUCTION if row["verdict"] == BY_CONSTRUCTION else kind,
    }


def _accepted(low: float, high: float, unit: str) -> str:
    """Return the range in which a number agrees with a statement."""
    if np.isinf(low):
        return f"below {print_as_paper(high, unit)}"
    if np.isinf(high):
        return f"above {print_as_paper(low, unit)}"
    return f"{print_as_paper(low, unit)} to {print_as_paper(high, unit)}"


def chapter(text: str) -> Chapter:
    """Return a chapter in Markdown as HTML, with anchors at its headings.

    Raises ValueError if the text does not begin with its title, ``# ...``. Links into the
    repository are replaced by their text, because they do not work from a page.
    """
    first, _, body = text.partition("\n")
    if not first.startswith("# "):
        raise ValueError(f"expected a text that begins with '# ' and a title, found {first!r}")
    unlinked = re.sub(r"\[([^\]]+)\]\((?!https?:)[^)]+\)", r"\1", body)
    markdown = MarkdownIt("commonmark").enable("table")
    tokens = markdown.parse(unlinked)
    _label_cells(tokens)
    sections = _anchored(tokens)
    return Chapter(first[2:], markdown.renderer.render(tokens, markdown.options, {}), sections)


def _anchored(tokens: Sequence[Token]) -> list[tuple[str, str]]:
    """Set the anchor of each heading, and return anchors and headings."""
    sections = []
    for token, content in pairwise(tokens):
        if token.type == "heading_open":
            anchor = re.sub(r"\W+", "-", content.content.lower()).strip("-")
            token.attrSet("id", anchor)
            sections.append((anchor, content.content))
    return sections


def _label_cells(tokens: Sequence[Token]) -> None:
    """Say of each heading of a Markdown table that it is its column's, and name it in each cell.

    Cells show the name on a page that is too narrow for a header.
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
