"""Where the closed form is validated, and its errors, from a table of designed surfaces.

Errors are the ratios of computed to predicted values. Only surfaces that were held out count: no
formula was developed on them, except two choices (workflow/report/theory.md, Close points).
"""

import math
from collections.abc import Iterator, Mapping
from enum import StrEnum
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from hardcontact.base.number import Number
from hardcontact.contact.contact import Contact
from hardcontact.inference.edges import EDGE_NAMES, EdgeStatus
from hardcontact.surfaces.spectrum import Spectrum, peak_wavelength
from hardcontact.theory.closed_form import ClosedForm

#: Designed surfaces, computed and predicted; resources/validation/README.md describes the columns.
DESIGNED_SURFACES = Path(__file__).with_name("designed_surfaces.csv")
#: Number n of nearest surfaces whose ratios count. Another ratio lies between the smallest and the
#: largest with the probability (n - 1)/(n + 1), 0.9.
NEAREST_SURFACES = 19
#: Smaller moduli count as this one: below the mean plane the modulus is 0 and has no logarithm.
MIN_WEIBULL_MODULUS = 1e-3
#: Columns of the table with computed quantities; ``predicted_...`` has each predicted quantity.
VALIDATED_QUANTITIES = ("force", *EDGE_NAMES.values())
#: Parameters that must lie within the ranges of the table, with their units.
VALIDATED_PARAMETERS = {
    "rho": "nm", "radius": "nm", "weibull_modulus": "1", "contact_over_peak_wavelength": "1",
    "mean_hurst": "1", "mean_hurst_change": "1",
}  # fmt: skip
#: Points of a spectrum to which a Hurst exponent and its change are fitted.
FITTED_POINTS = 40


class Validity(StrEnum):
    """Whether the closed form is validated for an input, so that its error is known.

    STEEP_SIDEWALLS: no force is predicted, because steep sidewalls are far from Gaussian.
    """

    INSIDE, OUTSIDE, STEEP_SIDEWALLS = "inside", "outside", "steep_sidewalls"


@cache
def held_out_surfaces() -> pd.DataFrame:
    """Return the held-out DESIGNED_SURFACES, with ratios of computed to predicted values.

    Ratios of edges that were not found are NaN.
    """
    table = pd.read_csv(DESIGNED_SURFACES)
    held_out = table[table["held_out"] == 1].copy()
    for name in VALIDATED_QUANTITIES:
        ratio = held_out[name] / held_out[f"predicted_{name}"]
        if f"{name}_status" in held_out:
            ratio = ratio.where(held_out[f"{name}_status"] == EdgeStatus.FOUND)
        held_out[f"{name}_ratio"] = ratio
    return held_out


def table_point(spectrum: Spectrum, contact: Contact, form: ClosedForm) -> dict[str, Any]:
    """Return the validated parameters and the regime of a spectrum, which must not end in zeros."""
    mean_hurst, mean_hurst_change = mean_hurst_and_change(spectrum, math.sqrt(contact.area))
    return {
        "rho": contact.rho,
        "radius": contact.radius,
        "weibull_modulus": form.weibull_modulus,
        "contact_over_peak_wavelength": math.sqrt(contact.area) / peak_wavelength(spectrum),
        "mean_hurst": mean_hurst,
        "mean_hurst_change": mean_hurst_change,
        "regime": form.regime,
    }


def mean_hurst_and_change(spectrum: Spectrum, contact_length: float) -> tuple[float, float]:
    """Return the mean Hurst exponent of a spectrum, and its change per decade of wavevector.

    A parabola is fitted to log10 C_iso from the peak wavelength to the longer of contact and
    shortest wave. With x for the decades of q from the middle of this range,

        log10 C_iso = curvature x² + slope x + constant.

    In the middle the slope is -2 - 2H, and per decade it changes by 2 curvature = -2H'. NaN if the
    contact is longer than the peak wavelength.
    """
    lowest, highest = 2 * np.pi / peak_wavelength(spectrum), spectrum.wavevector[-1]
    decades = math.log10(min(highest, 2 * np.pi / contact_length) / lowest)
    if decades <= 0:
        return math.nan, math.nan
    log_wavevectors = np.linspace(-decades / 2, decades / 2, FITTED_POINTS)
    density = spectrum(np.minimum(lowest * 10 ** (log_wavevectors + decades / 2), highest))
    curvature, slope, _ = np.polyfit(log_wavevectors, np.log10(density), 2)
    return float(-1 - slope / 2), float(-curvature)


def nearest_ratios(point: Mapping[str, Any], name: str) -> tuple[float, float]:
    """Return the smallest and the largest ratio of computed to predicted values near a point.

    They are those of the NEAREST_SURFACES in the table. The distance to a surface is that of the
    logarithms of two parameters, `axes`, so that a factor e counts as one. Another regime adds one.
    A point outside the table is first moved to its border.
    """
    surfaces = held_out_surfaces().dropna(subset=f"{name}_ratio")
    axes = ["weibull_modulus", "contact_over_peak_wavelength"]
    points = np.maximum(surfaces[axes].to_numpy(), MIN_WEIBULL_MODULUS)
    clipped_point = np.clip([point[axis] for axis in axes], points.min(axis=0), points.max(axis=0))
    log_distances = np.log(points / clipped_point)
    distance = np.hypot(*log_distances.T) + (surfaces["regime"] != point["regime"]).to_numpy()
    ratios = surfaces[f"{name}_ratio"].iloc[np.argsort(distance)[:NEAREST_SURFACES]]
    return float(ratios.min()), float(ratios.max())


def is_validated(point: Mapping[str, Any]) -> bool:
    """Return True if the table covers a point, so that the error of the closed form is known."""
    return all(number.status == Validity.INSIDE for number in validated_limits(point))


def validated_limits(point: Mapping[str, Any]) -> Iterator[Number]:
    """Yield the validated parameters of a point, with their limits in the table."""
    for name, unit in VALIDATED_PARAMETERS.items():
        lowest, highest = held_out_surfaces()[name].agg(["min", "max"])
        status = Validity.INSIDE if lowest <= point[name] <= highest else Validity.OUTSIDE
        yield Number(f"validated_{name}", point[name], unit, lowest, highest, status)
