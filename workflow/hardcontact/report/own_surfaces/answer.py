"""The answer of a study of the user's surfaces: the content of its answer.json, and its page."""

from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from hardcontact.base.number import Number, numbers_by_name
from hardcontact.inference.octaves import strongest_octaves
from hardcontact.report.answer import (
    all_quantities,
    note,
    numbers_of_answer,
    render_page,
    substitutes_note,
)
from hardcontact.report.figures import panels
from hardcontact.report.own_surfaces.cautions import answer_cautions
from hardcontact.report.own_surfaces.comparison import comparison_numbers
from hardcontact.report.own_surfaces.conclusions import Conclusion, surface_conclusion
from hardcontact.report.own_surfaces.datasets import (
    MEASUREMENT_LENGTHS,
    Datasets,
    Setting,
    measurement_name,
    preferred_model,
    split_measurements,
    stored_tabor_number,
)
from hardcontact.report.own_surfaces.edges import NextScan, edge_numbers, next_scans
from hardcontact.report.own_surfaces.forces import (
    fit_numbers,
    force_numbers,
    measured_numbers,
    pair_numbers,
    preferred_fit,
)
from hardcontact.report.own_surfaces.reliable_wavelengths import NEARLY_ALL, shown_octaves
from hardcontact.report.own_surfaces.spectrum_cautions import Caution
from hardcontact.report.quantities import EDGE_NAMES, number_of, number_without_value
from hardcontact.report.templates import Frame, render_lines, render_text
from hardcontact.scans.both_bodies import sphere_share
from hardcontact.scans.reliable_band import LIMIT_NAMES, MIN_PIXELS, MIN_WAVES_IN_SIZE, OTHER_BODY
from hardcontact.surfaces.metrics import METRICS

#: Names of the range and the work of adhesion among the inputs of contacts.
RANGE = "range of adhesion"
WORK = "work of adhesion"
#: Metrics of a scan, of `METRICS`.
SHOWN_METRICS = (
    "rms_height", "rms_gradient", "rms_half_laplacian", "peak_to_valley", "skewness", "kurtosis",
)  # fmt: skip


class SurfaceAnswer(NamedTuple):
    """The answer of one surface."""

    name: str
    label: str
    source: str  #: measured or substitute.
    numbers: dict[str, Number]
    conclusion: Conclusion
    cautions: list[Caution]
    next_scans: list[NextScan]


def own_answer(datasets: Datasets, setting: Setting) -> dict[str, Any]:
    """Return the content of answer.json: a head, notes in words, and all numbers."""
    surfaces = surface_answers(datasets, setting)
    chosen_inputs = _chosen_inputs(datasets.force, setting)
    numbers = numbers_by_name(*_study_numbers(datasets, setting))
    fit_text = render_text("own_fit.txt", n=numbers) if "fit_range" in numbers else ""
    return {
        "study": setting.study,
        "version": setting.version,
        "effort": setting.effort,
        "kind": "own surfaces",
        "headline": render_lines(
            "own_headline.txt",
            surfaces=surfaces,
            chosen=chosen_inputs,
            effort=setting.effort,
            contact=setting.contact_words,
            assumed=setting.assumed,
            fit=fit_text if len(surfaces) > 1 else "",
        ),
        "verdicts": [],
        "contact": {**setting.contact_words, "contact model": preferred_model(datasets.force)},
        "changed": [],
        "assumed": list(setting.assumed),
        "chosen": chosen_inputs,
        "surfaces": [_surface_head(surface, datasets.spectra) for surface in surfaces],
        "notes": _notes(surfaces, numbers, fit_text),
        "quantities": all_quantities(
            numbers.values(), {surface.name: surface.numbers.values() for surface in surfaces}
        ),
    }


def _chosen_inputs(force: xr.Dataset, setting: Setting) -> list[str]:
    """Return RANGE if the range of adhesion is the shortest that the scans permit."""
    ranges = force["rho"].values
    is_shortest = len(ranges) > 1 and np.isclose(force.attrs["rho"], ranges.min())
    return [RANGE] if is_shortest and RANGE not in setting.assumed else []


def surface_answers(datasets: Datasets, setting: Setting) -> list[SurfaceAnswer]:
    """Return the answer of each surface that has a band."""
    labels = datasets.labels()
    reference = datasets.select_surface(next(iter(labels)))
    return [
        _surface_answer(name, label, datasets.select_surface(name), reference, setting)
        for name, label in labels.items()
    ]


def _surface_answer(
    name: str, label: str, data: Datasets, reference: Datasets, setting: Setting
) -> SurfaceAnswer:
    """Return the answer of one surface; the reference is the first surface."""
    numbers = [*_octave_numbers(data), *edge_numbers(data), *force_numbers(data)]
    if data.force["surface"].item() != reference.force["surface"].item():
        numbers += comparison_numbers(data, reference)
    # A user who gave measured forces, or both range and work of adhesion, has a pair.
    if data.fit is None and {RANGE, WORK} & set(setting.assumed):
        numbers += pair_numbers(data.force, setting.pairs)
    if data.fit is not None and name in data.fit["surface"].values:
        numbers += measured_numbers(preferred_fit(data.fit).sel(surface=name), data)
    named_numbers = numbers_by_name(*numbers)
    conclusion = surface_conclusion(named_numbers)
    surface_cautions = answer_cautions(data, named_numbers)
    new_scans = next_scans([named_numbers[name] for name in EDGE_NAMES.values()], data.spectra)
    named_numbers |= numbers_by_name(
        *_caution_numbers(surface_cautions),
        *(scan.limit._replace(name=f"{scan.edge}_{scan.code}_limit") for scan in new_scans),
        *_topography_numbers(data.topography),
        *_measurement_numbers(data.spectra),
    )
    return SurfaceAnswer(
        name=name,
        label=label,
        source=str(data.topography["source"].item()),
        numbers=named_numbers,
        conclusion=conclusion,
        cautions=surface_cautions,
        next_scans=new_scans,
    )


