"""Computed and measured forces of your surfaces as numbers, their ratios and their fit."""

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np
import xarray as xr

from hardcontact.base.arrays import Floats
from hardcontact.base.number import Number, NumberSource, NumberStatus
from hardcontact.contact.hertz_jkr_dmt import dmt_pull_off
from hardcontact.inference.octaves import NAMED_OCTAVE_COUNT
from hardcontact.report.own_surfaces.datasets import (
    Datasets,
    fails_hindcast,
    forces_at_range,
    select_preferred_model,
    shown_octaves,
)
from hardcontact.report.own_surfaces.edges import (
    NEARLY_ALL,
    add_status,
    reliable_and_unreliable_change,
    reliable_share,
)
from hardcontact.report.quantities import NoValue, number_of, number_without_value
from hardcontact.surfaces.spectrum import spectrum_of_dataset
from hardcontact.surfaces.synthesis import SIDES

#: Wavevectors at which an octave is integrated.
WAVEVECTORS_PER_OCTAVE = 33


def force_numbers(surface_data: Datasets) -> list[Number]:
    """Return the forces of one surface at the configured range, and numbers that explain them."""
    force = surface_data.force
    forces = forces_at_range(force)
    quantiles = forces["force_quantile"]  # The outermost stored quantiles are nearest to 0 and 1.
    lowest, median, highest = quantiles.sel(quantile=[0, 0.5, 1], method="nearest").values.tolist()
    smooth = dmt_pull_off(force.attrs["work_of_adhesion"], force.attrs["sphere_radius"])
    return [
        add_status(number_of(forces, "force", name="mean_force"), force["interval_source"]),
        _mean_force_measured_share(surface_data),
        *_extrapolated_forces(surface_data),
        Number("median_force", median, "N"),
        number_without_value("middle_forces", lowest, highest, "N"),
        Number("force_middle_share", float(np.ptp(quantiles["quantile"].values))),
        Number("smooth_force", float(smooth), "N"),
        number_of(forces, "log_force_std", "1"),
        number_of(force, "weibull_modulus", "1"),
        number_of(forces, "contacts_needed", "1"),
        number_of(force, "search_size", "nm"),
        *([number_of(forces, "position_factor")] if "position_factor" in forces else []),
        Number("range_sensitivity", _range_sensitivity(force)),
    ]


def _mean_force_measured_share(surface_data: Datasets) -> Number:
    """Return the share of reliable wavelengths in the change of the force by roughness.

    The source is "measured" if unreliable wavelengths change the force within the tolerance.
    """
    reliable, unreliable = reliable_and_unreliable_change(surface_data, "short")
    share = reliable_share(reliable, unreliable)
    source: NumberSource = "extrapolated" if share < 1 - NEARLY_ALL else "partly_extrapolated"
    if unreliable <= np.log1p(surface_data.edges.attrs["tolerance"]):
        source = "measured"
    return Number("mean_force_measured_share", share, source=source)


def _extrapolated_forces(surface_data: Datasets) -> list[Number]:
    """Return the forces with extrapolated roughness, and the wavelengths between which it lies."""
    numbers = []
    for side in differing_sides(surface_data.force):
        force = surface_data.force.sel(side=side)
        name = f"extrapolated_force_{side}"
        number = extrapolated_number(force, "extrapolated_force", name, surface_data)
        numbers += [
            add_status(number, force["extrapolated_force_interval_source"]),
            number_of(force, "transition", "nm", name=f"{name}_start"),
            number_of(force, "extrapolation_end", "nm", name=f"{name}_end"),
        ]
    return numbers


def differing_sides(dataset: xr.Dataset) -> list[str]:
    """Return the sides at which force.nc or fit.nc states that extrapolation changes the force."""
    return [side for side in SIDES if dataset["extrapolation_matters"].sel(side=side).item() == 1]


