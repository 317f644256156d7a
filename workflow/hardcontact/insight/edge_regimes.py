"""Which regime a surface is in, from its spectrum: what sets the force and both edges of the band.

Three comparisons of lengths, all of the closed form (`closed_form`) at one sphere, range and load:

- sigma/rho against m/sigma: the attraction comes from many points, or is frozen to single peaks.
- The diameter 2 sqrt(F/(pi H)) of the contact against the short edge. The closed form knows the
  range of adhesion, but not that a contact flattens what is smaller than itself. If the longer of
  both set the edge, this would follow the contact alone where that is wider, otherwise the range
  alone; exponents of computed edges say how far that holds (`cause_exponents`).
- The reach sqrt(2 R rho) of the attraction against the roll-off of the spectrum. Roughness much
  longer than the reach lifts sphere and attraction alike, and far beyond the roll-off there is
  none: if one length stops the long edge, it is the shorter of the two. Neither is a sharp end: at
  the reach the attraction of a smooth sphere has fallen to 1/e, and the roll-off is the middle of
  an octave. Whether the edge stops there is for computed edges to say.
"""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
import xarray as xr

from hardcontact.insight.closed_form import Contact, closed_form, edges
from hardcontact.insight.edge_scaling import LENGTHS
from hardcontact.numbers.statistics import jackknife_interval, with_interval
from hardcontact.surfaces.spectrum import Spectrum, roll_off
from hardcontact.surfaces.synthesis import SIDES

#: The longer of two lengths that may set the short edge.
CONTACT, RANGE = "contact", "range"
#: The shorter of two lengths that may stop the long edge.
ROLL_OFF, REACH = "roll-off", "reach"


def edge_regimes(spectra: Mapping[str, Spectrum], contact: Contact, tolerance: float) -> xr.Dataset:
    """Return the regime of every surface, and the lengths that decide it.

    The tolerance is the relative change of the force that counts. Over surface, lengths in nm:
    ``rough_height`` (sigma), ``approach`` (m), ``freezing``, (sigma/rho)/(m/sigma), ``regime`` of
    `closed_form`, ``predicted_edge`` (surface, side), NaN where there is none, ``short_edge_from``,
    empty there, and ``long_edge_from``, ROLL_OFF or REACH, the shorter of both. Of all:
    ``contact_diameter`` and ``attraction_reach``.
    """
    diameter = 2 * np.sqrt(contact.area / np.pi)
    reach = np.sqrt(2 * contact.radius * contact.rho)
    forms = [closed_form(one, contact) for one in spectra.values()]
    predicted = np.array([edges(one, contact, tolerance) for one in spectra.values()])
    short = np.select([np.isnan(predicted[:, 0]), predicted[:, 0] < diameter], ["", CONTACT], RANGE)
    ends = np.array([roll_off(one) for one in spectra.values()])
    nm, one = {"units": "nm"}, {"units": "1"}
    return xr.Dataset(
        {
            "rough_height": ("surface", [form.rms_height for form in forms], nm),
            "approach": ("surface", [form.closest_approach for form in forms], nm),
            "freezing": ("surface", [form.freezing for form in forms], one),
            "regime": ("surface", [form.regime for form in forms]),
            "predicted_edge": (("surface", "side"), predicted, nm),
            "short_edge_from": ("surface", short),
            "long_edge_from": ("surface", np.where(reach < ends, REACH, ROLL_OFF)),
            "contact_diameter": ((), diameter, nm),
            "attraction_reach": ((), reach, nm),
        },
        {"surface": list(spectra), "side": list(SIDES)},
    )


def cause_exponents(
    scaling: xr.Dataset, spectra: Mapping[str, Spectrum], contact: Contact, tolerance: float
) -> xr.Dataset:
    """Return how the short edge scales where the contact should set it, and where the range should.

    `scaling` is of `edge_scaling.edge_scaling`: ``edge`` (side, surface, radius, area, rho),
    ``contact_area`` (side, area) and the attribute ``confidence``. The closed form gives the short
    edge for the sphere and area of `contact` at every range of `scaling`; the tolerance is the
    relative change of the force that counts.

    By cause, CONTACT where its diameter exceeds that edge and RANGE where it does not:
    ``cause_exponent`` (cause, length) by least squares of ln(edge) against the logarithms of
    LENGTHS, with a constant for each surface and an interval by the jackknife over surfaces, and
    ``cause_edges`` (cause), their number. NaN where too few edges tell the lengths apart.
    """
    small = scaling[["edge", "contact_area"]].sel(side="small", drop=True)
    predicted = [
        [edges(one, replace(contact, rho=rho), tolerance)[0] for rho in small["rho"].values]
        for one in spectra.values()
    ]
    short = xr.DataArray(predicted, {"surface": list(spectra), "rho": small["rho"].values})
    diameter: xr.DataArray = 2 * (small["contact_area"] / np.pi) ** 0.5
    logarithms: xr.DataArray = xr.apply_ufunc(np.log, small["edge"])
    parts = [logarithms.where(taken) for taken in (diameter > short, diameter <= short)]
    confidence = scaling.attrs["confidence"]
    lengths = [small["radius"], small["rho"], small["contact_area"]]
    values, intervals = zip(
        *(_bounded_exponents(one, lengths, confidence) for one in parts), strict=True
    )
    attributes = {"units": "1", "long_name": "exponent of the short edge"}
    return xr.Dataset(
        with_interval(
            "cause_exponent",
            ["cause", "length"],
            np.array(values),
            np.array(intervals),
            attributes,
            confidence,
        )
        | {"cause_edges": ("cause", [int(one.notnull().sum()) for one in parts])},
        {"cause": [CONTACT, RANGE], "length": LENGTHS},
    )


def _bounded_exponents(
    logarithms: xr.DataArray, lengths: list[xr.DataArray], confidence: float
) -> tuple[np.ndarray, np.ndarray]:
    """Return exponents (3,) and their intervals (3, 2), NaN of fewer than three surfaces."""
    known = logarithms.dropna("surface", how="all")
    value, count = _exponents(known, lengths), known.sizes["surface"]
    if count < 3:
        return value, np.full((len(value), 2), np.nan)
    left_out = [_exponents(known.drop_isel(surface=one), lengths) for one in range(count)]
    # The jackknife of a positive number is Student's t of its logarithm, here the exponent.
    interval = jackknife_interval(np.exp(value), np.exp(left_out), confidence)
    return value, np.log(interval)


def _exponents(logarithms: xr.DataArray, lengths: list[xr.DataArray]) -> np.ndarray:
    """Return slopes (3,) of values (surface, ...) against ln(length)/2 within surfaces."""
    parts = []
    roots = [xr.apply_ufunc(np.log, length) / 2 for length in lengths]
    for one in (logarithms, *roots):
        known = one.broadcast_like(logarithms).where(logarithms.notnull())
        parts.append(known - known.mean([dim for dim in known.dims if dim != "surface"]))
    values, *design = (part.transpose(*logarithms.dims).values.ravel() for part in parts)
    kept = np.isfinite(values)
    matrix: np.ndarray = np.stack(design, axis=-1)[kept]
    if len(matrix) <= len(lengths) or np.linalg.matrix_rank(matrix) < len(lengths):
        return np.full(len(lengths), np.nan)
    return np.asarray(np.linalg.lstsq(matrix, values[kept])[0])