def _octave_numbers(data: Datasets) -> Iterator[Number]:
    """Yield the strongest octaves of one surface, and the sphere's share of the power of each."""
    for number in strongest_octaves(data.sensitivity.isel(octave=shown_octaves(data))):
        yield number
        if number.unit == "nm" and "sphere_share" in data.spectra:
            share = sphere_share(data.spectra, np.sqrt(2) * number.value)
            yield Number(f"{number.name}_sphere_share", share)


def _study_numbers(datasets: Datasets, setting: Setting) -> list[Number]:
    """Return the numbers of the whole study: settings and, with measured forces, the fit."""
    force, edges = datasets.force.attrs, datasets.edges.attrs
    sources = {name: "assumed" if name in setting.assumed else "given" for name in (RANGE, WORK)}
    return [
        Number("range_of_adhesion", force["rho"], "nm", source=sources[RANGE]),
        Number("work_of_adhesion", force["work_of_adhesion"], "J m-2", source=sources[WORK]),
        Number("tolerance", edges["tolerance"], source="given"),
        Number("confidence", edges["confidence"], source="given"),
        stored_tabor_number(datasets.force),
        *([] if datasets.fit is None else fit_numbers(preferred_fit(datasets.fit))),
    ]


def _notes(
    surfaces: list[SurfaceAnswer], numbers: Mapping[str, Number], fit_text: str
) -> list[dict[str, Any]]:
    """Return the notes in words: cautions, measurements to make next, the fit."""
    notes = substitutes_note(
        [surface.label for surface in surfaces if surface.source != "measured"]
    )
    several = len(surfaces) > 1
    for surface in surfaces:
        facts = {"label": surface.label, "several": several}
        for caution in surface.cautions:
            text = render_text("own_caution.txt", caution=caution, **facts)
            notes.append(note("caution", text, caution.code, surface.name, grave=caution.grave))
        limits = {"min_pixels": MIN_PIXELS, "min_waves": MIN_WAVES_IN_SIZE}
        for measurement in surface.next_scans:
            text = render_text("own_next.txt", measurement=measurement, **facts, **limits)
            notes.append(note("next", text, measurement.code, surface.name))
    if fit_text:
        notes.append(note("fit", fit_text, numbers["fit_region_range"].status))
    return notes


def _caution_numbers(surface_cautions: list[Caution]) -> Iterator[Number]:
    """Yield the numbers of cautions, named after the code or, for a defect, the measurement."""
    for caution in surface_cautions:
        prefix = f"measurement_{caution.measurement}" if caution.measurement else caution.code
        for number in caution.numbers.values():
            yield number._replace(name=f"{prefix}_{number.name}")


def _topography_numbers(topography: xr.Dataset) -> Iterator[Number]:
    """Yield the sizes, heights and roughness of the scans of one surface, and of all scales."""
    for name in ("scan_size", "pixel_size"):
        yield number_of(topography, name, "nm", source="file")
    heights = panels.mean_free_heights(topography["example_heights"])
    yield number_without_value("heights", float(heights.min()), float(heights.max()), "nm")
    scans = topography.dropna("scan", subset=["rms_height"])
    for index in range(scans.sizes["scan"]):
        for name in SHOWN_METRICS:
            number = number_of(scans.isel(scan=index), name, METRICS[name][0])
            yield number._replace(name=f"scan_{index + 1}_{name}")
    for name in SHOWN_METRICS:
        if f"all_scales_{name}" in topography:
            yield number_of(topography, f"all_scales_{name}", METRICS[name][0])


def _measurement_numbers(spectra: xr.Dataset) -> Iterator[Number]:
    """Yield the lengths of each measurement of one surface: size, pixels, reliable band, tip."""
    for index, measurement in enumerate(split_measurements(spectra), start=1):
        for name in MEASUREMENT_LENGTHS:
            number = number_of(measurement, name, "nm", source="file")
            yield number._replace(name=f"measurement_{index}_{name}")


def _limit_name(scan: xr.Dataset) -> str:
    """Return what limits the shortest reliable wavelengths; an empty text if none is reliable."""
    limit = str(scan["limited_by"].item())
    return limit if scan["reliable"].any() or limit == OTHER_BODY else ""


def _surface_head(surface: SurfaceAnswer, spectra: xr.Dataset) -> dict[str, Any]:
    """Return the head of one surface in answer.json: its name, conclusion and measurements."""
    scans = split_measurements(spectra.sel(surface=surface.name))
    return {
        "name": surface.name,
        "label": surface.label,
        "source": surface.source,
        "answered": surface.conclusion.answer,
        "measurements": [
            {
                "name": measurement_name(scan),
                "kind": str(scan["kind"].item()),
                "limited_by": _limit_name(scan),
                "notes": str(scan["notes"].item()).replace("\n", "; "),
            }
            for scan in scans
        ],
    }


def own_page(
    answer: Mapping[str, Any],
    figures: Mapping[str, bytes],
    citation: Mapping[str, Any],
    frame: Frame,
) -> str:
    """Return the page of a study of the user's surfaces; the SVG of figures is by name."""
    limits = {"limit_names": LIMIT_NAMES, "min_pixels": MIN_PIXELS, "min_waves": MIN_WAVES_IN_SIZE}
    conclusions = {
        surface["name"]: surface_conclusion(numbers_of_answer(answer, surface["name"]))
        for surface in answer["surfaces"]
    }
    facts = limits | {"nearly_all": NEARLY_ALL, "conclusions": conclusions}
    return render_page(answer, figures, citation, frame, **facts)
