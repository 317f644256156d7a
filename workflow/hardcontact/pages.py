"""Pages of the report that are no figures: verdicts, departures, parameters and versions."""

import re
from html import escape
from pathlib import Path

import numpy as np
import pandas as pd
import yaml
from markdown_it import MarkdownIt

from hardcontact.claims import summary

__all__ = ["claims_page", "departures_page", "parameters_page", "read_claims"]

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


def _page(title, body):
    return (
        f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"><title>{escape(title)}'
        f"</title><style>{STYLE}</style></head>\n<body><h1>{escape(title)}</h1>\n{body}\n"
        "</body></html>\n"
    )


def _table(header, rows):
    """HTML of a table; rows: already escaped cells, each with its class."""
    head = "".join(f"<th>{escape(cell)}</th>" for cell in header)
    lines = (
        "<tr>" + "".join(f'<td class="{kind}">{cell}</td>' for cell, kind in row) + "</tr>"
        for row in rows
    )
    return f"<table><tr>{head}</tr>\n" + "\n".join(lines) + "</table>"


def read_claims(path):
    """The table of evaluated claims. Raises ValueError if the file ends within a line."""
    if not Path(path).read_bytes().endswith(b"\n"):
        raise ValueError(
            f"{path}: expected a whole table, found one that is cut short; delete it and run again"
        )
    return pd.read_csv(path)


def claims_page(claims):
    """HTML of the evaluated claims (`claims.evaluate`), section by section as in the paper."""
    counts = ", ".join(f"{row.claims} {row.verdict}" for row in summary(claims).itertuples())
    rows = [
        [
            (escape(row.section), ""),
            (escape(row.statement) + _small(row.note), ""),
            (_number(row.published), "number"),
            (_computed(row), "number"),
            (escape(row.verdict) + _small(row.basis), row.verdict.replace(" ", "-")),
        ]
        for row in claims.fillna({"note": ""}).itertuples()
    ]
    header = ("section", "statement", "paper", "computed", "verdict")
    return _page(
        f"Verdicts on {len(claims)} statements of the paper",
        f"<p>{escape(counts)}. Square brackets: 95 % interval.</p>\n" + _table(header, rows),
    )


def _small(text):
    return f"<small>{escape(text)}</small>" if text else ""


def _number(value):
    return "" if np.isnan(value) else f"{value:.3g}"


def _computed(row):
    if np.isnan(row.computed):
        return ""
    interval = "" if np.isnan(row.low) else f" [{row.low:.3g}, {row.high:.3g}]"
    unit = "" if row.unit == "1" else f" {escape(row.unit)}"
    return _number(row.computed) + interval + unit


def departures_page(readme):
    """HTML of the README's section on where the study departs from the paper.

    readme: its text (Markdown). Raises ValueError if there is no such section.
    """
    title = "Where the study departs from the paper"
    found = re.search(rf"^## {title}\n(.*?)(?=^## )", readme, re.M | re.S)
    if found is None:
        raise ValueError(f"README.md: expected a section '{title}', found none")
    # Links into the repository lead nowhere from a page that stands alone.
    text = re.sub(r"\[([^\]]+)\]\((?!https?:)[^)]+\)", r"\1", found[1])
    return _page(title, MarkdownIt("commonmark").enable("table").render(text))


def parameters_page(config, versions):
    """HTML of the configuration, as it was given, and of package versions (name -> version)."""
    rows = [[(escape(name), ""), (escape(number), "number")] for name, number in versions.items()]
    text = yaml.safe_dump(config, allow_unicode=True)
    return _page(
        "Parameters and versions",
        f"<pre>{escape(text)}</pre>\n" + _table(("package", "version"), rows),
    )
