"""The pull-off force that a work and a range of adhesion predict: no fit is needed."""

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
import xarray as xr

from hardcontact.numbers.statistics import with_interval
from hardcontact.own_surfaces.scan_parts import (
    Parts,
    half_width_of_logarithm,
    logarithmic_interval,
    parts_of_scans,
    quarters_of_contacts,
)
from hardcontact.records.dataset import stack

__all__ = ["ScanForces", "forces_of_scans", "predicted_force"]

CONTACTS = ["contact_y", "contact_x"]

#: Of the forces of single contacts.
QUANTILES = [0.05, 0.25, 0.5, 0.75, 0.95]


class ScanForces(NamedTuple):
    """Mean forces of one surface, over scans, scans of the sphere and contacts."""

    mean: np.ndarray  #: (rho,) in N, at the work of adhesion of the forces given.
    left_out: np.ndarray  #: (part, rho) logarithms of the mean of all parts but one.
    parts: list[Parts]  #: (rho,) they correlate the more the longer the range.


def forces_of_scans(forces: xr.DataArray, size: float, radius: float) -> ScanForces:
    """Return the mean forces of one surface and contact model, and those without each part.

    Forces (scan, sphere_scan, rho, contact_y, contact_x) in N are at any work of adhesion, NaN
    where a scan is missing; `size` is the edge of a scan, `radius` that of the sphere, in nm. Parts
    are scans where there are three, otherwise their quarters.
    """
    of_scans = forces.dropna("scan", how="all").mean("sphere_scan")
    of_scans = of_scans.transpose("scan", "rho", *CONTACTS)
    scans = np.arange(of_scans.sizes["scan"])
    quarters = quarters_of_contacts(of_scans.sizes["contact_y"], 1)
    parts = [
        parts_of_scans(scans, quarters, size, float(np.sqrt(radius * rho)))
        for rho in of_scans.rho.values
    ]
    left_out = []
    for part in range(len(parts[0].correlation)):
        kept = xr.DataArray(parts[0].of_contact != part, dims=("scan", *CONTACTS))
        left_out.append(np.log(of_scans.where(kept).mean(CONTACTS).mean("scan").values))
    mean = of_scans.mean(CONTACTS).mean("scan").values
    return ScanForces(mean, np.array(left_out), parts)


def predicted_force(
    adhesion: xr.Dataset, *, work: float, rho: float, sizes: Mapping[str, float], confidence: float
) -> xr.Dataset:
    """Return the pull-off force of every surface at one work of adhesion and all ranges.

    Parameters
    ----------
    adhesion : xarray.Dataset
        All pull-off forces at 1 J/m², as in adhesion.nc.
    work, rho : float
        Of adhesion in J/m², and the range of adhesion in nm, one of those computed.
    sizes : mapping of str to float
        Edge of the scans of each surface in nm.
    confidence : float
        Of the intervals.

    Returns
    -------
    xarray.Dataset
        Over surface, contact_model and rho in N: ``force``, the mean over contacts and scans, with
        its interval by Student's t on logarithms, over scans or quarters of one or two, from zero
        to infinity where it is not bounded; and ``force_quantile`` of single contacts over
        `quantile`. Over surface ``conditional`` (1 of quarters), ``interval_note``,
        ``correlation_of_parts`` at the range asked for, label and basis. The range asked for is the
        attribute ``range_of_adhesion``.

    Raises
    ------
    ValueError
        If the range was not computed.
    """
    ranges = adhesion.rho.values
    if not np.isclose(ranges, rho, rtol=1e-9).any():
        raise ValueError(
            f"expected a range of adhesion that was computed ({', '.join(f'{r:g}' for r in ranges)}"
            f" nm), found {rho:g} nm"
        )
    surfaces = stack(
        {
            (str(surface),): _of_surface(
                adhesion.sel(surface=surface), sizes[str(surface)], work, rho, confidence
            )
            for surface in adhesion.surface.values
        },
        ["surface"],
    )
    return surfaces.assign(label=adhesion.label, basis=adhesion.basis).assign_attrs(
        work_of_adhesion=work,
        range_of_adhesion=rho,
        confidence=confidence,
        sphere_radius=adhesion.attrs["sphere_radius"],
    )


def _of_surface(
    adhesion: xr.Dataset, size: float, work: float, rho: float, confidence: float
) -> xr.Dataset:
    """Return the variables of one surface."""
    radius = float(adhesion.attrs["sphere_radius"])
    forces = adhesion.pull_off_force * work
    models = [
        forces_of_scans(forces.sel(contact_model=model), size, radius)
        for model in forces.contact_model.values
    ]
    mean = np.array([scans.mean for scans in models])
    half = np.array(
        [
            [
                half_width_of_logarithm(left_out, parts, confidence)
                for left_out, parts in zip(scans.left_out.T, scans.parts, strict=True)
            ]
            for scans in models
        ]
    )
    interval = logarithmic_interval(mean, half)
    quantiles = forces.quantile(QUANTILES, ["scan", "sphere_scan", *CONTACTS]).transpose(
        "contact_model", "rho", "quantile"
    )
    parts = models[0].parts[int(np.abs(adhesion.rho.values - rho).argmin())]
    newton, dimensions = {"units": "N"}, ("contact_model", "rho")
    return xr.Dataset(
        with_interval("force", dimensions, mean, interval, newton, confidence)
        | {
            "force_quantile": ((*dimensions, "quantile"), quantiles.values, newton),
            "conditional": int(parts.conditional),
            "interval_note": parts.note(),
            "correlation_of_parts": ((), parts.shared, {"units": "1"}),
        },
        {name: adhesion[name] for name in dimensions} | {"quantile": QUANTILES},
    )
