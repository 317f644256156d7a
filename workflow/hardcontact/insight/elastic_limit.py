"""Where the bearing area is wrong: contacts that do not yield, and the force they would have.

The bearing area F/H takes every contact as plastic. Where the plasticity index of a contact is
below one, elastic contact carries the preload on a larger area at less than the hardness. Its force
is bracketed: with the larger area flattened for good it is larger than that of the bearing area,
with all deformation recovered before pull-off it is that of rigid bodies.
"""

from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr

from hardcontact.adhesion.force_sum import opened_total, pull_off_force
from hardcontact.adhesion.named_surfaces import Described, with_names
from hardcontact.adhesion.sphere_sums import outside_sums
from hardcontact.contact.bearing_area import Load, contact_pixel_count
from hardcontact.contact.geometry import Bodies
from hardcontact.contact.plasticity_index import elastic_estimates
from hardcontact.records.dataset import stack
from hardcontact.statistics import student_interval, student_log_interval

__all__ = ["VARIANTS", "elastic_limit", "elastic_limit_of_pair"]

#: Contact of the forces: all yield; the larger of both areas is flattened; what does not yield
#: recovers; all recover.
VARIANTS = ["bearing_area", "larger_area", "recovered", "rigid"]


def elastic_limit_of_pair(
    bodies: Bodies, load: Load, modulus: float, rho: float, work_of_adhesion: float
) -> xr.Dataset:
    """Return the plasticity index, both areas and the pull-off force of every contact.

    Parameters
    ----------
    bodies : Bodies
        One pair of scans with its array of contacts.
    load : Load
        Preload and hardness.
    modulus : float
        Effective modulus E* in Pa.
    rho : float
        Range of adhesion in nm.
    work_of_adhesion : float
        In J/m².

    Returns
    -------
    xarray.Dataset
        ``plasticity_index`` (1), ``elastic_area`` (nm2), both by contact_y and contact_x, and
        ``pull_off_force`` (variant, contact_y, contact_x) in N; attribute ``bearing_area`` in nm2.
    """
    pixel_size = bodies.geometry.pixel_size
    estimates = elastic_estimates(bodies, load, modulus)
    contacts = {place: one.contact for place, one in estimates.items()}
    (outside,) = outside_sums(bodies, contacts, [rho])
    bearing = contact_pixel_count(load, pixel_size)
    totals = np.empty((len(VARIANTS), *outside.shape))
    index, pixels = np.empty(outside.shape), np.empty(outside.shape)
    for place, one in estimates.items():
        plastic, larger, rigid = (
            opened_total(outside[place], one.contact.gaps, count, rho)
            for count in (bearing, len(one.contact.gaps), 1)
        )
        index[place], pixels[place] = one.plasticity_index, one.elastic_pixels
        recovered = plastic if one.plasticity_index >= 1 else rigid
        totals[(slice(None), *place)] = plastic, larger, recovered, rigid
    contact_yx, numbers = ("contact_y", "contact_x"), np.arange(len(outside))
    force = pull_off_force(totals, rho, pixel_size, work_of_adhesion)
    return xr.Dataset(
        {
            "plasticity_index": (contact_yx, index, {"units": "1"}),
            "elastic_area": (contact_yx, pixels * pixel_size**2, {"units": "nm2"}),
            "pull_off_force": (("variant", *contact_yx), force, {"units": "N"}),
        },
        {"variant": VARIANTS, "contact_y": numbers, "contact_x": numbers},
        {**load, "effective_modulus": modulus, "rho": rho, "work_of_adhesion": work_of_adhesion}
        | {"bearing_area": bearing * pixel_size**2},
    )


def elastic_limit(
    pairs: Mapping[tuple[Any, ...], xr.Dataset],
    elastic: xr.Dataset,
    described: Described,
    confidence: float,
) -> xr.Dataset:
    """Return for which share of contacts the bearing area holds, and what it changes.

    Parameters
    ----------
    pairs : mapping of tuple to xarray.Dataset
        (surface, scan) -> `elastic_limit_of_pair`.
    elastic : xarray.Dataset
        elastic.nc, of the same pairs: some contacts whose elastic area was solved.
    described : Described
        Label and basis of each surface.
    confidence : float
        Of the intervals, by Student's t over scans, those of shares cut at 0 and 1.

    Returns
    -------
    xarray.Dataset
        With intervals, by surface: ``plastic_share`` of contacts with an index of one or more,
        ``solved_plastic_share`` of contacts with a solved mean pressure at or above the hardness,
        ``force_ratio`` (variant), mean force over that of the bearing area. Of every contact
        (surface, scan, contact_y, contact_x) ``plasticity_index`` and ``elastic_area``; of every
        solved one (surface, scan, contact) ``solved_area`` and ``estimated_area`` (nm2).
    """
    stacked = stack(pairs, ["surface", "scan"])
    over = ["contact_y", "contact_x"]
    index = stacked["plasticity_index"]
    # The comparison of a scan that is missing would say that it does not hold.
    holds = (index >= 1).where(index.notnull()).mean(over)
    pressure = elastic["mean_pressure"]
    solved = (pressure >= elastic.attrs["hardness"]).where(pressure.notnull()).mean("contact")
    force = stacked["pull_off_force"].mean(over)
    ratio = force / force.sel(variant="bearing_area", drop=True)
    shares = {"plastic_share": holds, "solved_plastic_share": solved}
    variables = {
        "force_ratio": ratio.mean("scan").assign_attrs(units="1"),
        "force_ratio_interval": student_log_interval(ratio, confidence, "scan"),
    }
    for name, share in shares.items():
        variables[name] = share.mean("scan").assign_attrs(units="1")
        interval = student_interval(share, confidence, "scan")
        variables[f"{name}_interval"] = interval.clip(0, 1, keep_attrs=True)
    summary = xr.Dataset(variables).merge(stacked[["plasticity_index", "elastic_area"]])
    summary = summary.merge(_at_solved_contacts(stacked["elastic_area"], elastic))
    return with_names(summary.assign_attrs(stacked.attrs, confidence=confidence), described)


def _at_solved_contacts(area: xr.DataArray, elastic: xr.Dataset) -> xr.Dataset:
    """Return the solved and the estimated elastic area (nm2) of contacts that were solved."""
    solved = elastic["contact_area"].reset_coords(drop=True)
    area = area.sel(surface=solved["surface"], scan=solved["scan"])
    places = {
        axis: elastic[axis].fillna(0).astype(int).variable for axis in ("contact_y", "contact_x")
    }
    places |= {axis: xr.Variable(axis, np.arange(area.sizes[axis])) for axis in ("surface", "scan")}
    estimated = area.isel(places).reset_coords(drop=True).where(solved.notnull())
    return xr.Dataset({"solved_area": solved, "estimated_area": estimated})
