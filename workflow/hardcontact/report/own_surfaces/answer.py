"""The answer of a study of your surfaces: the content of its answer.json, and its page."""

from collections.abc import Iterator
from itertools import groupby
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from hardcontact.base.number import Number, NumberSource, numbers_by_name
from hardcontact.inference.octaves import strongest_octaves
from hardcontact.report.figures import panels
from hardcontact.report.own_surfaces import edges, forces
from hardcontact.report.own_surfaces.cautions import Caution, answer_cautions
from hardcontact.report.own_surfaces.datasets import (
    MEASUREMENT_LENGTHS,
    Datasets,
    Setting,
    measurement_name,
    octave_sphere_share,
    preferred_model,
    select_preferred_model,
    shown_octaves,
    split_measurements,
    stored_tabor_number,
)
from hardcontact.report.own_surfaces.headline import surface_facts
from hardcontact.report.quantities import all_quantities, number_of, number_without_value
from hardcontact.report.templates import render_note, render_paragraphs, substitutes_note
from hardcontact.scans import reliable_wavelengths
from hardcontact.surfaces.metrics import METRICS

RANGE_NAME = "range of adhesion"
WORK_NAME = "work of adhesion"
#: Limits, and their names, that templates show.
LIMITS = {
    "min_pixels": reliable_wavelengths.MIN_PIXELS,
    "min_waves": reliable_wavelengths.MIN_WAVES_IN_SIZE,
    "nearly_all": edges.NEARLY_ALL,
    "limit_names": reliable_wavelengths.LIMIT_NAMES,
}
SHOWN_METRICS = (
    "rms_height", "rms_gradient", "rms_half_laplacian", "peak_to_valley", "skewness", "kurtosis",
)  # fmt: skip


class SurfaceAnswer(NamedTuple):
    """The answer of one surface."""

    name: str
    label: str
    source: str  #: measured or substitute.
    numbers: dict[str, Number]
    conclusion: edges.Conclusion
    cautions: list[Caution]
    next_scans: list[edges.NextScan]


def own_answer(datasets: Datasets, setting: Setting) -> dict[str, Any]:
    """Return the content of answer.json: a head, notes in words, and all numbers."""
    surfaces = surface_answers(datasets, setting)
    chosen_inputs = _chosen_inputs(datasets.force, setting)
    numbers = numbers_by_name(*_study_numbers(datasets, setting))
    fit_notes = []
    if "fit_range" in numbers:
        code = numbers["fit_region_range"].status
        fit_notes.append(render_note("own_fit.txt", "fit", code, n=numbers))
    return {
        "study": setting.study,
        "version": setting.version,
        "effort": setting.effort,
        "kind": "own surfaces",
        "headline": render_paragraphs(
            "own_headline.txt",
            surfaces=surfaces,
            surface_facts={
                surface.name: surface_facts(
                    surface.numbers,
                    surface.cautions,
                    surface.conclusion.band_status,
                    surface.source,
                )
                for surface in surfaces
            },
            chosen=chosen_inputs,
            effort=setting.effort,
            contact=setting.contact_words,
            assumed=setting.assumed,
            fit_notes=fit_notes,
            **LIMITS,
        ),
        "verdicts": [],
        "contact": {**setting.contact_words, "contact model": preferred_model(datasets.force)},
        "changed": [],
        "assumed": list(setting.assumed),
        "chosen": chosen_inputs,
        "surfaces": [_surface_head(surface, datasets.spectra) for surface in surfaces],
        "notes": [*_surface_notes(surfaces), *fit_notes],
        "quantities": all_quantities(
            numbers.values(), {surface.name: surface.numbers.values() for surface in surfaces}
        ),
    }


def _chosen_inputs(force: xr.Dataset, setting: Setting) -> list[str]:
    """Return RANGE_NAME if the scans set it: the shortest range computed, not the paper's."""
    ranges = force["rho"].values
    is_shortest = len(ranges) > 1 and np.isclose(force.attrs["rho"], ranges.min())
    return [RANGE_NAME] if is_shortest and RANGE_NAME not in setting.assumed else []


def surface_answers(datasets: Datasets, setting: Setting) -> list[SurfaceAnswer]:
    """Return the answer of each surface of edges.nc, which lacks the sphere."""
    labels = datasets.labels()
    reference = datasets.select_surface(next(iter(labels)))
    return [
        _surface_answer(name, label, datasets.select_surface(name), reference, setting)
        for name, label in labels.items()
    ]


def _surface_answer(
    name: str, label: str, surface_data: Datasets, reference: Datasets, setting: Setting
) -> SurfaceAnswer:
    """Return the answer of one surface; the reference is the first surface."""
    numbers = [*_octave_numbers(surface_data), *edges.edge_numbers(surface_data)]
    numbers += forces.force_numbers(surface_data)
    if surface_data.force["surface"].item() != reference.force["surface"].item():
        numbers += forces.comparison_numbers(surface_data, reference)
    # A user who gave measured forces, or both range and work of adhesion, has a pair.
    if surface_data.fit is None and {RANGE_NAME, WORK_NAME} & set(setting.assumed):
        numbers += forces.pair_numbers(surface_data.force, setting.pairs)
    if surface_data.fit is not None and name in surface_data.fit["surface"].values:
        surface_fit = select_preferred_model(surface_data.fit).sel(surface=name)
        numbers += forces.measured_numbers(surface_fit, surface_data)
    named_numbers = numbers_by_name(*numbers)
    conclusion = edges.surface_conclusion(named_numbers)
    cautions = answer_cautions(surface_data, named_numbers)
    named_numbers |= numbers_by_name(*_caution_numbers(cautions))
    next_scans = edges.next_scans(named_numbers, surface_data.spectra)
    named_numbers |= numbers_by_name(
        *(scan.limit._replace(name=f"{scan.edge}_{scan.code}_limit") for scan in next_scans),
        *_topography_numbers(surface_data.topography),
        *_measurement_numbers(surface_data.spectra),
    )
    source = str(surface_data.topography["source"].item())
    return SurfaceAnswer(name, label, source, named_numbers, conclusion, cautions, next_scans)


