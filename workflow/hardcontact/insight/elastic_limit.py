"""Which contacts yield, and the force of those that do not, from the slope of the gap.

Where bodies touch over an area A on which their gap has the rms slope h', the mean pressure of
elastic contact is E* h'/k. Of a smooth sphere k = 1.67, exactly: h' is a/(sqrt(2) R) on a disc of
radius a (Hertz). Of a rough flat k is 1.6 (Persson, J. Chem. Phys. 115 (2001) 3840) to 2.5 (Bush,
Gibson and Thomas, Wear 35 (1975) 87). The first is taken here. The elastic area is that of the
lowest gaps, as the bearing area is, on which E* h' A/k reaches the preload; h' depends on A.

The bearing area F/H takes every contact as plastic. Where the plasticity index of a contact is
below one, elastic contact carries the preload on a larger area at less than the hardness. Elastic
deformation recovers before pull-off: the force is then that of rigid bodies. With the larger area
flattened for good it is larger than that of the bearing area, an upper bound.

All this holds at the pixels at hand: shorter waves have higher slopes, and yield first.
"""

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
import pandas as pd
import xarray as xr
from numpy.typing import NDArray
from scipy.integrate import cumulative_trapezoid

from hardcontact.adhesion.all_surfaces import CONTACT_AXES, Described, Parts, with_names
from hardcontact.adhesion.pull_off import opened_total, pull_off_force
from hardcontact.adhesion.sphere_sums import outside_sums
from hardcontact.contact.bearing_area import LowestGaps, as_tiles, lowest_gaps
from hardcontact.contact.contact import Contact
from hardcontact.contact.geometry import Bodies, gaps_at
from hardcontact.numbers.statistics import student_interval, student_log_interval
from hardcontact.records.dataset import stack
from hardcontact.surfaces.spectrum import Floats, Spectrum

#: E* h' over the mean pressure of a smooth sphere: 3 pi/(4 sqrt(2)).
SLOPE_OVER_PRESSURE = 3 * np.pi / (4 * np.sqrt(2))
#: By how much the number of lowest gaps grows until they carry the preload.
GROWTH = 4

NEIGHBOURS = np.array([(0, 1), (0, -1), (1, 0), (-1, 0)])
#: Contact of the forces: all yield; what does not yield recovers; the larger of both areas is
#: flattened; all recover.
VARIANTS = ["bearing_area", "recovered", "larger_area", "rigid"]


class ElasticEstimate(NamedTuple):
    """Elastic contact beside the bearing area of one contact."""

    #: Mean pressure of elastic contact on the bearing area F/H, over the hardness H: from 1 on the
    #: bodies yield and the bearing area holds.
    plasticity_index: float
    contact: LowestGaps  #: The pixels of the larger of both areas.
    elastic_pixels: int  #: Of elastic contact, at most as many as the window has.


def squared_slopes(bodies: Bodies, position: NDArray[np.int_], offsets: NDArray[np.int_]) -> Floats:
    """Return the squared slope (k,) of the gap at offsets (k, 2) in pixels from an apex.

    Along each axis it is the mean of the squares of both one-sided slopes, which a pixel between
    two lower or two higher ones does not lose.
    """
    around = gaps_at(bodies, position, offsets[:, None] + NEIGHBOURS)
    rise = around - gaps_at(bodies, position, offsets)[:, None]
    return np.asarray((rise**2).sum(axis=1) / (2 * bodies.geometry.pixel_size**2))


def elastic_estimates(
    bodies: Bodies, load: Contact, modulus: float
) -> dict[tuple[int, int], ElasticEstimate]:
    """Return elastic contact, with E* in Pa, at every place (i, j) of an array of contacts."""
    geometry = bodies.geometry
    bearing = load.pixels(geometry.pixel_size)
    # Force in N that one pixel of unit slope carries.
    stiffness = modulus * (geometry.pixel_size * 1e-9) ** 2 / SLOPE_OVER_PRESSURE
    substrate = as_tiles(bodies.substrate)
    roughness = None if bodies.roughness is None else as_tiles(bodies.roughness)
    estimates = {}
    for place in np.ndindex(*[len(geometry.positions)] * 2):
        position, pixels = geometry.positions[list(place)], bearing
        carried = np.zeros(1)
        while carried[-1] < load.preload and pixels < geometry.window**2:
            pixels = min(GROWTH * pixels, geometry.window**2)
            contact = lowest_gaps(substrate, roughness, geometry, position, pixels)
            slopes = np.cumsum(squared_slopes(bodies, position, contact.offsets))
            carried = stiffness * np.sqrt(np.arange(1, pixels + 1) * slopes)
        elastic = min(int(np.searchsorted(carried, load.preload)) + 1, pixels)
        kept = max(bearing, elastic)
        of_bearing = modulus * np.sqrt(slopes[bearing - 1] / bearing) / SLOPE_OVER_PRESSURE
        estimates[place] = ElasticEstimate(
            float(of_bearing / load.hardness),
            LowestGaps(contact.gaps[:kept], contact.offsets[:kept]),
            elastic,
        )
    return estimates


