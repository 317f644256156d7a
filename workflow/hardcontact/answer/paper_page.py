"""The page of the paper's study: question, answer, figures, verdicts, departures."""

from collections.abc import Iterator, Mapping
from html import escape
from itertools import groupby

import pandas as pd

from hardcontact.answer.captions import Caption
from hardcontact.answer.html import figure_html, page
from hardcontact.answer.paper_answer import PaperAnswer
from hardcontact.answer.paper_sentences import answer_sentences, basis_sentences
from hardcontact.claims.report_pages import chapter, counts_table, section_tables
from hardcontact.claims.verdicts import VERDICTS
from hardcontact.figures.catalogue import OF_PAPER

TITLE = "Which scales of roughness matter?"
PAPER = "https://doi.org/10.1007/s11340-021-00733-6"
#: What each chapter of figures is about.
STORY = {
    "1. Surfaces": "Everything begins with height maps of the coatings and of the sphere.",
    "2. Contact": "The sphere is pressed on. Do the bodies deform elastically, or does the sphere "
    "yield where it touches?",
    "3. Adhesion": "Across a gap the bodies attract each other. How strongly, and how far this "
    "reaches, follows from the forces measured on all coatings together.",
    "4. Classical models": "Older models predict the force from a few numbers such as the rms "
    "height.",
    "5. Asperities": "How many places of a surface carry the force, and how far apart are they?",
    "6. Scales": "All roughness below a short or above a long wavelength is removed. Where the "
    "force changes, that roughness matters.",
    "7. Robustness": "How far do these results hang on choices that had to be made?",
}
CONTENTS = (
    '<p><a href="#figures">Figures</a> · <a href="#verdicts">Verdicts</a> · '
    '<a href="#departures">Departures</a></p>\n'
)


def paper_page(
    answer: PaperAnswer,
    figures: Mapping[str, bytes],
    captions: Mapping[str, Caption],
    departures: str,
) -> str:
    """Write the page.

    Parameters
    ----------
    answer : PaperAnswer
        Of the study.
    figures : mapping of str to bytes
        PNG of each figure, by its name in the catalogue.
    captions : mapping of str to Caption
        Of the same figures.
    departures : str
        The chapter of that name in Markdown, as `report_pages.chapter` takes it.

    Returns
    -------
    str
        HTML.

    Raises
    ------
    ValueError
        If the departures do not begin with a title.
    """
    title, body = chapter(departures)
    lower = body.replace("<h2>", "<h3>").replace("</h2>", "</h3>")
    sections = (
        _opening(answer),
        CONTENTS,
        '<h2 id="figures">The figures</h2>\n<p>On a narrow screen they scroll sideways.</p>\n',
        *_chapters(figures, captions),
        '<h2 id="verdicts">The verdicts</h2>\n',
        *_verdicts(answer.claims),
        f'<h2 id="departures">{escape(title)}</h2>\n',
        lower,
    )
    return page(TITLE, "".join(sections))


def _opening(answer: PaperAnswer) -> str:
    """Return the question, the answer, and what it stands on."""
    *coatings, sphere = (escape(label) for label in answer.surfaces["label"])
    first, *others = map(escape, answer_sentences(answer))
    return (
        "<p>Hard bodies stick weakly because their roughness keeps them apart. Which wavelengths "
        "of the roughness decide how weakly? Thimons, Gujrati, Sanner, Pastewka and Jacobs "
        f'(<a href="{PAPER}">2021</a>) pulled a sphere of {sphere} off diamond coatings '
        f"({', '.join(coatings)}). Here their numbers are computed again.</p>\n"
        f'<div class="answer"><p><strong>{first}</strong> {" ".join(others)}</p></div>\n'
        f'<div class="notice"><p>{escape(" ".join(basis_sentences(answer)))}</p></div>\n'
    )


def _chapters(figures: Mapping[str, bytes], captions: Mapping[str, Caption]) -> Iterator[str]:
    """Yield the figures chapter by chapter, in the order of the catalogue."""
    shown = [(name, figure) for name, figure in OF_PAPER.items() if name in figures]
    for heading, members in groupby(shown, key=lambda pair: pair[1].chapter):
        yield f"<h3>{escape(heading)}</h3>\n<p>{escape(STORY[heading])}</p>\n"
        for name, figure in members:
            alt = f"{figure.label}: {figure.title}"
            picture = figure_html(figures[name], alt, captions[name].text)
            yield f'<h4>{escape(captions[name].title)}</h4>\n<div class="print">{picture}</div>\n'


def _verdicts(claims: pd.DataFrame) -> Iterator[str]:
    """Yield the counts of verdicts, then the claims of each section, folded."""
    yield (
        f"<p>{len(claims)} statements of the paper, each beside the number computed. Independent "
        "findings neither restate another statement nor hold by construction. <em>Holds in</em>: "
        "the share of many equally good sets of scans in which the statement holds.</p>\n"
    )
    yield counts_table(claims)
    for section, table in section_tables(claims).items():
        verdicts = list(claims["verdict"][claims["section"] == section])
        said = ", ".join(f"{verdicts.count(name)} {name}" for name in VERDICTS if name in verdicts)
        yield (
            f"<details><summary><strong>{escape(section)}</strong> ({escape(said)})</summary>\n"
            f"{table}</details>\n"
        )
