"""The answer of a study of own surfaces: computed once, for its page and for answer.json."""

from collections.abc import Mapping
from typing import Any, NamedTuple

import xarray as xr

from hardcontact.answer.artificial import (
    LENGTHS,
    artificial_bands,
    measurements,
    place_of_edge,
    single,
)
from hardcontact.answer.datasets import Datasets, Setting, at_range
from hardcontact.answer.facts import Row
from hardcontact.answer.limits import Limit, limits, tail
from hardcontact.answer.surface_facts import SOURCES, answer_rows, next_measurements, verdict
from hardcontact.numbers.number import plain
from hardcontact.numbers.statistics import bounds
from hardcontact.scales.critical_band import computed_cutoffs
from hardcontact.surfaces.synthesis import SIDES

#: Metrics of a scan, with their units.
METRICS = {
    "rms_height": "nm",
    "rms_gradient": "1",
    "rms_half_laplacian": "nm-1",
    "peak_to_valley": "nm",
    "skewness": "1",
    "kurtosis": "1",
}
#: Texts of each measurement, beside its lengths.
MEASUREMENT_TEXTS = ("path", "dataset", "kind", "limited_by", "notes")


class OwnSurface(NamedTuple):
    """The answer of one surface: codes with values, of which page and answer.json are made."""

    label: str
    of: Datasets
    rows: list[Row]
    limits: list[Limit]
    next: list[Mapping[str, Any]]

    @property
    def basis(self) -> str:
        """Whether it is "measured" or a "substitute"."""
        return str(self.of.topography["basis"].item())

    @property
    def scans(self) -> list[xr.Dataset]:
        """The metrics of each scan that there is."""
        seen = self.of.topography.dropna("scan", subset=["rms_height"])
        return [seen.sel(scan=scan) for scan in seen["scan"].values]


class OwnAnswer(NamedTuple):
    """The answer of a study of own surfaces, by their names, and what it was made from."""

    given: Datasets
    setting: Setting
    surfaces: dict[str, OwnSurface]


def own_answer(given: Datasets, setting: Setting) -> OwnAnswer:
    """Return what the datasets answer."""
    surfaces, adhesion = {}, {"range of adhesion", "work of adhesion"}
    # A user who gave both knows them.
    pairs = setting.pairs if adhesion & set(setting.of_paper) else ()
    for name, label in given.labels().items():
        of = given.of_surface(name)
        rows = answer_rows(of, pairs)
        surfaces[name] = OwnSurface(label, of, rows, limits(of), next_measurements(of))
    return OwnAnswer(given, setting, surfaces)


def as_plain(answer: OwnAnswer) -> dict[str, Any]:
    """Return the numbers of the answer for JSON, as answer_surfaces.schema.json describes them."""
    given, setting, surfaces = answer
    numbers: dict[str, Any] = {
        "study": setting.study,
        "effort": setting.effort,
        "contact": dict(setting.contact),
        "of_paper": list(setting.of_paper),
        "range_of_adhesion": _number(given.force.attrs["range_of_adhesion"], "nm"),
        "work_of_adhesion": _number(given.force.attrs["work_of_adhesion"], "J m-2"),
        "tolerance": _number(given.edges.attrs["tolerance"], "1"),
        "confidence": _number(given.edges.attrs["confidence"], "1"),
        "surfaces": {name: _of_surface(one) for name, one in surfaces.items()},
        "pooled_band": _pooled(given.edges),
        "fit": None if given.fit is None else _fit(given.fit),
        "left_out": [{"part": part, "reason": reason} for part, reason in setting.left_out],
    }
    return {name: plain(one) for name, one in numbers.items()}


def _of_surface(surface: OwnSurface) -> dict[str, Any]:
    """Return the numbers of one surface."""
    of = surface.of
    found = verdict(surface.rows)
    return {
        "verdict": {name: found[name] for name in ("answer", "band")},
        "answer": [plain(row.fact) | {"about": row.about} for row in surface.rows],
        "label": str(of.topography["label"].item()),
        "basis": surface.basis,
        "scan_size": _of(of.topography, "scan_size", "nm"),
        "pixel_size": _of(of.topography, "pixel_size", "nm"),
        "scans": [
            {"scan": int(scan["scan"])}
            | {name: _of(scan, name, unit) for name, unit in METRICS.items()}
            for scan in surface.scans
        ],
        "spectrum": _spectrum(of.spectra),
        "band": {side: _edge(of, side) for side in SIDES},
        "force": _force(of.force),
        "limits": surface.limits,
        "next_measurements": surface.next,
    }


