"""The answer of a user's surface in short, from its numbers; templates put it into words."""

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from hardcontact.base.number import Number, NumberStatus
from hardcontact.inference.edges import EdgeStatus
from hardcontact.inference.scan_parts import IntervalSource
from hardcontact.report.own_surfaces.reliable_wavelengths import NEARLY_ALL
from hardcontact.report.quantities import OPEN_WORDS, NoValue
from hardcontact.surfaces.synthesis import SIDES


class Conclusion(NamedTuple):
    """The answer of one surface in short; printed intervals have both ends."""

    #: "yes" if both edges are found, edges and force come from wavelengths at which a scan is
    #: reliable, and no extrapolated force differs; "no" if none of the three comes from there, or
    #: if there is no band or too few patches are touched; otherwise "partly".
    answer: str
    #: "few_patches"; "none" if no resolved wavelength changes the force; "unknown" if a hindcast
    #: fails or the filter makes ripples; "overlapping" if the short edge is longer; or "found".
    band: str
    short_edge: Number
    long_edge: Number
    force: Number
    extrapolated: list[str]  #: Sides with a known force with extrapolated roughness.
    octave_body: str  #: Rougher body in the strongest octave: sphere, surface or both; or "".
    octave_is_certain: bool  #: Whether the interval of that octave's effect excludes none.
    few_summits: bool  #: Whether single summits carry the force; otherwise many points attract.


def surface_conclusion(numbers: Mapping[str, Number]) -> Conclusion:
    """Return the conclusion on one surface from its numbers by name."""
    short = _drop_partial_interval(numbers["short_edge"])
    long = _drop_partial_interval(numbers["long_edge"])
    force = _drop_partial_interval(numbers["mean_force"])
    sides = [side for side in SIDES if f"force_extrapolated_{side}" in numbers]
    sources = {short.source, long.source, numbers["mean_force_measured_share"].source}
    change = numbers.get("octave_1_sensitivity")
    band = _describe_band(short, long, numbers["mean_force"])
    if band in ("few_patches", "none") or sources == {"artificial"}:
        answer = "no"
    elif sources == {"measured"} and not sides and not short.status and not long.status:
        answer = "yes"
    else:
        answer = "partly"
    return Conclusion(
        answer=answer,
        band=band,
        short_edge=short,
        long_edge=long,
        force=force,
        extrapolated=[
            side for side in sides if np.isfinite(numbers[f"force_extrapolated_{side}"].value)
        ],
        octave_body=_octave_body(numbers),
        octave_is_certain=change is None or not change.low <= 0 <= change.high,
        few_summits=numbers["weibull_modulus"].value < 1,
    )


def _describe_band(short: Number, long: Number, force: Number) -> str:
    """Return what is known of the band of one surface, as `Conclusion.band`."""
    if force.status == IntervalSource.FEW_PATCHES:
        return "few_patches"
    if short.status == NoValue.NO_BAND:
        return "none"
    if {NoValue.NO_HINDCAST, EdgeStatus.RIPPLES} & {short.status, long.status}:
        return "unknown"
    return "overlapping" if short.value >= long.value else "found"


def _octave_body(numbers: Mapping[str, Number]) -> str:
    """Return which body has the waves that change the force most, as `Conclusion.octave_body`."""
    if "octave_1_sphere_share" not in numbers:
        return ""
    share = numbers["octave_1_sphere_share"].value
    return "sphere" if share > NEARLY_ALL else "surface" if share < 1 - NEARLY_ALL else "both"


def _drop_partial_interval(number: Number) -> Number:
    """Return a number without its interval if only one end of it is known."""
    is_whole = np.isfinite([number.low, number.high]).all() or np.isnan(number.value)
    status = number.status if number.status in OPEN_WORDS else NumberStatus.PLAIN
    return number if is_whole else number._replace(low=np.nan, high=np.nan, status=status)