def elastic_limit_of_pair(
    bodies: Bodies, load: Contact, modulus: float, rho: float, work_of_adhesion: float
) -> xr.Dataset:
    """Return the plasticity index, both areas and the pull-off force of every contact of a pair.

    The effective modulus E* is in Pa, rho, the range of adhesion, in nm and the work of adhesion in
    J/m². ``plasticity_index`` and ``elastic_area`` (nm2) are by contact_y and contact_x,
    ``pull_off_force`` (variant, contact_y, contact_x) in N; the attribute ``bearing_area`` in nm2.
    """
    pixel_size = bodies.geometry.pixel_size
    bearing = load.pixels(pixel_size)
    estimates = elastic_estimates(bodies, load, modulus)
    contacts = {place: one.contact for place, one in estimates.items()}
    (outside,) = outside_sums(bodies, contacts, [rho])
    totals = np.empty((len(VARIANTS), *outside.shape))
    index, pixels = np.empty(outside.shape), np.empty(outside.shape)
    for place, one in estimates.items():
        gaps = one.contact.gaps
        plastic, larger, rigid = (
            opened_total(outside[place], gaps, count, rho) for count in (bearing, len(gaps), 1)
        )
        index[place], pixels[place] = one.plasticity_index, one.elastic_pixels
        recovered = plastic if one.plasticity_index >= 1 else rigid
        totals[(slice(None), *place)] = plastic, recovered, larger, rigid
    numbers = np.arange(len(outside))
    force = pull_off_force(totals, rho, pixel_size, work_of_adhesion)
    return xr.Dataset(
        {
            "plasticity_index": (CONTACT_AXES, index, {"units": "1"}),
            "elastic_area": (CONTACT_AXES, pixels * pixel_size**2, {"units": "nm2"}),
            "pull_off_force": (("variant", *CONTACT_AXES), force, {"units": "N"}),
        },
        {"variant": VARIANTS, "contact_y": numbers, "contact_x": numbers},
        {
            "preload": load.preload,
            "hardness": load.hardness,
            "effective_modulus": modulus,
            "rho": rho,
            "work_of_adhesion": work_of_adhesion,
        }
        | {"bearing_area": bearing * pixel_size**2, "pixel_size": pixel_size},
    )


def slope_index(spectra: Mapping[str, Spectrum], modulus: float, hardness: float) -> xr.DataArray:
    """Return E* h'/(k H), h' the rms slope of all waves down to the shortest, from spectra.

    Over surface and shortest_wavelength (nm), rising; modulus and hardness are in Pa. It does not
    grow where a spectrum has no shorter waves. h'² = 1/(2 pi) ∫ q³ C_iso dq.
    """
    indices = []
    for spectrum in spectra.values():
        q = spectrum.wavevector
        squared = cumulative_trapezoid(q**4 * spectrum.density, np.log(q), initial=0) / (2 * np.pi)
        index = modulus * np.sqrt(squared) / (SLOPE_OVER_PRESSURE * hardness)
        wavelength = {"shortest_wavelength": 2 * np.pi / q}
        indices.append(xr.DataArray(index, wavelength, ["shortest_wavelength"]))
    named: xr.DataArray = xr.concat(indices, pd.Index(list(spectra), name="surface"))
    named["shortest_wavelength"].attrs = {"units": "nm"}
    return named.sortby("shortest_wavelength").assign_attrs(units="1")


def elastic_limit(
    pairs: Parts, elastic: xr.Dataset, described: Described, confidence: float
) -> xr.Dataset:
    """Return for which share of contacts the bearing area holds, and what it changes.

    The pairs are of `elastic_limit_of_pair` by (surface, scan); elastic.nc has some contacts of the
    same pairs whose elastic area was solved.

    With intervals, by surface: ``plastic_share`` of contacts with an index of one or more,
    ``solved_plastic_share`` of contacts with a solved mean pressure at or above the hardness,
    ``force_ratio`` (variant), mean force over that of the bearing area. Of every contact (surface,
    scan, contact_y, contact_x) ``plasticity_index`` and ``elastic_area``; of every solved one
    (surface, scan, contact) ``solved_area`` and ``estimated_area`` (nm2).
    """
    stacked = stack(pairs, ["surface", "scan"])
    index, force = stacked["plasticity_index"], stacked["pull_off_force"].mean(CONTACT_AXES)
    pressure = elastic["mean_pressure"]
    # The comparison of a scan that is missing would say that it does not hold.
    holds = (index >= 1).where(index.notnull()).mean(CONTACT_AXES)
    solved = (pressure >= elastic.attrs["hardness"]).where(pressure.notnull()).mean("contact")
    ratio = (force / force.sel(variant="bearing_area", drop=True)).assign_attrs(units="1")
    variables = {
        "force_ratio": ratio.mean("scan").assign_attrs(units="1"),
        "force_ratio_interval": student_log_interval(ratio, confidence, "scan"),
    }
    for name, share in {"plastic_share": holds, "solved_plastic_share": solved}.items():
        variables[name] = share.mean("scan").assign_attrs(units="1")
        interval = student_interval(share.assign_attrs(units="1"), confidence, "scan")
        variables[f"{name}_interval"] = interval.clip(0, 1, keep_attrs=True)
    summary = xr.Dataset(variables).merge(stacked[["plasticity_index", "elastic_area"]])
    summary = summary.merge(_at_solved_contacts(stacked["elastic_area"], elastic))
    return with_names(summary.assign_attrs(stacked.attrs, confidence=confidence), described)


def _at_solved_contacts(area: xr.DataArray, elastic: xr.Dataset) -> xr.Dataset:
    """Return the solved and the estimated elastic area (nm2) of contacts that were solved."""
    solved = elastic["contact_area"].reset_coords(drop=True)
    area = area.sel(surface=solved["surface"], scan=solved["scan"])
    places = {axis: elastic[axis].fillna(0).astype(int).variable for axis in CONTACT_AXES}
    estimated = area.isel(places).reset_coords(drop=True).where(solved.notnull())
    return xr.Dataset({"solved_area": solved, "estimated_area": estimated})