def _octave_numbers(surface_data: Datasets) -> Iterator[Number]:
    """Yield the strongest octaves of one surface, and a rough sphere's share of their power."""
    shown_sensitivity = surface_data.sensitivity.isel(octave=shown_octaves(surface_data))
    for number in strongest_octaves(shown_sensitivity):
        yield number
        # A number in nm is an octave; its sensitivity follows.
        if number.unit == "nm" and "sphere_share" in surface_data.spectra:
            share = octave_sphere_share(surface_data.spectra, number.value)
            yield Number(f"{number.name}_sphere_share", share)


def _study_numbers(datasets: Datasets, setting: Setting) -> list[Number]:
    """Return the numbers of the whole study: settings, Tabor parameter and the fit, if any."""
    rho, work = datasets.force.attrs["rho"], datasets.force.attrs["work_of_adhesion"]
    sources: dict[str, NumberSource] = {
        name: "assumed" if name in setting.assumed else "given" for name in (RANGE_NAME, WORK_NAME)
    }
    return [
        Number("range_of_adhesion", rho, "nm", source=sources[RANGE_NAME]),
        Number("work_of_adhesion", work, "J m-2", source=sources[WORK_NAME]),
        Number("tolerance", datasets.edges.attrs["tolerance"], source="given"),
        Number("confidence", datasets.edges.attrs["confidence"], source="given"),
        stored_tabor_number(datasets.force),
        *([] if datasets.fit is None else forces.fit_numbers(select_preferred_model(datasets.fit))),
    ]


def _surface_notes(surfaces: list[SurfaceAnswer]) -> Iterator[dict[str, Any]]:
    """Yield the notes on the surfaces: which are substitutes, cautions, measurements to make."""
    substitutes = [surface.label for surface in surfaces if surface.source != "measured"]
    yield from substitutes_note(substitutes)
    for surface in surfaces:
        facts: dict[str, Any] = {"label": surface.label, "several": len(surfaces) > 1, **LIMITS}
        for caution in surface.cautions:
            note_head = (caution.code, surface.name, caution.grave)
            facts |= {"caution": caution, "numbers": surface.numbers}
            yield render_note("own_caution.txt", "caution", *note_head, **facts)
        # The same scan may find both edges.
        for scan, same_scans in groupby(surface.next_scans, lambda scan: scan._replace(edge="")):
            facts |= {"scan": scan, "edge_names": [same_scan.edge for same_scan in same_scans]}
            yield render_note("own_next.txt", "next", scan.code, surface.name, **facts)


def _caution_numbers(surface_cautions: list[Caution]) -> Iterator[Number]:
    """Yield the numbers of cautions, named after the code or, for a defect, the measurement."""
    for caution in surface_cautions:
        prefix = f"measurement_{caution.measurement}" if caution.measurement else caution.code
        for number in caution.numbers.values():
            yield number._replace(name=f"{prefix}_{number.name}")


def _topography_numbers(topography: xr.Dataset) -> Iterator[Number]:
    """Yield sizes and heights of a scan, and the roughness of each scan and of all scales."""
    for name in ("scan_size", "pixel_size"):
        yield number_of(topography, name, "nm", source="file")
    heights = panels.centred_heights(topography["example_heights"])
    yield number_without_value("heights", float(heights.min()), float(heights.max()), "nm")
    scans = topography.dropna("scan", subset=["rms_height"])
    for index in range(scans.sizes["scan"]):
        scan = scans.isel(scan=index)
        for name in SHOWN_METRICS:
            yield number_of(scan, name, METRICS[name][0], name=f"scan_{index + 1}_{name}")
    for name in SHOWN_METRICS:
        if f"all_scales_{name}" in topography:
            yield number_of(topography, f"all_scales_{name}", METRICS[name][0])


def _measurement_numbers(spectra: xr.Dataset) -> Iterator[Number]:
    """Yield the lengths of each measurement: size, pixels, reliable wavelengths, tip."""
    for index, scan in enumerate(split_measurements(spectra), start=1):
        for name in MEASUREMENT_LENGTHS:
            yield number_of(scan, name, "nm", name=f"measurement_{index}_{name}", source="file")


def _surface_head(surface: SurfaceAnswer, spectra: xr.Dataset) -> dict[str, Any]:
    """Return the head of one surface in answer.json: its name, conclusion and measurements."""
    measurements = []
    for scan in split_measurements(spectra.sel(surface=surface.name)):
        limit = str(scan["limited_by"].item())
        # The page shows a measurement without a limit as reliable nowhere.
        has_limit = scan["reliable"].any() or limit == reliable_wavelengths.OTHER_BODY
        measurements.append({
            "name": measurement_name(scan),
            "kind": str(scan["kind"].item()),
            "limited_by": limit if has_limit else "",
            "notes": str(scan["notes"].item()).replace("\n", "; "),
        })  # fmt: skip
    return {
        "name": surface.name,
        "label": surface.label,
        "source": surface.source,
        "answered": surface.conclusion.answered,
        "measurements": measurements,
    }
