"""One self-contained HTML document: reads on a phone, needs no network and no scripts."""

import base64
import re
from collections.abc import Iterable, Sequence
from html import escape

STYLE = """
:root { color-scheme: light }
* { box-sizing: border-box }
body { font: 16px/1.5 system-ui, sans-serif; max-width: 62rem; margin: 0 auto; padding: 0.5rem 1rem
  3rem; color: #222; background: #fff; overflow-wrap: anywhere }
h1 { font-size: 1.5rem; line-height: 1.25; margin: 1rem 0 }
h2 { font-size: 1.2rem; margin: 2rem 0 0.5rem; border-bottom: 1px solid #ccc }
h3 { font-size: 1rem; margin: 1.2rem 0 0.3rem }
p, li { max-width: 46rem }
a { color: #005a9c }
.answer { background: #eaf3fa; border-left: 4px solid #0072b2; padding: 0.3rem 1rem;
  margin: 1rem 0 }
.answer p { font-size: 1.08rem }
.notice { background: #fbf0cc; border-left: 4px solid #e69f00; padding: 0.3rem 1rem;
  margin: 1rem 0 }
.figures { display: grid; gap: 1rem; align-items: start;
  grid-template-columns: repeat(auto-fit, minmax(min(100%, 24rem), 1fr)) }
figure { margin: 0.5rem 0; max-width: 34rem }
img { display: block; width: 100%; height: auto }
figcaption, small { color: #555; font-size: 0.88rem; line-height: 1.4 }
table { border-collapse: collapse; width: 100%; margin: 0.5rem 0; font-size: 0.94rem }
th, td { overflow-wrap: normal; text-align: left; vertical-align: top;
  padding: 0.3rem 0.6rem 0.3rem 0 }
td:first-child { overflow-wrap: anywhere; min-width: 9rem }
tr { border-bottom: 1px solid #ddd }
@media (max-width: 45rem) {
  thead { display: none }
  tr { display: block; padding: 0.5rem 0 }
  td { display: block; padding: 0.1rem 0; overflow-wrap: anywhere }
  td:first-child { font-weight: bold }
  td:empty { display: none }
  td:not(:first-child)::before { content: attr(data-label) ": "; color: #666 }
  .print img { width: 40rem; max-width: none }
}
.print { overflow-x: auto }
.print figure { max-width: none }
.print figcaption { max-width: 46rem; position: sticky; left: 0 }
td, th { overflow-wrap: break-word }
td small { display: block; font-weight: normal }
summary { cursor: pointer; padding: 0.4rem 0 }
.reproduced { background: #d9efd9 } .consistent { background: #eef5d6 }
.undecided { background: #fbf0cc } .not-reproduced { background: #f7dcd5 }
.by-construction, .not-testable-on-substitutes { background: #eee }
td[class]:not(.number) { padding-left: 0.4rem }
@media (min-width: 45rem) { .number { white-space: nowrap } }
"""


#: A space between a number, or the end of its interval, and its unit.
BEFORE_UNIT = re.compile(r"(?<=[\d\]]) (?=(?:[pnµm]?[Nm]|m?J/m²|[GM]?Pa|%)(?!\w))")


def page(title: str, body_html: str) -> str:
    """Return one self-contained HTML document."""
    return (
        '<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">'
        '<meta name="viewport" content="width=device-width, initial-scale=1">'
        f"<title>{escape(title)}</title><style>{STYLE}</style></head>\n"
        f"<body><h1>{escape(title)}</h1>\n{body_html}\n</body></html>\n"
    )


def figure_html(png_bytes: bytes, alt: str, caption: str) -> str:
    """Return a figure as HTML that holds its picture."""
    data = base64.b64encode(png_bytes).decode("ascii")
    return (
        f'<figure><img src="data:image/png;base64,{data}" alt="{escape(alt)}">'
        f"<figcaption>{text_html(caption)}</figcaption></figure>"
    )


def table_html(header: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Return a table as HTML, whose cells name their column where the screen is narrow."""
    head = "".join(f"<th>{escape(name)}</th>" for name in header)
    lines = "\n".join(
        "<tr>"
        + "".join(
            f'<td data-label="{escape(name)}">{text_html(cell)}</td>'
            for name, cell in zip(header, row, strict=True)
        )
        + "</tr>"
        for row in rows
    )
    return f"<table><thead><tr>{head}</tr></thead><tbody>\n{lines}</tbody></table>"


def list_html(items: Iterable[str]) -> str:
    """Return plain texts as a list in HTML."""
    lines = "".join(f"<li>{text_html(item)}</li>" for item in items)
    return f"<ul>{lines}</ul>"


def text_html(text: str) -> str:
    """Return plain text as HTML in which no line ends between a number and its unit."""
    return escape(BEFORE_UNIT.sub("\N{NO-BREAK SPACE}", text))
