"""HTML pages of the report: verdicts, chapters of text, parameters and versions."""

import re
from collections.abc import Iterable, Mapping, Sequence
from html import escape
from itertools import pairwise
from typing import Any

import numpy as np
import pandas as pd
import yaml
from markdown_it import MarkdownIt
from markdown_it.token import Token

from hardcontact.claims.set_spread import STABLE
from hardcontact.claims.verdicts import summary
from hardcontact.numbers.printing import print_as_paper

STYLE = """
body { font: 15px/1.5 sans-serif; max-width: 70em; margin: 2em auto; padding: 0 1em; color: #222 }
table { border-collapse: collapse; width: 100% }
th, td { text-align: left; vertical-align: top; padding: 0.3em 0.6em }
tr { border-bottom: 1px solid #ddd }
td.number { white-space: nowrap }
small { display: block; color: #666 }
pre { background: #f5f5f5; padding: 1em; overflow-x: auto }
.reproduced { background: #d9efd9 } .consistent { background: #eef5d6 }
.undecided { background: #fbf0cc } .not-reproduced { background: #f7dcd5 }
.by-construction, .not-testable-on-substitutes { background: #eee }
@media (max-width: 50em) {
  th { display: none }
  td { display: block; padding: 0.1em 0.6em }
  td.number { white-space: normal }
  td:not(:first-child):not(:empty)::before { content: attr(data-label) ": "; color: #666 }
  tr { display: block; padding: 0.5em 0 }
}
"""

#: What each verdict means, in the order of `VERDICTS`.
MEANINGS = (
    "the whole interval agrees with the statement",
    "the number agrees, but no interval can be given",
    "the interval holds numbers that agree and numbers that do not",
    "no number of the interval agrees, or there is none",
    "an identity, or a number that the substitute scans are made to meet",
    "the substitute scans assume it",
)


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
        As from `open_ends.with_open_ends`.
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
    return {
        "claims": claims_page(claims, configuration["inference"]["confidence"]),
        **{name: text_page(text) for name, text in texts.items()},
        "parameters": parameters_page(configuration, versions),
    }


def claims_page(claims: pd.DataFrame, confidence: float) -> str:
    """Write the page of the evaluated claims: counts of verdicts, then section by section."""
    independent = summary(claims)["independent"].sum()
    sections = (f"<h2>{escape(k)}</h2>\n{table}" for k, table in section_tables(claims).items())
    return _page(
        f"Verdicts on {independent} findings in {len(claims)} statements of the paper",
        f"<p>Of {len(claims)} statements {independent} are independent findings; the others restate"
        " one of them, follow from it or hold by construction. On coarse grids rows of Table 1"
        " that scans cannot be made to meet count as findings, too. Square brackets: "
        f"{100 * confidence:g} % interval. <em>Holds in</em>: the share of equally good sets of "
        "scans in which the statement holds. "
        f"{(claims['stability'] < STABLE).sum()} verdicts may change with the seed: one redraw of "
        "all sets in twenty or more gives another. These say how many keep it.</p>\n"
        + "\n".join([counts_table(claims), *sections]),
    )


def counts_table(claims: pd.DataFrame) -> str:
    """Write how often each verdict was reached, and what it means.

    Parameters
    ----------
    claims : pandas.DataFrame
        As from `open_ends.with_open_ends`.

    Returns
    -------
    str
        An HTML table.
    """
    rows = [
        [(verdict, _kind(verdict)), (str(alone), ""), (str(every), ""), (meaning, "")]
        for (verdict, alone, every), meaning in zip(
            summary(claims).itertuples(index=False), MEANINGS, strict=True
        )
    ]
    return _table(("verdict", "independent findings", "all statements", "meaning"), rows)


