"""The page of own surfaces: which wavelengths decide how they stick, how strongly, how surely."""

from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr

from hardcontact.answer import curves, pictures
from hardcontact.answer.artificial import LENGTHS, measurement_name, measurements, single
from hardcontact.answer.facts import number_of
from hardcontact.answer.force_facts import fit_facts, of_answer
from hardcontact.answer.limits import grave_limits
from hardcontact.answer.own_answer import MEASUREMENT_TEXTS, METRICS, OwnAnswer, OwnSurface
from hardcontact.answer.surface_facts import (
    contact_inputs,
    pooled_rows,
    quartile_spans,
    scan_inputs,
    verdict,
)
from hardcontact.answer.templates import rendered


def own_page(answer: OwnAnswer) -> str:
    """Return the page, HTML."""
    given, setting, surfaces = answer
    labels = {name: one.label for name, one in surfaces.items()}
    return rendered(
        "own.html",
        study=setting.study,
        effort=setting.effort,
        citation=setting.citation,
        left_out=setting.left_out,
        tolerance=float(given.edges.attrs["tolerance"]),
        confidence=float(given.edges.attrs["confidence"]),
        surfaces=[_shown(name, one) for name, one in surfaces.items()],
        pooled=pooled_rows(given.edges, [one.rows for one in surfaces.values()]),
        quartiles=quartile_spans(given),
        contact=contact_inputs(setting),
        forces=_drawn(curves.force_curve(given.force, labels)),
        fit=None if given.fit is None else _shown_fit(given.fit, labels),
    )


def _drawn(curve: curves.Curve) -> dict[str, Any]:
    """Return a curve with its picture."""
    return {"data": curve, "png": pictures.png(pictures.curve_figure(curve))}


def _shown_fit(fit: xr.Dataset, labels: Mapping[str, str]) -> dict[str, Any]:
    """Return what the user's own forces allow, and their curves, by the model of the answer."""
    of_model = of_answer(fit)
    facts = fit_facts(of_model) | {"model": str(of_model["contact_model"].item())}
    return facts | {"work": _drawn(curves.work_curve(of_model, labels))}


def _shown(name: str, surface: OwnSurface) -> dict[str, Any]:
    """Return what the page tells of one surface."""
    of = surface.of
    heights = pictures.heights_shown(of.topography)
    return surface._asdict() | {
        "id": name,
        "basis": surface.basis,
        "verdict": verdict(surface.rows),
        "grave": grave_limits(of),
        "scans": scan_inputs(of.spectra),
        "size": number_of(of.topography, "scan_size", "nm", source="file"),
        "pixel": number_of(of.topography, "pixel_size", "nm", source="file"),
        "heights": [float(heights.min()), float(heights.max())],
        "map": pictures.png(pictures.map_figure(of.topography)),
        "ratio": _drawn(curves.ratio_curve(of.edges, of.spectra)),
        "spectrum": _drawn(curves.spectrum_curve(of.spectra)),
        "roughness": _roughness(surface),
        "measurements": [_measurement(one) for one in single(measurements(of.spectra))],
    }


def _roughness(surface: OwnSurface) -> list[dict[str, Any]]:
    """Return the metrics of each scan, and over all scales those of the joined spectrum."""
    rows = [
        {"scan": int(scan["scan"])} | {name: scan[name].item() for name in METRICS}
        for scan in surface.scans
    ]
    joined = {name: surface.of.topography.get(f"all_scales_{name}", np.nan) for name in METRICS}
    return [*rows, {"scan": None} | {name: float(value) for name, value in joined.items()}]


def _measurement(one: xr.Dataset) -> dict[str, Any]:
    """Return texts, size and reliable wavelengths of a measurement."""
    return (
        {"name": measurement_name(one), "reliable": bool((one["reliable"] == 1).any())}
        | {name: number_of(one, name, "nm", source="file") for name in LENGTHS}
        | {name: str(one[name].item()) for name in MEASUREMENT_TEXTS}
    )
