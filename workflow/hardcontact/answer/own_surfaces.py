"""The page of own surfaces: which wavelengths decide how they stick, how strongly, how surely."""

import re
from collections.abc import Callable
from html import escape
from typing import Any, NamedTuple

import xarray as xr

from hardcontact.answer import fit_curve, force_curve, maps, psd, ratios
from hardcontact.answer.artificial import artificial_bands, artificial_words
from hardcontact.answer.canvas import png
from hardcontact.answer.datasets import Datasets, Setting, model_of
from hardcontact.answer.first_sentences import first_sentences, fit_sentences
from hardcontact.answer.html import figure_html, list_html, page, table_html, text_html
from hardcontact.answer.limits import grave_limits, limits
from hardcontact.answer.next_measurements import next_measurements
from hardcontact.answer.numbers import answer_numbers
from hardcontact.answer.part_text import EDGE_NAMES
from hardcontact.answer.quartiles import quartile_sentences
from hardcontact.answer.sentences import (
    band_sentences,
    force_sentences,
    pooled_sentence,
)
from hardcontact.answer.tables import measurement_table, roughness_table
from hardcontact.numbers.printing import print_length, print_quantity, print_share
from hardcontact.surfaces.synthesis import SIDES

SUBSTITUTES = "The scans are substitutes, synthesised from published statistics."
LIMITS = "What limits this answer"
FIRST_ANSWER = (
    "This is a first answer at quick effort, from few cutoffs and contacts: without "
    "--config effort=quick the same command gives the whole one."
)


class Answer(NamedTuple):
    """The answer of a study.

    Attributes
    ----------
    page : str
        HTML, for people.
    numbers : dict
        The same numbers, for machines, ready for JSON.
    """

    page: str
    numbers: dict[str, Any]


def answer(given: Datasets, setting: Setting) -> Answer:
    """Return the answer of a study of own surfaces.

    Parameters
    ----------
    given : Datasets
        Of the study.
    setting : Setting
        Of the study.

    Returns
    -------
    Answer
        The page and its numbers.
    """
    sections = {
        "The scans": _each(given, _map),
        "Roughness": roughness_table(given.topography, given.labels()),
        "The spectrum, and where it is reliable": _each(given, _spectrum)
        + measurement_table(given.spectra, given.labels()),
        "The force without parts of the roughness": _each(given, _ratios),
        "The band": _band(given),
        "The force": _force(given, setting),
        "Fit to your own forces (measured)": "" if given.fit is None else _fit(given.fit),
        LIMITS: _each_list(
            given,
            lambda of: limits(str(of.topography["basis"].item()), of.spectra, of.edges, of.force),
        ),
        "What would narrow it": _each_list(
            given, lambda of: next_measurements(of._replace(fit=given.fit))
        ),
        "What was left out": _left_out(setting),
    }
    body = _first_screen(given, setting.effort) + "".join(
        f'<section id="{_anchor(title)}"><h2>{escape(title)}</h2>\n{content}</section>\n'
        for title, content in sections.items()
        if content
    )
    return Answer(
        page(f"{setting.study}: which roughness decides how it sticks", body),
        answer_numbers(given, setting),
    )


def _anchor(title: str) -> str:
    """Return the name by which links find a section."""
    return "-".join(re.findall(r"[a-z]+", title.lower()))


def _each(given: Datasets, draw: Callable[[str, Datasets], str]) -> str:
    """Return a figure of each surface, side by side where the screen is wide."""
    figures = "\n".join(
        draw(label, given.of_surface(surface)) for surface, label in given.labels().items()
    )
    return f'<div class="figures">{figures}</div>'


def _paragraphs(given: Datasets, write: Callable[[str, Datasets], str]) -> str:
    """Return a paragraph for each surface."""
    return "\n".join(
        f"<p>{text_html(write(label, given.of_surface(surface)))}</p>"
        for surface, label in given.labels().items()
    )


def _first_screen(given: Datasets, effort: str) -> str:
    """Return the answer of each surface in a sentence, and what it means."""
    sentences = "\n".join(f"<p>{text_html(text)}</p>" for text in first_sentences(given).values())
    tolerance = print_share(given.edges.attrs["tolerance"])
    confidence = print_share(given.edges.attrs["confidence"])
    meaning = (
        "If all roughness of shorter wavelengths than these were removed, or all of longer ones, "
        f"the force would change by less than {tolerance}."
    )
    if (given.edges["edge_status"] != "found").any():
        meaning = (
            "A wavelength ends the band where the force changes by "
            f"{tolerance} if all roughness beyond it is removed. “At least” and “at most” mean "
            "that this end was not found within what was computed."
        )
    meaning += f" Brackets hold {confidence} intervals; a number without brackets has none."
    more = f'<a href="#{_anchor(LIMITS)}">{LIMITS}</a>.'
    spans = "".join(f"<p>{text_html(text)}</p>\n" for text in quartile_sentences(given))
    first = f"<p>{FIRST_ANSWER}</p>\n" if effort == "quick" else ""
    sentences = spans + sentences + first
    return (
        f'<div class="answer">{sentences}<p><small>{text_html(meaning)} {more}</small></p>'
        "</div>\n" + _notice(given)
    )


def _notice(given: Datasets) -> str:
    """Return which surfaces are substitutes, and the gravest limits of each answer."""
    basis = given.topography["basis"].values == "substitute"
    names = ", ".join(map(str, given.topography["label"].values[basis]))
    texts = [f"Not measured: {names}. {SUBSTITUTES}"] if names else []
    for surface, label in given.labels().items():
        of = given.of_surface(surface)
        texts += [f"{label}: {text}" for text in grave_limits(of.spectra, of.edges, of.force)]
    if not texts:
        return ""
    paragraphs = "".join(f"<p>{text_html(text)}</p>" for text in texts)
    return f'<div class="notice">{paragraphs}</div>\n'


