"""Pages of the report that are no figures: verdicts, chapters of text, parameters and versions."""

import re
from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import Any, NamedTuple

import pandas as pd
import yaml
from markdown_it import MarkdownIt
from markdown_it.token import Token

from hardcontact.answer.paper_answer import plain_rows
from hardcontact.answer.templates import rendered
from hardcontact.claims.verdicts import BY_CONSTRUCTION, STABLE, summary
from hardcontact.numbers.printing import print_as_paper


class Chapter(NamedTuple):
    """A chapter in Markdown as a page takes it.

    Attributes
    ----------
    title : str
        Plain text.
    html : str
        The rest.
    sections : list of tuple of str
        Anchor and heading of each section, in their order.
    """

    title: str
    html: str
    sections: list[tuple[str, str]]


def pages(
    claims: pd.DataFrame,
    texts: Mapping[str, str],
    configuration: Mapping[str, Any],
    versions: Mapping[str, str],
) -> dict[str, str]:
    """Write all pages.

    Parameters
    ----------
    claims : pandas.DataFrame
        As from `verdicts.with_open_ends`.
    texts : mapping of str to str
        Chapters in Markdown.
    configuration : mapping
        Of the study, as it was given.
    versions : mapping of str to str
        Of packages.

    Returns
    -------
    dict of str to str
        HTML of `claims`, of each text under its name, and of `parameters`.
    """
    confidence = configuration["inference"]["confidence"]
    parameters = yaml.safe_dump(configuration, allow_unicode=True)
    return {
        "claims": rendered("claims.html", confidence=confidence, **claim_facts(claims)),
        **{name: rendered("chapter.html", chapter=chapter(text)) for name, text in texts.items()},
        "parameters": rendered("parameters.html", parameters=parameters, versions=versions),
    }


def claim_facts(claims: pd.DataFrame) -> dict[str, Any]:
    """Return the claims as plain values, and how many of them have each verdict.

    Parameters
    ----------
    claims : pandas.DataFrame
        As from `verdicts.with_open_ends`.

    Returns
    -------
    dict
        `claims`: rows by their ids, each with what `claim_values` adds; `counts`: rows of
        `verdicts.summary`; `unstable`: the number of verdicts that may change with the seed.
    """
    facts = {str(row["id"]): row | claim_values(row) for row in plain_rows(claims)}
    return {
        "claims": facts,
        "counts": summary(claims).to_dict("records"),
        "unstable": sum(row["may_change"] for row in facts.values()),
    }


def claim_values(row: Mapping[str, Any]) -> dict[str, Any]:
    """Return what a plain row of the claims means: its numbers as printed, and its kind."""
    published, computed = (_number(row[name]) for name in ("published", "computed"))
    interval = _number(row["low"]), _number(row["high"])
    kind = "follows" if row["follows_from"] else "independent"
    return {
        "published_text": print_as_paper(published, row["unit"]),
        "computed_text": print_as_paper(computed, row["unit"], interval, open_end=row["open_end"]),
        "may_change": row["stability"] is not None and row["stability"] < STABLE,
        "kind": BY_CONSTRUCTION if row["verdict"] == BY_CONSTRUCTION else kind,
    }


def _number(value: float | None) -> float:
    return float("nan") if value is None else value


def chapter(text: str, level: int = 2) -> Chapter:
    """Return a chapter as HTML.

    Links into the repository are replaced by their text, because they do not work from a page.

    Parameters
    ----------
    text : str
        Markdown that begins with its title, ``# ...``.
    level : int
        Of the headings of its sections, ``## ...``.

    Returns
    -------
    Chapter
        Its headings have anchors.

    Raises
    ------
    ValueError
        If the text does not begin with a title.
    """
    first, _, body = text.partition("\n")
    if not first.startswith("# "):
        raise ValueError(f"expected a text that begins with '# ' and a title, found {first!r}")
    unlinked = re.sub(r"\[([^\]]+)\]\((?!https?:)[^)]+\)", r"\1", body)
    markdown = MarkdownIt("commonmark").enable("table")
    tokens = markdown.parse(unlinked)
    _label_cells(tokens)
    sections = _anchored(tokens, level)
    return Chapter(first[2:], markdown.renderer.render(tokens, markdown.options, {}), sections)


def _anchored(tokens: Sequence[Token], level: int) -> list[tuple[str, str]]:
    """Set level and anchor of each heading, and return anchors and headings."""
    sections = []
    for token, content in pairwise(tokens):
        if token.type.startswith("heading"):
            token.tag = f"h{int(token.tag[1:]) + level - 2}"
        if token.type == "heading_open":
            anchor = re.sub(r"\W+", "-", content.content.lower()).strip("-")
            token.attrSet("id", anchor)
            sections.append((anchor, content.content))
    return sections


def _label_cells(tokens: Sequence[Token]) -> None:
    """Give each cell of a Markdown table its column's name, for a page too narrow for a header."""
    labels: list[str] = []
    column = 0
    for token, content in pairwise(tokens):
        if token.type == "table_open":
            token.attrSet("class", "stacked")
            labels = []
        elif token.type == "tr_open":
            column = 0
        elif token.type == "th_open":
            labels.append(content.content)
        elif token.type == "td_open":
            token.attrSet("data-label", labels[column])
            column += 1
