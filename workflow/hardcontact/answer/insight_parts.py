"""The parts of the chapter on what decides the band: a question each, and what answers it.

A new part takes a figure in `catalogue.OF_INSIGHT`, with its module and caption, the rule that
makes the dataset of that figure, and an entry here.
"""

from collections.abc import Callable
from typing import NamedTuple

from hardcontact.answer.band_clauses import (
    clause_of_closed_form,
    clause_of_elastic_limit,
    clause_of_laws,
    clause_of_maps,
    clause_of_repeated_contact,
    clause_of_scaling,
    clause_of_scan_size,
)
from hardcontact.answer.closed_form_sentences import closed_form_sentences
from hardcontact.answer.elastic_limit_sentences import elastic_limit_sentences
from hardcontact.answer.law_sentences import law_sentences
from hardcontact.answer.map_sentences import map_sentences
from hardcontact.answer.repeated_contact_sentences import repeated_contact_sentences
from hardcontact.answer.scaling_sentences import scaling_sentences
from hardcontact.answer.scan_size_sentences import scan_size_sentences

__all__ = ["PARTS", "Part"]


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
