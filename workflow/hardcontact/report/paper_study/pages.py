"""Pages of the paper's study: its answer, all figures with Table 1, and chapters in Markdown."""

import re
from collections.abc import Collection, Mapping, Sequence
from itertools import groupby, pairwise
from typing import Any, NamedTuple

import pandas as pd
import yaml
from markdown_it import MarkdownIt
from markdown_it.token import Token
from mdit_py_plugins.dollarmath import dollarmath_plugin

from hardcontact.report.figures.listing import PAPER_FIGURES, Description, describe_figure
from hardcontact.report.paper_study.answer import ANSWER_CLAIMS
from hardcontact.report.paper_study.tables import claim_facts
from hardcontact.report.quantities import numbers_of_answer
from hardcontact.report.templates import Frame, render_document, render_page, unbroken

#: A link of Markdown within the repository: its words, the document without `.md`, and the anchor.
LINK = re.compile(r"\[([^\]]+)\]\((?!https?:)([^)#]+?)(?:\.md)?(#[^)]*)?\)")


class Chapter(NamedTuple):
    """A chapter in Markdown, converted for a page."""

    title: str  #: Plain text.
    html: str  #: HTML of the text below the title.
    sections: list[tuple[str, str]]  #: Anchor and heading of each section, in their order.


def paper_page(
    answer: Mapping[str, Any],
    claims: pd.DataFrame,
    figures: Mapping[str, bytes],
    captions: Mapping[str, Description],
    citation: Mapping[str, Any],
    frame: Frame,
) -> str:
    """Return the page of the paper's study.

    `claims` comes from `read_judged_claims`; `figures` (SVG) and `captions` are by figure name.
    """
    numbers = numbers_of_answer(answer)
    artificial_claims = [
        claim
        for name, claim in ANSWER_CLAIMS.items()
        if name in numbers and numbers[name].source == "artificial"
    ]
    facts = claim_facts(claims, int(numbers["sets"].value), numbers["confidence"].value)
    facts |= {"captions": captions, "artificial_claims": artificial_claims}
    return render_page(answer, figures, citation, frame, **facts)


def figures_page(
    answer: Mapping[str, Any],
    table1: Sequence[Sequence[str]],
    figures: Mapping[str, bytes],
    captions: Mapping[str, Description],
    frame: Frame,
) -> str:
    """Return the page of all figures of the paper's study, and of Table 1 from `table1_rows`."""
    groups = groupby(PAPER_FIGURES, key=lambda name: describe_figure(name).chapter)
    figure_groups = [(heading, list(names)) for heading, names in groups]
    facts = {"answer": answer, "table1": table1, "figures": figures, "captions": captions}
    return render_document("figures.html", frame, "figures", figure_groups=figure_groups, **facts)


def report_pages(
    claims: pd.DataFrame,
    changed_inputs: Sequence[Mapping[str, str]],
    chapters: Mapping[str, str],
    configuration: Mapping[str, Any],
    versions: Mapping[str, str],
    frame: Frame,
) -> dict[str, str]:
    """Return the report's pages as HTML by name: `claims`, each chapter, `parameters`.

    `claims` comes from `read_judged_claims`, `changed_inputs` from `paper.changed_inputs`.
    `chapters` are texts in Markdown by page.
    """
    confidence = configuration["intervals"]["confidence"]
    facts = claim_facts(claims, configuration["sets"]["count"], confidence)
    facts |= {"changed": changed_inputs, "confidence": confidence}
    pages = {"claims": render_document("claims.html", frame, "claims", **facts)}
    for name, text in chapters.items():
        chapter = convert_chapter(text, frame.pages)
        pages[name] = render_document("chapter.html", frame, name, chapter=chapter)
    facts = {"parameters": yaml.safe_dump(configuration, allow_unicode=True), "versions": versions}
    pages["parameters"] = render_document("parameters.html", frame, "parameters", **facts)
    return pages


def convert_chapter(text: str, pages: Collection[str] = ()) -> Chapter:
    """Return a chapter in Markdown as HTML, with anchors at its headings and formulas as MathML.

    A link to a document of `pages` leads to its page; other links into the repository become text.
    Raises ValueError if the text does not begin with a title, ``# ...``.
    """
    heading, _, body = text.partition("\n")
    if not heading.startswith("# "):
        raise ValueError(f"expected a text that begins with '# ' and a title, found {heading!r}")
    markdown = MarkdownIt("commonmark").enable("table")
    markdown.use(
        dollarmath_plugin, allow_space=False, allow_digits=False, renderer=_formula_as_mathml
    )
    tokens = markdown.parse(LINK.sub(lambda link: _page_link(link, pages), body))
    _keep_units(tokens)
    _label_cells(tokens)
    sections = _set_anchors(tokens)
    return Chapter(heading[2:], markdown.renderer.render(tokens, markdown.options, {}), sections)


def _formula_as_mathml(formula: str, options: Mapping[str, bool]) -> str:
    """Return a formula in LaTeX as MathML; `options` says whether it has a line of its own."""
    from latex2mathml.converter import convert

    return convert(formula, display="block" if options["display_mode"] else "inline")


def _page_link(link: re.Match[str], pages: Collection[str]) -> str:
    """Return a link to the page of a document, or the words of the link if there is no page."""
    words, document, anchor = link.groups(default="")
    return f"[{words}]({document}.html{anchor})" if document in pages else words


def _keep_units(tokens: Sequence[Token]) -> None:
    """Keep each number and its unit on one line, except in code."""
    for token in tokens:
        for child in token.children or []:
            if child.type == "text":
                child.content = unbroken(child.content)


def _set_anchors(tokens: Sequence[Token]) -> list[tuple[str, str]]:
    """Set the anchor of each heading, as GitHub does; return the anchors and headings."""
    sections = []
    for opening, inline in pairwise(tokens):
        if opening.type == "heading_open":
            anchor = re.sub(r"[^\w\- ]", "", inline.content.lower()).replace(" ", "-")
            opening.attrSet("id", anchor)
            sections.append((anchor, inline.content))
    return sections


def _label_cells(tokens: Sequence[Token]) -> None:
    """Label the cells of tables with the headings of their columns, which narrow screens show."""
    labels: list[str] = []
    column = 0
    for opening, inline in pairwise(tokens):
        if opening.type == "table_open":
            opening.attrSet("class", "stacked")
            labels = []
        elif opening.type == "tr_open":
            column = 0
        elif opening.type == "th_open":
            opening.attrSet("scope", "col")
            labels.append(inline.content)
        elif opening.type == "td_open":
            opening.attrSet("data-label", labels[column])
            column += 1