def _spectrum(of_surface: xr.Dataset) -> dict[str, Any]:
    """Return the joined spectrum, its measurements, and the wavelengths that are artificial."""
    joined = of_surface["joined"].dropna("bin_wavevector")
    return {
        "measurements": [
            {name: str(one[name].item()) for name in MEASUREMENT_TEXTS}
            | {name: _of(one, name, "nm") for name in LENGTHS}
            for one in single(measurements(of_surface))
        ],
        "artificial": [{"from": _number(low, "nm"), "to": _number(high, "nm")}
                       for low, high in artificial_bands(of_surface)],
        "tail": tail(of_surface),
        "wavevector": _numbers(joined["bin_wavevector"], "rad nm-1"),
        "joined_psd": _numbers(joined, "nm4"),
    }  # fmt: skip


def _edge(of: Datasets, side: str) -> dict[str, Any]:
    """Return one edge of a band, and the ratio curve that it follows from."""
    of_side = of.edges.sel(side=side)
    ends = (of_side["interval_status"].sel(bound=bound).item() for bound in ("low", "high"))
    curve = of_side.sel(cutoff_wavelength=computed_cutoffs(of_side["scale_ratio"]))
    return {
        "source": SOURCES[place_of_edge(of, side)],
        "status": str(of_side["edge_status"].item()),
        "edge": _of(of_side, "edge", "nm"),
        "bound": _of(of_side, "edge_bound", "nm"),
        "edge_at_least": bool(of_side["edge_at_least"].item()),
        "interval_status": [str(end) for end in ends],
        "interval_source": str(of_side["interval_source"].item()),
        "conditional": bool(of_side["conditional"].item()),
        "cutoff_wavelength": _numbers(curve["cutoff_wavelength"], "nm"),
        "force_ratio": _bounded_numbers(curve, "scale_ratio", "1"),
    }


def _pooled(edges: xr.Dataset) -> dict[str, Any] | None:
    """Return the band of the mean change over several surfaces, None of a single one."""
    if "pooled_edge" not in edges:
        return None
    return {
        side: _of(of_side, "pooled_edge", "nm")
        | {
            "status": str(of_side["pooled_edge_status"].item()),
            "bound": _of(of_side, "pooled_edge_bound", "nm"),
            "edge_at_least": bool(of_side["pooled_edge_at_least"].item()),
        }
        for side, of_side in ((side, edges.sel(side=side)) for side in SIDES)
    }


def _force(force: xr.Dataset) -> dict[str, Any]:
    """Return the force at the range asked for, its spread, and the force over the range."""
    here = at_range(force)
    quantiles = zip(here["quantile"].values, here["force_quantile"].values, strict=True)
    return {
        **_of(here, "force", "N"),
        "with_continued_roughness": {side: _continued(force.sel(side=side)) for side in SIDES},
        "contact_model": str(here["contact_model"].item()),
        "interval_source": str(force["interval_source"].item()),
        "quantiles_of_contacts": {f"{share:g}": _number(value, "N") for share, value in quantiles},
        "rho": _numbers(force["rho"], "nm"),
        "over_rho": {
            str(model): _bounded_numbers(force.sel(contact_model=model), "force", "N")
            for model in force["contact_model"].values
        },
    }


def _continued(of_side: xr.Dataset) -> dict[str, Any]:
    """Return the force with roughness continued at one side of a surface."""
    return _of(of_side, "continued_force", "N") | {
        "differs": bool(of_side["continued_differs"].item()),
        "from": _of(of_side, "transition", "nm"),
        "to": _of(of_side, "continued_end", "nm"),
        "interval_source": str(of_side["continued_source"].item()),
    }


def _fit(fit: xr.Dataset) -> dict[str, Any]:
    """Return all numbers of a fit to the user's own forces, each with its dimensions."""
    numbers = {str(name): one for name, one in fit.data_vars.items() if one.dtype.kind in "fiu"}
    texts = {str(name): one for name, one in fit.data_vars.items() if name not in numbers}
    return {
        "origin": "measured",
        "coordinates": {str(name): fit[name].values.tolist() for name in fit.coords},
        "texts": {name: one.values.tolist() for name, one in texts.items()},
        **{
            name: {"dimensions": list(map(str, values.dims))}
            | _numbers(values, str(values.attrs.get("units", "1")))
            for name, values in numbers.items()
        },
    }


def _of(dataset: xr.Dataset, name: str, unit: str) -> dict[str, Any]:
    """Return a variable without dimensions, with its interval if it has one."""
    number = _number(dataset[name].item(), unit)
    if f"{name}_interval" not in dataset:
        return number
    return number | {"interval": [float(end) for end in bounds(dataset, name)]}


def _number(value: float, unit: str) -> dict[str, Any]:
    return {"value": float(value), "unit": unit}


def _numbers(values: xr.DataArray, unit: str) -> dict[str, Any]:
    return {"values": values.values.astype(float).tolist(), "unit": unit}


def _bounded_numbers(dataset: xr.Dataset, name: str, unit: str) -> dict[str, Any]:
    """Return a variable of one dimension, and the ends of its interval."""
    low, high = (end.values.tolist() for end in bounds(dataset, name))
    return _numbers(dataset[name], unit) | {"low": low, "high": high}
