"""HTML pages of the report: verdicts, chapters of text, parameters and versions."""

import re
from collections.abc import Iterable, Mapping, Sequence
from html import escape
from typing import Any

import numpy as np
import pandas as pd
import yaml
from markdown_it import MarkdownIt

from hardcontact.claims.verdicts import summary

__all__ = ["claims_page", "pages", "parameters_page", "text_page"]

STYLE = """
body { font: 15px/1.5 sans-serif; max-width: 70em; margin: 2em auto; padding: 0 1em; color: #222 }
table { border-collapse: collapse; width: 100% }
th, td { text-align: left; vertical-align: top; padding: 0.3em 0.6em }
tr { border-bottom: 1px solid #ddd }
td.number { white-space: nowrap }
small { display: block; color: #666 }
pre { background: #f5f5f5; padding: 1em; overflow-x: auto }
.reproduced { background: #d9efd9 } .consistent { background: #eef5d6 }
.not-reproduced { background: #f7dcd5 } .not-testable-on-substitutes { background: #eee }
"""


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
        As from `verdicts.read_verdicts`.
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
    """Write the page of the evaluated claims, section by section as in the paper.

    Parameters
    ----------
    claims : pandas.DataFrame
        As from `verdicts.read_verdicts`.
    confidence : float
        Of the intervals.

    Returns
    -------
    str
        HTML.
    """
    counts = ", ".join(f"{row.claims} {row.verdict}" for row in summary(claims).itertuples())
    rows = (_claim(row) for row in claims.fillna({"note": ""}).itertuples())
    header = ("section", "statement", "paper", "computed", "verdict")
    return _page(
        f"Verdicts on {len(claims)} statements of the paper",
        f"<p>{escape(counts)}. Square brackets: {100 * confidence:g} % interval.</p>\n"
        + _table(header, rows),
    )


def text_page(text: str) -> str:
    """Write a chapter as a page.

    Links into the repository are replaced by their text, because they do not work from the page.

    Parameters
    ----------
    text : str
        Markdown that begins with its title, ``# ...``.

    Returns
    -------
    str
        HTML.

    Raises
    ------
    ValueError
        If the text does not begin with a title.
    """
    first, _, body = text.partition("\n")
    if not first.startswith("# "):
        raise ValueError(f"expected a text that begins with '# ' and a title, found {first!r}")
    unlinked = re.sub(r"\[([^\]]+)\]\((?!https?:)[^)]+\)", r"\1", body)
    html: str = MarkdownIt("commonmark").enable("table").render(unlinked)
    return _page(first[2:], html)


def parameters_page(configuration: Mapping[str, Any], versions: Mapping[str, str]) -> str:
    """Write the page of parameters and versions.

    Parameters
    ----------
    configuration : mapping
        As it was given.
    versions : mapping of str to str
        Of packages.

    Returns
    -------
    str
        HTML.
    """
    rows = [[(escape(name), ""), (escape(number), "number")] for name, number in versions.items()]
    text = yaml.safe_dump(configuration, allow_unicode=True)
    return _page(
        "Parameters and versions",
        f"<pre>{escape(text)}</pre>\n" + _table(("package", "version"), rows),
    )


def _page(title: str, body: str) -> str:
    return (
        f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"><title>{escape(title)}'
        f"</title><style>{STYLE}</style></head>\n<body><h1>{escape(title)}</h1>\n{body}\n"
        "</body></html>\n"
    )


def _table(header: Sequence[str], rows: Iterable[Sequence[tuple[str, str]]]) -> str:
    """Return a table of cells that are escaped already, each with its class."""
    head = "".join(f"<th>{escape(cell)}</th>" for cell in header)
    lines = (
        "<tr>" + "".join(f'<td class="{kind}">{cell}</td>' for cell, kind in row) + "</tr>"
        for row in rows
    )
    return f"<table><tr>{head}</tr>\n" + "\n".join(lines) + "</table>"


def _claim(row: Any) -> list[tuple[str, str]]:
    """Return the cells of one claim, each with its class."""
    return [
        (escape(row.section), ""),
        (escape(row.statement) + _small(row.note), ""),
        (_number(row.published), "number"),
        (_computed(row), "number"),
        (escape(row.verdict) + _small(row.basis), row.verdict.replace(" ", "-")),
    ]


def _small(text: str) -> str:
    return f"<small>{escape(text)}</small>" if text else ""


def _number(value: float) -> str:
    return "" if np.isnan(value) else f"{value:.3g}"


def _computed(row: Any) -> str:
    if np.isnan(row.computed):
        return ""
    interval = "" if np.isnan(row.low) else f" [{row.low:.3g}, {row.high:.3g}]"
    unit = "" if row.unit == "1" else f" {escape(row.unit)}"
    return _number(row.computed) + interval + unit