def _map(label: str, of: Datasets) -> str:
    heights = maps.heights_shown(of.topography)
    size = print_length(of.topography["scan_size"].item())
    pixel = print_length(of.topography["pixel_size"].item())
    ends = f"{heights.min():.3g} to {heights.max():.3g} nm about the mean"
    return figure_html(
        png(maps.draw(of.topography)),
        f"Height map of {label}, {size} wide, heights from {ends}.",
        f"{label}: the first scan, levelled, {size} wide, pixels of {pixel}; heights from {ends}.",
    )


def _spectrum(label: str, of: Datasets) -> str:
    shaded = artificial_words(artificial_bands(of.spectra))
    if of.topography["basis"].item() == "substitute":
        return figure_html(
            png(psd.draw(of.spectra)),
            f"Power spectral density of {label} against wavelength; no source {shaded}.",
            f"{label}: the isotropic power spectral density that the scans are synthesised from. "
            "Colour: described from a source; points: the same in bins; line: the spectrum used. "
            f"Shaded: wavelengths at which the description has no source, {shaded}.",
        )
    return figure_html(
        png(psd.draw(of.spectra)),
        f"Power spectral density of {label} against wavelength; no scan is reliable {shaded}.",
        f"{label}: the isotropic power spectral density of each scan where it is reliable (colour) "
        "and where it is not (dotted), and their logarithmic average (points). The line is the "
        "spectrum of roughness that is added where the scans end. Shaded: wavelengths at which "
        f"no scan is reliable, {shaded}; roughness there is uncertain or artificial.",
    )


def _ratios(label: str, of: Datasets) -> str:
    rho = print_length(of.force.attrs["range_of_adhesion"])
    tolerance = print_share(of.edges.attrs["tolerance"])
    shortest, longest = (
        print_length(of.force["continued_end"].sel(side=side).item()) for side in SIDES
    )
    edges = "; ".join(
        f"{name}: {of.edges['edge_text'].sel(side=side).item()}"
        for side, name in EDGE_NAMES.items()
    )
    return figure_html(
        png(ratios.draw(of.edges, of.spectra)),
        f"Pull-off force of {label} with roughness below or above a cutoff removed. Edges of the "
        f"band: {edges}.",
        f"{label}: mean pull-off force with all roughness below (upper panel) or above (lower "
        f"panel) a cutoff removed, over that with all down to {shortest} (upper) or up to "
        f"{longest} (lower), where the computed surfaces end; at ρ = {rho}. Bars: intervals, not "
        f"bounded where they leave the panel. Grey band: a change of {tolerance} that counts as "
        "none. Shaded wavelengths: no scan is reliable, "
        f"{artificial_words(artificial_bands(of.spectra))}. Edges of the band: {edges}.",
    )


def _band(given: Datasets) -> str:
    """Return the band of each surface in words, and that of several together."""
    texts = _paragraphs(given, lambda label, of: band_sentences(label, of.edges))
    if "pooled_edge_text" in given.edges:
        texts += f"\n<p>{text_html(pooled_sentence(given.edges))}</p>"
    return texts


def _force(given: Datasets, setting: Setting) -> str:
    """Return the forces in words and as a curve, and what they were computed for."""
    force = given.force.assign(label=("surface", list(given.labels().values())))
    model, work = model_of(force), print_quantity(force.attrs["work_of_adhesion"], "J m-2")
    contact = "; ".join(
        f"{name}: {value}" + (" (as in the paper)" if name in setting.of_paper else "")
        for name, value in setting.contact.items()
    )
    names = " and ".join(given.labels().values())
    figure = figure_html(
        png(force_curve.draw(force)),
        f"Mean pull-off force of {names} against the range of adhesion, at a work of {work}.",
        f"Mean pull-off force against the range of adhesion, at a work of adhesion of {work}. "
        f"Bands: {print_share(force.attrs['confidence'])} intervals of the mean, {model} contact. "
        "Bars: single contacts at the range asked for. Plastic: the softer body yields where the "
        "bodies touch, until the area carries the preload; rigid: they touch at one point.",
    )
    return (
        _paragraphs(given, lambda label, of: force_sentences(label, of.force))
        + (f"<p><small>Computed for {text_html(contact)}.</small></p>\n" if contact else "")
        + f'<div class="figures">{figure}</div>'
    )


def _fit(fit: xr.Dataset) -> str:
    """Return the fit to the user's own forces, of the contact model of the answer."""
    of_model = fit_curve.of_answer(fit)
    text = fit_sentences(of_model)
    figure = figure_html(
        png(fit_curve.draw(of_model)),
        text,
        "Work of adhesion that gives the force measured on each surface, against the range, for "
        f"{of_model['contact_model'].item()} contact. Bands: "
        f"{print_share(fit.attrs['confidence'])} intervals, tests and scans resampled.",
    )
    return f'<p>{text_html(text)}</p>\n<div class="figures">{figure}</div>'


def _each_list(given: Datasets, write: Callable[[Datasets], list[str]]) -> str:
    """Return a list for each surface that has one."""
    lists = {label: write(given.of_surface(surface)) for surface, label in given.labels().items()}
    return "\n".join(
        f"<h3>{escape(label)}</h3>\n{list_html(items)}" for label, items in lists.items() if items
    )


def _left_out(setting: Setting) -> str:
    """Return what these data do not allow and why."""
    if not setting.left_out:
        return "<p>Nothing.</p>"
    return table_html(("part", "why"), setting.left_out)
