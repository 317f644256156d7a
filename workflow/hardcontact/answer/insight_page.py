"""The page on what decides the band: a question, its answer and a figure for each part."""

from collections.abc import Iterator, Mapping, Sequence
from html import escape
from typing import NamedTuple

import pandas as pd

from hardcontact.answer.captions import Caption
from hardcontact.answer.html import figure_html, page, text_html
from hardcontact.answer.part_text import listed, print_percent
from hardcontact.claims.quantity_text import print_as_paper
from hardcontact.figures.catalogue import OF_INSIGHT

__all__ = ["AnsweredPart", "insight_page"]

TITLE = "What decides the band?"


class AnsweredPart(NamedTuple):
    """What the page shows of a part.

    Attributes
    ----------
    question : str
        Its heading.
    sentences : sequence of str
        Its answer, the first of which says most.
    figure : bytes
        PNG.
    caption : Caption
        Of the figure.
    """

    question: str
    sentences: Sequence[str]
    figure: bytes
    caption: Caption


def insight_page(
    parts: Mapping[str, AnsweredPart],
    substitutes: Sequence[str],
    confidence: float,
    constants: pd.DataFrame,
) -> str:
    """Write the page.

    Parameters
    ----------
    parts : mapping of str to AnsweredPart
        By the figures of the parts, in the order of the page.
    substitutes : sequence of str
        Labels of the surfaces that were not measured.
    confidence : float
        Of the intervals.
    constants : pandas.DataFrame
        As from `published.constants`.

    Returns
    -------
    str
        HTML.
    """
    sections = (_opening(substitutes, confidence, constants), _contents(parts), *_parts(parts))
    return page(TITLE, "".join(sections))


def _opening(substitutes: Sequence[str], confidence: float, constants: pd.DataFrame) -> str:
    """Return what the paper found, what is asked here, and what the answers stand on."""
    short, long, reach = (
        print_as_paper(constants["value"][name], "nm")
        for name in ("critical_wavelength_small", "critical_wavelength_large", "range_of_adhesion")
    )
    question = (
        f"The paper finds that roughness with wavelengths between {short} and {long} decides how "
        f"weakly hard bodies stick, at a range of adhesion of {reach}. Do these numbers belong to "
        "the surface, to the attraction or to the sphere? And how far can the method be trusted? "
        "Each part below asks one question, answers it in numbers and shows the figure that they "
        f"are read from. Brackets: intervals of {print_percent(confidence)}."
    )
    basis = "All surfaces are measured."
    if substitutes:
        basis = (
            f"Substitute surfaces: {listed(substitutes)}. No scan of them is at hand, so they are "
            "synthesised from published statistics: what follows holds for random surfaces with "
            "these spectra."
        )
    return f'<p>{text_html(question)}</p>\n<div class="notice"><p>{text_html(basis)}</p></div>\n'


def _contents(parts: Mapping[str, AnsweredPart]) -> str:
    """Return links to the parts, by their questions."""
    links = (
        f'<li><a href="#{name}">{escape(part.question)}</a></li>' for name, part in parts.items()
    )
    return f"<ol>{''.join(links)}</ol>\n"


def _parts(parts: Mapping[str, AnsweredPart]) -> Iterator[str]:
    """Yield question, answer and figure of each part."""
    for name, part in parts.items():
        first, *others = map(text_html, part.sentences)
        items = "".join(f"<li>{sentence}</li>" for sentence in others)
        alt = f"{OF_INSIGHT[name].label}: {OF_INSIGHT[name].title}"
        yield (
            f'<h2 id="{name}">{escape(part.question)}</h2>\n'
            f'<div class="answer"><p><strong>{first}</strong></p></div>\n<ul>{items}</ul>\n'
            f"<h3>{escape(part.caption.title)}</h3>\n"
            f'<div class="print">{figure_html(part.figure, alt, part.caption.text)}</div>\n'
        )
