"""The answer of the paper's study in sentences of plain text, each with its numbers."""

import math
from typing import Any

import numpy as np

from hardcontact.answer.paper_answer import EDGES, PaperAnswer
from hardcontact.answer.scan_size_sentences import force_on_scans_sentence
from hardcontact.claims.verdicts import VERDICTS, summary
from hardcontact.numbers.printing import print_as_paper

DIGITS = 2  # of computed numbers: their intervals are wider than what more digits would say


def answer_sentences(answer: PaperAnswer) -> list[str]:
    """Return the answer, the most important first.

    A sentence whose numbers the study does not have is left out.
    """
    said = (of(answer) for of in (_band, _meaning, _fit, _errors, _verdicts))
    return [sentence for sentence in said if sentence]


def basis_sentences(answer: PaperAnswer) -> list[str]:
    """Return what the numbers stand on: substitutes, scans, grids, intervals."""
    return [_substitutes(answer), _scans(answer), _grids(answer), _intervals(answer)]


def _band(answer: PaperAnswer) -> str:
    edges = ("shortest_wavelength", "longest_wavelength")
    if not answer.numbers.keys() >= set(edges):
        return ""
    computed, printed = ([of(answer, name) for name in edges] for of in (_computed, _printed))
    return (
        f"The wavelengths that decide lie between {' and '.join(computed)} "
        f"(paper: {' and '.join(printed)})."
    )


def _meaning(answer: PaperAnswer) -> str:
    if not _band(answer):
        return ""
    return (
        "With all roughness below this band removed, or all above it, the change of the mean "
        "pull-off force, averaged over all coatings, stays below "
        f"{100 * answer.settings['tolerance']:g} %, at a range of adhesion of "
        f"{print_as_paper(answer.settings['rho'], 'nm')}; edges of single coatings run "
        f"{' and '.join(_span(answer, name) for name in EDGES)}."
    )


def _span(answer: PaperAnswer, name: str) -> str:
    """Return from where to where an edge runs over coatings; an open one stands by its bound."""
    known, bound = answer.edges[name], EDGES[name][1]
    sizes = known.fillna(answer.last_cutoffs[name]).sort_values()
    shortest, longest = (
        f"{'' if np.isfinite(known[label]) else f'{bound} '}"
        f"{print_as_paper(sizes[label], 'nm', digits=DIGITS)} ({label})"
        for label in (sizes.index[0], sizes.index[-1])
    )
    return f"from {shortest} to {longest}"


def _fit(answer: PaperAnswer) -> str:
    pair = ("range_of_adhesion", "work_of_adhesion")
    if not answer.numbers.keys() >= set(pair):
        return ""
    # An interval over two groups of sets would hold numbers that hardly any of them has.
    two = len(answer.fit_groups) > 1
    reach, work = (_alone(answer, name) if two else _computed(answer, name) for name in pair)
    printed = " and ".join(_printed(answer, name) for name in pair)
    return (
        f"The measured mean forces are fitted best by a range of adhesion of {reach} and a work of "
        f"adhesion of {work} (paper: {printed}){_groups(answer) if two else _share(answer)}."
    )


def _share(answer: PaperAnswer) -> str:
    """Return in how many of the sets the range exceeds the number that the paper names."""
    row = answer.numbers.get("range_exceeds")
    if row is None or math.isnan(row.frequency):
        return ""
    return (
        f"; the range exceeds {_printed(answer, 'range_exceeds')} in {100 * row.frequency:.0f} % "
        f"of {answer.settings['sets']} equally good sets of scans"
    )


def _groups(answer: PaperAnswer) -> str:
    """Return the fits of the sets above and below that number, and the gap between them."""
    long, short = (answer.fit_groups[exceeds] for exceeds in (True, False))
    of_long, of_short = (
        f"{_middle(group['range_of_adhesion'], 'nm')} with "
        f"{_middle(group['work_of_adhesion'], 'J/m2')}"
        for group in (long, short)
    )
    gap = " and ".join(
        print_as_paper(end, "nm", digits=DIGITS)
        for end in (short["range_of_adhesion"]["max"], long["range_of_adhesion"]["min"])
    )
    return (
        f"{_share(answer)}. In these it is {of_long}, in the others {of_short} (medians, and in "
        f"brackets all sets of a group); no set has a range between {gap}"
    )