def extrapolated_number(
    side_data: xr.Dataset, variable: str, name: str, surface_data: Datasets
) -> Number:
    """Return the force, or the work of adhesion, with roughness extrapolated at one side.

    NaN if nothing supports the extrapolation: a hindcast fails, or the exponent is not known.
    """
    number = number_of(side_data, variable, name=name, source="extrapolated")
    side = str(side_data["side"].item())
    unknown = Number(name, np.nan, number.unit, source=number.source)
    if fails_hindcast(surface_data, side):
        return unknown._replace(status=NoValue.NO_HINDCAST)
    if side == "short" and surface_data.spectra["tail_known"].item() != 1:
        return unknown._replace(status=NoValue.NO_EXPONENT)
    return number


def _logarithmic_curve(force: xr.Dataset) -> tuple[Floats, Floats]:
    """Return ln(range) and ln(force) at the computed ranges, by the preferred contact model."""
    model_forces = select_preferred_model(force)
    return np.log(model_forces["rho"].values), np.log(model_forces["force"].values)


def _range_sensitivity(force: xr.Dataset) -> float:
    """Return d ln F/d ln rho at the configured range, NaN if no other range was computed."""
    log_ranges, log_forces = _logarithmic_curve(force)
    if len(log_ranges) < 2:
        return np.nan
    nearest = np.abs(log_ranges - np.log(force.attrs["rho"])).argmin()
    return float(np.gradient(log_forces, log_ranges)[nearest])


def pair_numbers(force: xr.Dataset, pairs: Sequence[Mapping[str, Any]]) -> list[Number]:
    """Return the force of one surface at other pairs of range and work of adhesion.

    A pair is a row of resources/adhesion/pairs.csv.
    """
    configured_rho, configured_work = force.attrs["rho"], force.attrs["work_of_adhesion"]
    log_ranges, log_forces = _logarithmic_curve(force)
    numbers = []
    for pair in pairs:
        rho, work = pair["range_of_adhesion_nm"], pair["work_of_adhesion_J_m2"]
        if np.allclose((configured_rho, configured_work), (rho, work), rtol=1e-6):
            continue
        pair_force = np.exp(np.interp(np.log(rho), log_ranges, log_forces, np.nan, np.nan))
        name = f"force_of_pair_{pair['pair']}"
        numbers += [
            Number(name, float(pair_force * work / configured_work), "N"),
            Number(f"{name}_range", rho, "nm"),
            Number(f"{name}_work", work, "J m-2"),
            Number(f"{name}_share", pair["share_of_sets"]),
        ]
    return numbers


def comparison_numbers(surface_data: Datasets, reference: Datasets) -> Iterator[Number]:
    """Yield the ratio of the forces on a surface and a reference, and the octaves that cause it."""
    force = number_of(forces_at_range(surface_data.force), "force")
    reference_force = number_of(forces_at_range(reference.force), "force")
    ratio = force.value / reference_force.value
    # Scans are independent, so that the errors of both logarithms add in squares. The ratio is low
    # where the force is low or the reference force is high, so [::-1] puts the high end first.
    fall, rise = np.hypot(_log_distances(force), _log_distances(reference_force)[::-1])
    low, high = float(ratio * np.exp(-fall)), float(ratio * np.exp(rise))
    status = NumberStatus.PLAIN if np.isfinite([low, high]).any() else NumberStatus.NO_INTERVAL
    yield Number("force_over_reference", ratio, "1", low, high, status)
    octaves, contributions = _octave_contributions(surface_data, reference)
    # Positive where an octave changes the ratio in the direction of the whole change.
    aligned = contributions * np.log(ratio)
    strongest = [index for index in np.argsort(-aligned)[:NAMED_OCTAVE_COUNT] if aligned[index] > 0]
    for rank, index in enumerate(strongest, start=1):
        name = f"force_over_reference_octave_{rank}"
        yield Number(name, float(octaves[index]), "nm")
        yield Number(f"{name}_factor", math.exp(contributions[index]))


def _log_distances(number: Number) -> Floats:
    """Return the distances (2,) of both ends of the interval from the value, in logarithms."""
    with np.errstate(divide="ignore"):
        return np.abs(np.log(np.array([number.low, number.high]) / number.value))


