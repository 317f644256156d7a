"""The answer of a study of own surfaces: its page, and its numbers for answer.json."""

from collections.abc import Collection, Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from hardcontact.base.number import Number
from hardcontact.report.artificial import (
    MEASUREMENT_LENGTHS,
    measurement_name,
    measurements,
    split_measurements,
)
from hardcontact.report.cautions import Caution, cautions
from hardcontact.report.datasets import Datasets, Setting, preferred_model, tabor_number
from hardcontact.report.figures.values import mean_free_heights
from hardcontact.report.force_facts import AnswerRow, fit_facts, preferred_fit
from hardcontact.report.quantities import (
    QuantityMapping,
    number_of,
    numbers_within,
    quantity_mapping,
)
from hardcontact.report.surface_facts import (
    answer_rows,
    next_measurements,
    surface_verdict,
)
from hardcontact.report.templates import rendered, rendered_lines

#: Metrics of a scan, with their units.
METRIC_UNITS = {
    "rms_height": "nm",
    "rms_gradient": "1",
    "rms_half_laplacian": "nm-1",
    "peak_to_valley": "nm",
    "skewness": "1",
    "kurtosis": "1",
}

#: Texts of each measurement.
MEASUREMENT_TEXTS = ("kind", "limited_by", "notes")


class OwnSurface(NamedTuple):
    """The answer of one surface, from which page and answer.json are made."""

    label: str
    data: Datasets
    rows: list[AnswerRow]
    cautions: list[Caution]
    next: list[Mapping[str, Any]]

    @property
    def basis(self) -> str:
        """Whether it is "measured" or a "substitute"."""
        return str(self.data.topography["basis"].item())

    @property
    def roughness(self) -> list[dict[str, Number]]:
        """The metrics of each scan, then those over all scales, as far as they are known."""
        topography = self.data.topography
        scans = topography.dropna("scan", subset=["rms_height"])
        rows = [
            {
                name: number_of(scans.sel(scan=scan), name, unit)
                for name, unit in METRIC_UNITS.items()
            }
            for scan in scans["scan"].values
        ]
        known_metrics = [name for name in METRIC_UNITS if f"all_scales_{name}" in topography]
        all_scales = {
            name: number_of(topography, f"all_scales_{name}", METRIC_UNITS[name], strict=False)
            for name in known_metrics
        }
        unknown = {name: Number(name, np.nan) for name in METRIC_UNITS}
        return [*rows, unknown | all_scales]

    @property
    def scan_lengths(self) -> list[dict[str, Number]]:
        """Size, pixel size, reliable wavelengths and tip radius of each measurement."""
        return [
            {
                name: number_of(measurement, name, "nm", source="file")
                for name in MEASUREMENT_LENGTHS
            }
            for measurement in split_measurements(measurements(self.data.spectra))
        ]


class OwnAnswer(NamedTuple):
    """The answer of a study of own surfaces, with the datasets and settings it was made from."""

    datasets: Datasets
    setting: Setting
    surfaces: dict[str, OwnSurface]

    @property
    def fit(self) -> dict[str, Any] | None:
        """The range and work of adhesion that own forces allow; None without own forces."""
        return None if self.datasets.fit is None else fit_facts(preferred_fit(self.datasets.fit))


def own_answer(datasets: Datasets, setting: Setting) -> OwnAnswer:
    """Return the answer of each surface that has a band.

    setting: the settings that the datasets do not hold.
    Returns the answers by surface.
    """
    surfaces = {}
    adhesion = {"range of adhesion", "work of adhesion"}
    # A user who gave both, or own forces, has a pair.
    asks_for_pairs = datasets.fit is None and adhesion & set(setting.of_paper)
    pairs = setting.pairs if asks_for_pairs else ()
    for name, label in datasets.labels().items():
        surface_data = datasets.select_surface(name)
        rows = answer_rows(surface_data, pairs)
        surfaces[name] = OwnSurface(
            label, surface_data, rows, cautions(surface_data), next_measurements(surface_data)
        )
    return OwnAnswer(datasets, setting, surfaces)


def own_headline(answer: OwnAnswer) -> list[str]:
    """Return the first sentences of the page, which the terminal also shows.

    answer: from `own_answer`.
    """
    surfaces = [
        {**surface._asdict(), "basis": surface.basis, "verdict": surface_verdict(surface.rows)}
        for surface in answer.surfaces.values()
    ]
    return rendered_lines("own_headline.txt", surfaces=surfaces)


def own_warnings(answer: OwnAnswer) -> list[str]:
    """Return the sentences on substitutes and on grave cautions that follow the headline.

    answer: from `own_answer`.
    """
    return rendered_lines("own_warnings.txt", surfaces=list(answer.surfaces.values()))


