"""The page of own surfaces: which wavelengths decide how they stick, how strongly, how surely."""

from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr

from hardcontact.answer import curves, pictures
from hardcontact.answer.artificial import LENGTHS, measurement_name, measurements, single
from hardcontact.answer.datasets import Datasets, Setting
from hardcontact.answer.facts import fact_of, known
from hardcontact.answer.limits import grave_limits, limits
from hardcontact.answer.next_measurements import next_measurements
from hardcontact.answer.quartiles import quartile_spans
from hardcontact.answer.surface_facts import (
    answer_rows,
    contact_inputs,
    fit_facts,
    of_answer,
    pooled_rows,
    scan_inputs,
    verdict,
)
from hardcontact.answer.templates import rendered

#: Numbers of a scan that the page shows.
METRICS = ("rms_height", "rms_gradient", "rms_half_laplacian", "peak_to_valley", "skewness")


def own_page(given: Datasets, setting: Setting) -> str:
    """Return the page of a study of own surfaces, HTML."""
    labels, effort = given.labels(), setting.effort
    surfaces = [
        _of_surface(name, label, given.of_surface(name)._replace(fit=given.fit))
        for name, label in labels.items()
    ]
    return rendered(
        "own.html",
        study=setting.study,
        effort=effort,
        citation=setting.citation,
        left_out=setting.left_out,
        tolerance=float(given.edges.attrs["tolerance"]),
        confidence=float(given.edges.attrs["confidence"]),
        surfaces=surfaces,
        pooled=pooled_rows(given.edges),
        quartiles=quartile_spans(given),
        contact=contact_inputs(setting),
        forces=_drawn(curves.force_curve(given.force, labels)),
        fit=None if given.fit is None else _fit(given.fit, labels),
    )


def _drawn(curve: curves.Curve) -> dict[str, Any]:
    """Return a curve with its picture."""
    return {"data": curve, "png": pictures.png(pictures.curve_figure(curve))}


def _fit(fit: xr.Dataset, labels: Mapping[str, str]) -> dict[str, Any]:
    """Return what the user's own forces allow, and their curves, by the model of the answer."""
    of_model = of_answer(fit)
    facts = fit_facts(of_model) | {"model": str(of_model["contact_model"].item())}
    return facts | {"work": _drawn(curves.work_curve(of_model, labels))}


def _of_surface(name: str, label: str, of: Datasets) -> dict[str, Any]:
    """Return what the page tells of one surface."""
    heights = pictures.heights_shown(of.topography)
    rows = answer_rows(label, of, of.fit)
    return {
        "id": name,
        "label": label,
        "basis": str(of.topography["basis"].item()),
        "verdict": verdict(rows),
        "rows": rows,
        "grave": grave_limits(of),
        "limits": limits(of),
        "next": next_measurements(of),
        "scans": scan_inputs(label, of.spectra),
        "size": fact_of(of.topography, "scan_size", "scan_size", "file", "nm"),
        "pixel": fact_of(of.topography, "pixel_size", "pixel_size", "file", "nm"),
        "heights": [float(heights.min()), float(heights.max())],
        "map": pictures.png(pictures.map_figure(of.topography)),
        "ratio": _drawn(curves.ratio_curve(of.edges, of.spectra)),
        "spectrum": _drawn(curves.spectrum_curve(of.spectra)),
        "roughness": _roughness(of.topography),
        "measurements": [_measurement(one) for one in single(measurements(of.spectra))],
    }


def _roughness(topography: xr.Dataset) -> list[dict[str, Any]]:
    """Return the rms numbers of each scan, and over all scales those of the joined spectrum."""
    scans = topography["scan"].values[np.isfinite(topography["rms_height"].values)]
    rows = [
        {"scan": int(scan)}
        | {name: known(topography[name].sel(scan=scan).item()) for name in METRICS}
        for scan in scans
    ]
    joined = {
        name: known(topography[f"all_scales_{name}"].item())
        for name in METRICS
        if f"all_scales_{name}" in topography
    }
    return [*rows, {"scan": None} | dict.fromkeys(METRICS) | joined]


def _measurement(one: xr.Dataset) -> dict[str, Any]:
    """Return size, reliable wavelengths and their reasons of a measurement."""
    texts = ("kind", "shortest_reason", "longest_reason", "notes")
    return (
        {"name": measurement_name(one), "reliable": bool((one["reliable"] == 1).any())}
        | {name: fact_of(one, name, name, "file", "nm") for name in LENGTHS}
        | {name: str(one[name].item()) for name in texts}
    )