def _octave_contributions(surface_data: Datasets, reference: Datasets) -> tuple[Floats, Floats]:
    """Return octaves that scans of both surfaces show, and their contributions to ln(force ratio).

    An octave is given by its shortest wavelength in nm. A contribution is the difference of
    ln(amplitude) times the mean sensitivity d ln F / d ln a.
    """
    is_shown = shown_octaves(surface_data) & shown_octaves(reference)
    octaves = surface_data.sensitivity["octave"].values[is_shown]
    both = (surface_data, reference)
    sensitivities = [surface_data.sensitivity["octave_sensitivity"] for surface_data in both]
    amplitudes = [_octave_amplitudes(surface_data, octaves) for surface_data in both]
    contributions = np.mean(sensitivities, axis=0)[is_shown] * np.log(amplitudes[0] / amplitudes[1])
    is_known = np.isfinite(contributions)
    return octaves[is_known], contributions[is_known]


def _octave_amplitudes(surface_data: Datasets, octaves: Floats) -> Floats:
    """Return the rms heights (octave,) in nm of the waves of each octave of one surface."""
    spectrum = spectrum_of_dataset(surface_data.spectra)
    q = 2 * np.pi / octaves[:, None] * np.geomspace(0.5, 1, WAVEVECTORS_PER_OCTAVE)
    return np.asarray(np.sqrt(np.trapezoid(q * spectrum(q), q) / (2 * np.pi)))


def measured_numbers(fit: xr.Dataset, surface_data: Datasets) -> list[Number]:
    """Return a surface's measured force, and works that fit it, also on extrapolated roughness."""
    fit_at_range = fit.sel(rho_fine=fit.attrs["rho"], method="nearest")
    numbers = [
        number_of(fit, "measured_force", source="measured"),
        Number("measured_force_count", int(fit["force_count"].item())),
        Number("measured_force_sites", int(fit["site_count"].item())),
        Number("measured_force_looks_repeated", int(fit["look_repeated"].item())),
        number_of(fit_at_range, "work_by_range", name="measured_work", source="from_measured"),
    ]
    for side in differing_sides(fit):
        side_fit = fit.sel(side=side)
        name = f"extrapolated_work_{side}"
        numbers += [
            extrapolated_number(side_fit, "extrapolated_work", name, surface_data),
            number_of(side_fit, "transition", "nm", name=f"{name}_start"),
        ]
    return numbers


def fit_numbers(fit: xr.Dataset) -> list[Number]:
    """Return the ranges and works of adhesion that fit all measured forces, and how well."""
    rho = fit["rho_fine"].values
    agrees = np.isfinite(fit["region"].values).all(axis=-1)
    shortest, longest = fit["region_range"].values.tolist()
    weakest, strongest = fit["region_work"].values.tolist()
    region = number_without_value("fit_region_range", shortest, longest, "nm")
    if fit.sizes["surface"] == 1:
        region = region._replace(status=NoValue.ONE_FORCE)
    elif fit["work_by_range_interval"].isnull().any():
        region = region._replace(status=NumberStatus.NO_INTERVAL)
    elif not agrees.any():
        region = region._replace(status=NoValue.NO_AGREEMENT)
    nearest = np.abs(rho - fit.attrs["rho"]).argmin()
    return [
        Number("fit_best_range", fit["range_of_adhesion"].item(), "nm"),
        Number("fit_best_work", fit["work_of_adhesion"].item(), "J m-2"),
        Number("fit_best_error", fit["best_error"].item()),
        region,
        number_without_value("fit_region_work", weakest, strongest, "J m-2"),
        Number("fit_exact_pairs", int(fit["exact_pairs"].item())),
        _widest_gap(rho, agrees),
        Number("fit_range", fit.attrs["rho"], "nm"),
        Number("fit_agrees", int(agrees[nearest])),
    ]


def _widest_gap(rho: Floats, agrees: np.ndarray) -> Number:
    """Return the ranges (nm) beside the widest gap between ranges that agree, NaN without a gap."""
    indices = np.flatnonzero(agrees)
    steps = np.diff(indices)
    if not (steps > 1).any():
        return Number("fit_gap", np.nan, "nm")
    widest = steps.argmax()
    low, high = rho[indices[widest : widest + 2]].tolist()
    return number_without_value("fit_gap", low, high, "nm")
