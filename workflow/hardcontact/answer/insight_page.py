"""The page on what decides the band: a question, its answer and a figure for each part.

A new part takes a figure in `catalogue.OF_INSIGHT`, with its module and caption, the rule that
makes the dataset of that figure, and an entry in `PARTS`.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from html import escape
from typing import NamedTuple

import pandas as pd
import xarray as xr

from hardcontact.answer.band_clauses import (
    clause_of_closed_form,
    clause_of_elastic_limit,
    clause_of_laws,
    clause_of_maps,
    clause_of_repeated_contact,
    clause_of_scaling,
    clause_of_scan_size,
)
from hardcontact.answer.captions import Caption
from hardcontact.answer.contact_sentences import (
    elastic_limit_sentences,
    map_sentences,
    repeated_contact_sentences,
)
from hardcontact.answer.html import figure_html, page, text_html
from hardcontact.answer.law_sentences import closed_form_sentences, law_sentences
from hardcontact.answer.part_text import listed
from hardcontact.answer.scaling_sentences import scaling_sentences
from hardcontact.answer.scan_size_sentences import scan_size_sentences
from hardcontact.figures.catalogue import OF_INSIGHT
from hardcontact.numbers.printing import print_as_paper, print_bounded_as_paper, print_percent
from hardcontact.scales.critical_band import POOLED
from hardcontact.surfaces.synthesis import SIDES


class Part(NamedTuple):
    """One part of the chapter.

    Attributes
    ----------
    question : str
        Its heading.
    sentences : callable
        Takes the dataset of the figure, then those of `beside`, and returns the answer in
        sentences, the first of which says most.
    of_band : callable
        Takes the same and returns one sentence, what the answer means for the critical band.
    beside : tuple of str
        Names of other final datasets of the study that both take.
    """

    question: str
    sentences: Callable[..., list[str]]
    of_band: Callable[..., str]
    beside: tuple[str, ...] = ()


#: The parts by their figures.
PARTS = {
    "fig_scaling": Part(
        "Do the edges belong to the surface, the attraction or the sphere?",
        scaling_sentences,
        clause_of_scaling,
    ),
    "fig_scan_size": Part("How large must a scan be?", scan_size_sentences, clause_of_scan_size),
    "fig_closed_form": Part(
        "Does the force follow from a spectrum, without a simulation?",
        closed_form_sentences,
        clause_of_closed_form,
        ("band",),
    ),
    "fig_laws": Part(
        "Would another law of attraction give similar results?", law_sentences, clause_of_laws
    ),
    "fig_maps": Part(
        "How many contacts and scans does a mean force need?", map_sentences, clause_of_maps
    ),
    "fig_repeated_contact": Part(
        "Do contacts at one place change the force, and are they the indents of the image?",
        repeated_contact_sentences,
        clause_of_repeated_contact,
    ),
    "fig_elastic_limit": Part(
        "Do all contacts yield, as the bearing area says?",
        elastic_limit_sentences,
        clause_of_elastic_limit,
    ),
}


TITLE = "What decides the band?"


class AnsweredPart(NamedTuple):
    """What the page shows of a part.

    Attributes
    ----------
    question : str
        Its heading.
    sentences : sequence of str
        Its answer, the first of which says most.
    of_band : str
        What the answer means for the critical band.
    figure : bytes
        PNG.
    caption : Caption
        Of the figure.
    """

    question: str
    sentences: Sequence[str]
    of_band: str
    figure: bytes
    caption: Caption


def insight_page(
    parts: Mapping[str, AnsweredPart],
    substitutes: Sequence[str],
    confidence: float,
    constants: pd.DataFrame,
    band: xr.Dataset,
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
    band : xarray.Dataset
        Computed edges, as from `critical_band.critical_band`, with `label(surface)`.

    Returns
    -------
    str
        HTML.
    """
    opening = _opening(substitutes, confidence, constants, band)
    sections = (opening, _contents(parts), *_parts(parts))
    return page(TITLE, "".join(sections))


def _opening(
    substitutes: Sequence[str], confidence: float, constants: pd.DataFrame, band: xr.Dataset
) -> str:
    """Return the band, computed and published, what is asked, and what the answers stand on."""
    short, long, reach = (
        print_as_paper(constants["value"][name], "nm")
        for name in ("critical_wavelength_small", "critical_wavelength_large", "range_of_adhesion")
    )
    each = "; ".join(
        f"{label} {_edges(band, surface)}"
        for surface, label in zip(band["surface"].values, band["label"].values, strict=True)
    )
    question = (
        "Which wavelengths of the roughness decide how weakly hard bodies stick? Computed here, in "
        f"the mean of all substrates, those from {_edges(band, POOLED)}; of each, {each}. The "
        f"paper finds those from {short} to {long}, at a range of adhesion of {reach}. Do these "
        "numbers belong to the surface, to the attraction or to the sphere? And how far can the "
        "method be trusted? Each part below asks one question, answers it in numbers and shows "
        "the figure that they are read from; what it says of the band stands behind its question "
        f"here. Brackets: intervals of {print_percent(confidence)}."
    )
    basis = "All surfaces are measured."
    if substitutes:
        basis = (
            f"Substitute surfaces: {listed(substitutes)}. No scan of them is at hand, so they are "
            "synthesised from published statistics: what follows holds for random surfaces with "
            "these spectra."
        )
    return f'<p>{text_html(question)}</p>\n<div class="notice"><p>{text_html(basis)}</p></div>\n'


def _edges(band: xr.Dataset, group: str) -> str:
    """Return both edges of a group with their intervals."""
    short, long = (
        print_bounded_as_paper(band.sel(side=side, group=group), "critical_wavelength", "nm", 3)
        for side in SIDES
    )
    return f"{short} to {long}".replace("no number", "no edge")


def _contents(parts: Mapping[str, AnsweredPart]) -> str:
    """Return links to the parts, by their questions, and what they mean for the band."""
    links = (
        f'<li><a href="#{name}">{escape(part.question)}</a> {text_html(part.of_band)}</li>'
        for name, part in parts.items()
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
            f"<p><em>For the band.</em> {text_html(part.of_band)}</p>\n"
            f"<h3>{escape(part.caption.title)}</h3>\n"
            f'<div class="print">{figure_html(part.figure, alt, part.caption.text)}</div>\n'
        )
