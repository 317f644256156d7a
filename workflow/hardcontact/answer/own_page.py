"""The page of own surfaces: which wavelengths decide how they stick, how strongly, how surely."""

from collections.abc import Mapping
from typing import Any

import xarray as xr

from hardcontact.answer import own_figures as figures
from hardcontact.answer.artificial import measurement_name, measurements, single
from hardcontact.answer.force_facts import of_answer
from hardcontact.answer.own_answer import OwnAnswer, OwnSurface
from hardcontact.answer.surface_facts import (
    contact_inputs,
    quartile_spans,
    scan_inputs,
    verdict,
)
from hardcontact.answer.templates import rendered

#: Texts of each measurement.
MEASUREMENT_TEXTS = ("kind", "limited_by", "notes")


def own_page(answer: OwnAnswer) -> str:
    """Return the page, HTML."""
    given, setting, surfaces = answer
    labels = {name: surface.label for name, surface in surfaces.items()}
    return rendered(
        "own.html",
        study=setting.study,
        effort=setting.effort,
        citation=setting.citation,
        left_out=setting.left_out,
        tolerance=float(given.edges.attrs["tolerance"]),
        confidence=float(given.edges.attrs["confidence"]),
        surfaces=[_shown(name, surface) for name, surface in surfaces.items()],
        pooled=answer.pooled,
        quartiles=quartile_spans(given),
        contact=contact_inputs(setting),
        forces=figures.svg(figures.force_figure(given.force, labels), "pull-off forces"),
        fit=answer.fit,
        works=None if given.fit is None else _works(given.fit, labels),
    )


def _works(fit: xr.Dataset, labels: Mapping[str, str]) -> dict[str, Any]:
    """Return the figure of works of adhesion that fit own forces, and its contact model."""
    of_model = of_answer(fit)
    svg = figures.svg(figures.work_figure(of_model, labels), "works of adhesion")
    return {"svg": svg, "model": str(of_model["contact_model"].item())}


def _shown(name: str, surface: OwnSurface) -> dict[str, Any]:
    """Return what the page shows of one surface."""
    of = surface.of
    heights = figures.heights_shown(of.topography)
    lengths = zip(single(measurements(of.spectra)), surface.scan_lengths, strict=True)
    return surface._asdict() | {
        "id": name,
        "basis": surface.basis,
        "verdict": verdict(surface.rows),
        "scans": scan_inputs(of.spectra),
        "heights": [float(heights.min()), float(heights.max())],
        "size": float(of.topography["scan_size"]),
        "pixel": float(of.topography["pixel_size"]),
        "map": figures.svg(figures.map_figure(of.topography), "height map"),
        "ratio": figures.svg(figures.ratio_figure(of.edges, of.spectra), "force ratios"),
        "spectrum": figures.svg(figures.spectrum_figure(of.spectra), "spectra"),
        "roughness": surface.roughness,
        "measurements": [
            {"name": measurement_name(measurement), "reliable": bool(measurement["reliable"].any())}
            | {text: str(measurement[text].item()) for text in MEASUREMENT_TEXTS}
            | numbers
            for measurement, numbers in lengths
        ],
    }
