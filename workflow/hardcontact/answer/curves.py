"""The curves of the page of own surfaces, as values that a page and a picture draw alike.

Each is what the macro `curves` of the templates draws.
"""

from collections.abc import Mapping
from itertools import cycle
from pathlib import PurePath
from typing import Any

import numpy as np
import xarray as xr

from hardcontact.answer.artificial import artificial_bands, measurement_name, measurements, single
from hardcontact.answer.datasets import model_of
from hardcontact.figures.style import SUBSTRATES
from hardcontact.numbers.statistics import bounds
from hardcontact.scales.critical_band import computed_cutoffs

Curve = dict[str, Any]

REMOVED = {"small": "without shorter wavelengths", "large": "without longer wavelengths"}
COLOURS = {"small": "#0072b2", "large": "#d55e00"}
MEASURED = {"map": "#0072b2", "profile": "#009e73", "description": "#d55e00"}
UNRELIABLE, JOINED, USED = "#999999", "#e69f00", "#cc79a7"
#: Ratios of forces beyond this leave the panel, so that a change of 10 % can be seen in it.
HIGHEST = 2.0
#: Measurements up to which those parts are drawn that are not reliable: more hide each other.
FEW = 3
#: Factor by which shaded wavelengths go on beyond those of the curves.
MARGIN = 10.0


def _values(values: np.ndarray) -> list[float | None]:
    """Return numbers of five digits for JSON, None where one is not known or not positive."""
    return [float(f"{value:.5g}") if 0 < value < np.inf else None for value in values]


def _series(label: str, colour: str, values: np.ndarray, *ends: np.ndarray) -> dict[str, Any]:
    """Return a curve with the ends of its interval, if it has two that bound anything."""
    known_ends = len(ends) == 2 and all(np.isfinite(end[end > 0]).any() for end in ends)
    low, high = (_values(end) for end in ends) if known_ends else (None, None)
    return {"label": label, "colour": colour, "values": _values(values), "low": low, "high": high}


def _shaded(of_spectra: xr.Dataset, x: np.ndarray) -> list[list[float]]:
    """Return the wavelengths at which no scan is reliable, as far as a panel may reach."""
    least, most = x.min() / MARGIN, x.max() * MARGIN
    bands = ((max(low, least), min(high, most)) for low, high in artificial_bands(of_spectra))
    return [[low, high] for low, high in bands if high > low]


def ratio_curve(edges: xr.Dataset, spectra: xr.Dataset) -> Curve:
    """Return the force over the unfiltered one against the cutoff (nm), of one surface."""
    cutoffs = computed_cutoffs(edges["scale_ratio"])
    at = edges.sel(cutoff_wavelength=cutoffs)
    series = [
        _series(
            label, COLOURS[side], of_side["scale_ratio"].values,
            *(end.values for end in bounds(of_side, "scale_ratio")),
        )
        for (side, label), of_side in ((one, at.sel(side=one[0])) for one in REMOVED.items())
    ]  # fmt: skip
    ratios, tolerance = at["scale_ratio"], edges.attrs["tolerance"]
    least = max(0.0, min(float(ratios.min()), 1 - 2 * tolerance) - 0.05)
    most = min(HIGHEST, max(float(ratios.max()), 1 + 2 * tolerance) + 0.05)
    return {
        "x": {"label": "cutoff wavelength (nm)", "log": True, "values": _values(cutoffs)},
        "y": {"label": "force / unfiltered force", "log": False, "range": [least, most]},
        "series": series,
        "shaded": _shaded(spectra, cutoffs),
        "alike": [1 - tolerance, 1 + tolerance],
        "marks": [float(one) for one in edges["edge"].values if np.isfinite(one)],
    }