def section_tables(claims: pd.DataFrame) -> dict[str, str]:
    """Write the claims of each section of the paper, with their numbers and verdicts.

    Parameters
    ----------
    claims : pandas.DataFrame
        As from `open_ends.with_open_ends`.

    Returns
    -------
    dict of str to str
        An HTML table by the name of the section, in the order of the claims.
    """
    header = ("statement", "paper", "computed", "holds in", "verdict")
    return {
        str(name): _table(header, map(_claim, rows.itertuples()))
        for name, rows in claims.groupby("section", sort=False)
    }


def text_page(text: str) -> str:
    """Write a chapter as a page.

    Parameters
    ----------
    text : str
        As `chapter` takes it.

    Returns
    -------
    str
        HTML.

    Raises
    ------
    ValueError
        As `chapter`.
    """
    return _page(*chapter(text))


def chapter(text: str) -> tuple[str, str]:
    """Return the title of a chapter and the rest of it as HTML.

    Links into the repository are replaced by their text, because they do not work from a page.

    Parameters
    ----------
    text : str
        Markdown that begins with its title, ``# ...``.

    Returns
    -------
    title : str
        Plain text.
    body : str
        HTML; its headings begin with ``h2``.

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
    return first[2:], str(markdown.renderer.render(tokens, markdown.options, {}))


def _label_cells(tokens: Sequence[Token]) -> None:
    """Give each cell of a Markdown table its column's name, for a page too narrow for a header."""
    labels: list[str] = []
    column = 0
    for token, content in pairwise(tokens):
        if token.type == "table_open":
            labels = []
        elif token.type == "tr_open":
            column = 0
        elif token.type == "th_open":
            labels.append(content.content)
        elif token.type == "td_open":
            token.attrSet("data-label", labels[column])
            column += 1


def parameters_page(configuration: Mapping[str, Any], versions: Mapping[str, str]) -> str:
    """Write the page of parameters and versions."""
    rows = [[(escape(name), ""), (escape(number), "number")] for name, number in versions.items()]
    text = yaml.safe_dump(configuration, allow_unicode=True)
    return _page(
        "Parameters and versions",
        f"<pre>{escape(text)}</pre>\n" + _table(("package", "version"), rows),
    )


def _page(title: str, body: str) -> str:
    return (
        '<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">'
        '<meta name="viewport" content="width=device-width, initial-scale=1">'
        f"<title>{escape(title)}</title><style>{STYLE}</style></head>\n"
        f"<body><h1>{escape(title)}</h1>\n{body}\n</body></html>\n"
    )


def _table(header: Sequence[str], rows: Iterable[Sequence[tuple[str, str]]]) -> str:
    """Return a table of cells that are escaped already, each with its class."""
    head = "".join(f"<th>{escape(cell)}</th>" for cell in header)
    lines = (
        "<tr>"
        + "".join(
            f'<td class="{kind}" data-label="{escape(label)}">{cell}</td>'
            for label, (cell, kind) in zip(header, row, strict=True)
        )
        + "</tr>"
        for row in rows
    )
    body = "\n".join(lines)
    return f"<table><thead><tr>{head}</tr></thead><tbody>\n{body}</tbody></table>"


def _claim(row: Any) -> list[tuple[str, str]]:
    """Return the cells of one claim, each with its class."""
    source = f"Follows from {row.follows_from}." if row.follows_from else ""
    computed = print_as_paper(row.computed, row.unit, (row.low, row.high), open_end=row.open_end)
    seed = f"kept in {100 * row.stability:.0f} % of redraws" if row.stability < STABLE else ""
    return [
        (escape(row.statement) + _small(row.id) + _small(source) + _small(row.note), ""),
        (escape(print_as_paper(row.published, row.unit)), "number"),
        (escape(computed), "number"),
        ("" if np.isnan(row.frequency) else f"{100 * row.frequency:.0f} %", "number"),
        (escape(row.verdict) + _small(seed) + _small(row.basis), _kind(row.verdict)),
    ]


def _kind(verdict: str) -> str:
    """Return the class of a verdict."""
    return verdict.replace(" ", "-")


def _small(text: str) -> str:
    return f"<small>{escape(text)}</small>" if text else ""