def _middle(fits: dict[str, float], unit: str) -> str:
    """Return the median of a group with its least and greatest number."""
    return print_as_paper(fits["median"], unit, (fits["min"], fits["max"]), DIGITS)


def _errors(answer: PaperAnswer) -> str:
    if "fit_error" not in answer.numbers:
        return ""
    rigid = ""
    if "rigid_over_plastic_error" in answer.numbers:
        ratio = _computed(answer, "rigid_over_plastic_error")
        rigid = f"; with rigid contact it is {ratio} times that"
    return (
        "The mean relative error of the best fit, with plastic contact, is "
        f"{_computed(answer, 'fit_error')} (paper: below {_printed(answer, 'fit_error')}){rigid}."
    )


def _verdicts(answer: PaperAnswer) -> str:
    counts = summary(answer.claims).set_index("verdict")["independent"]
    reached = [f"{counts[name]} {name}" for name in VERDICTS if counts[name]]
    return f"Of {counts.sum()} independent findings of the paper: {', '.join(reached)}."


def _substitutes(answer: PaperAnswer) -> str:
    labels = answer.surfaces["label"][answer.surfaces["basis"] == "substitute"]
    if labels.empty:
        return "All surfaces are measured."
    return (
        f"Substitute surfaces: {', '.join(labels)}. No scan of them is at hand, so they are "
        "synthesised from published statistics. Forces on them also differ from the paper's "
        "because they are other surfaces."
    )


def _scans(answer: PaperAnswer) -> str:
    return (
        f"{force_on_scans_sentence(answer.scan_size)} Range and work of adhesion, ratios of forces "
        "and the error of the fit rest on forces on such scans, as in the paper, and none is "
        "corrected."
    )


def _grids(answer: PaperAnswer) -> str:
    settings, printed = answer.settings, answer.printed
    coarser = any(settings[name] < printed[name] for name in ("scan_pixels", "contacts_per_side"))
    return (
        f"Scans of {_grid(settings)} of each pair, {settings['realizations']:g} realizations of "
        "each surface with all scales."
        + f" The paper has {_grid(printed)}: on coarser grids numbers and verdicts say little "
        "about the paper." * coarser
    )


def _grid(sizes: dict[str, float]) -> str:
    pixels, contacts = sizes["scan_pixels"], sizes["contacts_per_side"]
    return (
        f"{pixels:g} x {pixels:g} pixels over {print_as_paper(sizes['scan_size'], 'nm')}, "
        f"{contacts:g} x {contacts:g} contacts"
    )


def _intervals(answer: PaperAnswer) -> str:
    share = f"{100 * answer.settings['confidence']:g} %"
    return (
        f"In brackets: the middle {share} of {answer.settings['sets']} equally good sets of scans, "
        "which differ as other surfaces of the same statistics would, wider where the number of "
        "the study's own scans lies outside; where the sets give none, "
        f"the {share} interval of the mean over scans or realizations. Figures of the study's own "
        f"scans show the {share} interval of their mean, which is another one: it says how well "
        "these scans are known, not how much others may differ."
    )


def _alone(answer: PaperAnswer, name: str) -> str:
    """Return a computed number without its interval."""
    row: Any = answer.numbers[name]
    return print_as_paper(row.computed, row.unit, digits=DIGITS)


def _computed(answer: PaperAnswer, name: str) -> str:
    """Return a computed number with its interval, or with the bound that it is."""
    row: Any = answer.numbers[name]
    if name in answer.open_edges:
        return f"{answer.open_edges[name]} {_alone(answer, name)}"
    computed = print_as_paper(row.computed, row.unit, (row.low, row.high), DIGITS)
    if row.open_end:
        return f"{computed} (interval open: its {row.open_end} end is the last cutoff)"
    return computed


def _printed(answer: PaperAnswer, name: str) -> str:
    row: Any = answer.numbers[name]
    return print_as_paper(row.published, row.unit)