def own_head(setting: Setting, headline: Sequence[str]) -> dict[str, Any]:
    """Return the head of answer.json.

    headline: the first sentences of the page.
    Returns the entries before the list of quantities.
    """
    return {
        "study": setting.study,
        "version": setting.citation["version"],
        "effort": setting.effort,
        "kind": "own surfaces",
        "headline": list(headline),
        "contact": dict(setting.contact),
    }


def own_quantities(answer: OwnAnswer, of_paper: Collection[str]) -> Iterator[QuantityMapping]:
    """Yield every number of the page, those of the whole study first.

    answer: from `own_answer`.
    of_paper: the quantities of the contact that are the paper's: assumed.
    Yields a number as a mapping for answer.json.
    """
    datasets, _, surfaces = answer
    for name, unit in {"range_of_adhesion": "nm", "work_of_adhesion": "J m-2"}.items():
        source = "assumed" if name.replace("_", " ") in of_paper else "given"
        yield quantity_mapping(Number(name, datasets.force.attrs[name], unit, source=source))
    for name in ("tolerance", "confidence"):
        yield quantity_mapping(Number(name, datasets.edges.attrs[name], source="given"))
    yield quantity_mapping(tabor_number(datasets.force))
    for number in numbers_within("fit", answer.fit or {}):
        yield quantity_mapping(number)
    for name, surface in surfaces.items():
        for number in _numbers_of(surface):
            yield quantity_mapping(number, name)


def _numbers_of(surface: OwnSurface) -> Iterator[Number]:
    """Yield the numbers of one surface: answer, cautions, what to measure, scans."""
    yield Number("answered", np.nan, status=surface_verdict(surface.rows)["answer"])
    for row in surface.rows:
        variant = row.about.get("side") or row.about.get("pair") or ""
        name = f"{row.fact.name}_{variant}".rstrip("_")
        yield row.fact._replace(name=name)
        yield from numbers_within(name, row.about)
    for number, caution in enumerate(surface.cautions, start=1):
        yield Number(f"caution_{number}", np.nan, status=caution["code"])
        yield from numbers_within(caution["code"], caution)
    for measurement in surface.next:
        yield from numbers_within(f"{measurement['edge']}_{measurement['code']}", measurement)
    for name in ("scan_size", "pixel_size"):
        yield number_of(surface.data.topography, name, "nm", source="file")
    *scans, all_scales = surface.roughness
    for number, metrics in enumerate(scans, start=1):
        yield from numbers_within(f"scan_{number}", metrics)
    yield from numbers_within("all_scales", all_scales)
    for number, lengths in enumerate(surface.scan_lengths, start=1):
        yield from numbers_within(f"measurement_{number}", lengths)


def own_page(
    answer: OwnAnswer,
    headline: Sequence[str],
    warnings: Sequence[str],
    pictures: Mapping[str, bytes],
) -> str:
    """Return the page.

    answer: from `own_answer`.
    headline, warnings: from `own_headline` and `own_warnings`.
    pictures: SVG by the name of the figure.
    """
    datasets, setting, surfaces = answer
    return rendered(
        "own.html",
        headline=headline,
        warnings=warnings,
        study=setting.study,
        effort=setting.effort,
        citation=setting.citation,
        left_out=setting.left_out,
        tolerance=float(datasets.edges.attrs["tolerance"]),
        confidence=float(datasets.edges.attrs["confidence"]),
        surfaces=[_page_facts(surface) for surface in surfaces.values()],
        contact=setting.contact,
        of_paper=setting.of_paper,
        tabor=tabor_number(datasets.force),
        pictures=pictures,
        fit=answer.fit,
        fit_model=None if datasets.fit is None else preferred_model(datasets.fit),
    )


def _page_facts(surface: OwnSurface) -> dict[str, Any]:
    """Return the facts about one surface for the template of the page."""
    data = surface.data
    heights = mean_free_heights(data.topography["example_heights"])
    lengths = zip(split_measurements(measurements(data.spectra)), surface.scan_lengths, strict=True)
    return surface._asdict() | {
        "basis": surface.basis,
        "heights": [float(heights.min()), float(heights.max())],
        "size": float(data.topography["scan_size"]),
        "pixel": float(data.topography["pixel_size"]),
        "roughness": surface.roughness,
        "measurements": [
            {"name": measurement_name(measurement), "reliable": bool(measurement["reliable"].any())}
            | {text: str(measurement[text].item()) for text in MEASUREMENT_TEXTS}
            | numbers
            for measurement, numbers in lengths
        ],
    }
