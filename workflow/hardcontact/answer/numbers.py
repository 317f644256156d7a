"""The numbers of an answer for machines: answer.json."""

from typing import Any

import numpy as np
import xarray as xr

from hardcontact.answer.artificial import (
    LENGTHS,
    artificial_bands,
    measurements,
    place_of_edge,
    single,
)
from hardcontact.answer.datasets import Datasets, Setting, at_range
from hardcontact.answer.facts import Fact, known
from hardcontact.answer.limits import limits, tail
from hardcontact.answer.next_measurements import next_measurements
from hardcontact.answer.surface_facts import SOURCES, answer_rows
from hardcontact.numbers.statistics import bounds
from hardcontact.scales.critical_band import computed_cutoffs
from hardcontact.surfaces.synthesis import SIDES

#: Metrics of a scan that the answer shows, with their units.
METRICS = {
    "rms_height": "nm",
    "rms_gradient": "1",
    "rms_half_laplacian": "nm-1",
    "peak_to_valley": "nm",
    "skewness": "1",
    "kurtosis": "1",
}

#: Texts that answer.json has of each measurement, beside its lengths.
MEASUREMENT_TEXTS = ("path", "dataset", "kind", "shortest_reason", "longest_reason", "notes")


def answer_numbers(given: Datasets, setting: Setting) -> dict[str, Any]:
    """Return the numbers of an answer, ready for JSON: what is not known is None."""
    force = given.force
    return {
        "study": setting.study,
        "effort": setting.effort,
        "contact": dict(setting.contact),
        "of_paper": list(setting.of_paper),
        "range_of_adhesion": _number(force.attrs["range_of_adhesion"], "nm"),
        "work_of_adhesion": _number(force.attrs["work_of_adhesion"], "J m-2"),
        "tolerance": _number(given.edges.attrs["tolerance"], "1"),
        "confidence": _number(given.edges.attrs["confidence"], "1"),
        "surfaces": {
            surface: _of_surface(label, given.of_surface(surface), given.fit)
            for surface, label in given.labels().items()
        },
        "pooled_band": _pooled(given.edges),
        "fit": None if given.fit is None else _fit(given.fit),
        "left_out": [{"part": part, "reason": reason} for part, reason in setting.left_out],
    }


def _of_surface(label: str, given: Datasets, fit: xr.Dataset | None) -> dict[str, Any]:
    """Return the numbers of one surface from its parts of the datasets, and the fit of all."""
    bands = artificial_bands(given.spectra)
    return {
        "answer": [
            row.fact._asdict() | {"about": plain(row.about)}
            for row in answer_rows(label, given, fit)
        ],
        "label": str(given.topography["label"].item()),
        "basis": str(given.topography["basis"].item()),
        "scan_size": _of(given.topography, "scan_size", "nm"),
        "pixel_size": _of(given.topography, "pixel_size", "nm"),
        "scans": _scans(given.topography),
        "spectrum": _spectrum(given.spectra),
        "band": {side: _edge(given.edges.sel(side=side), bands) for side in SIDES},
        "force": _force(given.force),
        "limits": plain(limits(given)),
        "next_measurements": plain(next_measurements(given._replace(fit=fit))),
    }


def plain(value: Any) -> Any:
    """Return codes with values ready for JSON: facts as mappings."""
    if isinstance(value, Fact):
        return value._asdict()
    if isinstance(value, dict):
        return {key: plain(one) for key, one in value.items()}
    return [plain(one) for one in value] if isinstance(value, list) else value


def _scans(of_surface: xr.Dataset) -> list[dict[str, Any]]:
    """Return the metrics of each scan of a surface."""
    seen = of_surface.dropna("scan", subset=["rms_height"])
    return [
        {"scan": int(number)} | {name: _of(one, name, unit) for name, unit in METRICS.items()}
        for number, one in ((n, seen.sel(scan=n)) for n in seen["scan"].values)
    ]


def _spectrum(of_surface: xr.Dataset) -> dict[str, Any]:
    """Return the joined spectrum, its measurements, and the wavelengths that are artificial."""
    joined = of_surface["joined"].dropna("bin_wavevector")
    return {
        "measurements": [
            {name: str(one[name].item()) for name in MEASUREMENT_TEXTS}
            | {name: _of(one, name, "nm") for name in LENGTHS}
            for one in single(measurements(of_surface))
        ],
        "artificial": [
            {"from": _number(low, "nm"), "to": _number(high, "nm")}
            for low, high in artificial_bands(of_surface)
        ],
        "tail": plain(tail(of_surface)),
        "wavevector": _numbers(joined["bin_wavevector"], "rad nm-1"),
        "joined_psd": _numbers(joined, "nm4"),
    }


def _edge(of_side: xr.Dataset, bands: list[tuple[float, float]]) -> dict[str, Any]:
    """Return one edge of a band, and the ratio curve that it follows from."""
    ends = (of_side["interval_status"].sel(bound=bound).item() for bound in ("low", "high"))
    curve = of_side.sel(cutoff_wavelength=computed_cutoffs(of_side["scale_ratio"]))
    return {
        "source": SOURCES[place_of_edge(of_side, bands)],
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
    return {
        **_of(here, "force", "N"),
        "with_continued_roughness": {side: _continued(force.sel(side=side)) for side in SIDES},
        "contact_model": str(here["contact_model"].item()),
        "interval_source": str(force["interval_source"].item()),
        "quantiles_of_contacts": {
            f"{share:g}": _number(value, "N")
            for share, value in zip(
                here["quantile"].values, here["force_quantile"].values, strict=True
            )
        },
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
    return {
        "origin": "measured",
        "coordinates": {str(name): fit[name].values.tolist() for name in fit.coords},
        "texts": {
            str(name): values.values.tolist()
            for name, values in fit.data_vars.items()
            if values.dtype.kind not in "fiu"
        },
        **{
            str(name): {"dimensions": list(map(str, values.dims))}
            | _numbers(values, str(values.attrs.get("units", "1")))
            for name, values in fit.data_vars.items()
            if values.dtype.kind in "fiu"
        },
    }


def _of(dataset: xr.Dataset, name: str, unit: str) -> dict[str, Any]:
    """Return a variable without dimensions, with its interval if it has one."""
    number = _number(dataset[name].item(), unit)
    if f"{name}_interval" not in dataset:
        return number
    return number | {"interval": [known(end.item()) for end in bounds(dataset, name)]}


def _number(value: float, unit: str) -> dict[str, Any]:
    return {"value": known(value), "unit": unit}


def _numbers(values: xr.DataArray, unit: str) -> dict[str, Any]:
    return {"values": _listed(values.values), "unit": unit}


def _bounded_numbers(dataset: xr.Dataset, name: str, unit: str) -> dict[str, Any]:
    """Return a variable of one dimension, and the ends of its interval."""
    low, high = (_listed(end.values) for end in bounds(dataset, name))
    return _numbers(dataset[name], unit) | {"low": low, "high": high}


def _listed(values: np.ndarray) -> Any:
    """Return an array as nested lists."""
    return [_listed(part) for part in values] if values.ndim else known(values.item())