def spectrum_curve(spectra: xr.Dataset) -> Curve:
    """Return the isotropic PSD (nm⁴) of each measurement of one surface, and what is made of them.

    It is over the wavelength in nm.
    """
    all_bins, seen = 2 * np.pi / spectra["bin_wavevector"].values, measurements(spectra)
    shown = np.isfinite(seen["psd"].values).any(axis=0)
    order = np.flatnonzero(shown)[::-1]  # of growing wavelength
    x = all_bins[order]
    series = []
    for one in single(seen):
        density, reliable = one["psd"].values[order], one["reliable"].values[order] == 1
        name, kind = PurePath(measurement_name(one)).name, str(one["kind"].item())
        series.append(_series(name, MEASURED[kind], np.where(reliable, density, np.nan)))
        if seen.sizes["measurement"] <= FEW and np.isfinite(density[~reliable]).any():
            unreliable = np.where(reliable, np.nan, density)
            blind = _series(f"{name}, not reliable", UNRELIABLE, unreliable)
            series.append(blind | {"gaps": True})  # where it is reliable is another curve
    with np.errstate(divide="ignore"):
        used = np.interp(
            np.log(2 * np.pi / x), np.log(spectra["wavevector"]), np.log(spectra["spectrum"])
        )
    series.append(_series("joined", JOINED, spectra["joined"].values[order]))
    series.append(_series("used", USED, np.exp(used)))
    return {
        "x": {"label": "wavelength (nm)", "log": True, "values": _values(x)},
        "y": {"label": "isotropic PSD (nm⁴)", "log": True},
        "series": series,
        "shaded": _shaded(spectra, x),
    }


def _over_range(rho: np.ndarray, label: str, series: list[dict[str, Any]], asked: float) -> Curve:
    return {
        "x": {"label": "range of adhesion (nm)", "log": True, "values": _values(rho)},
        "y": {"label": label, "log": True},
        "series": series,
        "marks": [float(asked)],
    }


def force_curve(force: xr.Dataset, labels: Mapping[str, str]) -> Curve:
    """Return the mean force of all surfaces and contact models in µN over the range in nm.

    Labels are the names of the surfaces in print; intervals are those of the model of the answer.
    """
    chosen = model_of(force)
    models = [chosen, *(str(m) for m in force["contact_model"].values if m != chosen)]
    pairs = [(surface, model) for surface in labels for model in models]
    series = []
    for (surface, model), colour in zip(pairs, cycle(SUBSTRATES), strict=False):
        one = force.sel(surface=surface, contact_model=model)
        ends = [1e6 * end.values for end in bounds(one, "force")] if model == chosen else []
        mean = 1e6 * one["force"].values
        series.append(_series(f"{labels[surface]}, {model}", colour, mean, *ends))
    asked = force.attrs["range_of_adhesion"]
    return _over_range(force["rho"].values, "pull-off force (µN)", series, asked)


def work_curve(fit: xr.Dataset, labels: Mapping[str, str]) -> Curve:
    """Return the work of adhesion in mJ/m² that fits the force of each surface, over the range.

    The fit is of one contact model; of several surfaces also what fits all of them is returned.
    """
    at = fit.isel(rho=np.unique(np.linspace(0, fit.sizes["rho"] - 1, 81).astype(int)))
    names = [str(name) for name in fit["surface"].values]
    series = [
        _series(
            labels[name], colour, 1e3 * of["work_of_adhesion"].values,
            *(1e3 * end.values for end in bounds(of, "work_of_adhesion")),
        )
        for (name, colour), of in (
            (one, at.sel(surface=one[0])) for one in zip(names, cycle(SUBSTRATES), strict=False)
        )
    ]  # fmt: skip
    region = 1e3 * at["region"].values
    if len(names) > 1 and np.isfinite(region).any():
        middle = np.sqrt(region[:, 0] * region[:, 1])
        series.append(_series("fits all", "#555555", middle, *region.T))
    asked = fit.attrs["range_of_adhesion"]
    return _over_range(at["rho"].values, "work of adhesion (mJ/m²)", series, asked)
