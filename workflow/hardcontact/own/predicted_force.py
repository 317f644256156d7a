"""The pull-off forces that a work and a range of adhesion predict, without a fit: force.nc.

They are those on the scans, and those with roughness continued beyond the wavelengths of the scans.
"""

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
import xarray as xr

from hardcontact.base.dataset import stack
from hardcontact.base.statistics import bounds, with_interval
from hardcontact.contact.contact import Contact
from hardcontact.contact.finite_scan import with_sizes
from hardcontact.contact.smooth_sphere import assumed_modulus
from hardcontact.own.master_forces import (
    MasterForces,
    Masters,
    half_width_over_masters,
    over_masters,
)
from hardcontact.own.scan_parts import (
    CONTACTS,
    Parts,
    half_width,
    jackknife_variance,
    left_out_logarithms,
    logarithmic_interval,
    parts_of_scans,
    quarters_of_contacts,
)
from hardcontact.surfaces.spectrum import spectrum_from
from hardcontact.theory.edge_scaling import regime_coordinates
from hardcontact.theory.prediction import tabor
from hardcontact.theory.pull_off_statistics import force_scatter
from hardcontact.theory.summits import draw_size

#: The contact model of the filtered masters.
PLASTIC = "plastic"
#: Of the forces of single contacts.
QUANTILES = [0.05, 0.25, 0.5, 0.75, 0.95]
NEWTON = {"units": "N"}


def own_force(
    adhesion: xr.Dataset,
    scales: xr.Dataset,
    topography: xr.Dataset,
    spectra: xr.Dataset,
    *,
    contact: Contact,
    masters: Masters,
    tolerance: float,
    confidence: float,
) -> xr.Dataset:
    """Return the predicted forces of all surfaces, their limits and their scatter.

    Datasets are as in the files of these names. The contact that is asked for has the radius of the
    sphere, range, work, load and window; the tolerance is the relative
    change of the force that counts as none.

    Returns, over surface, the forces on the scans (`predicted_force`) and with continued roughness
    (`continued_force`), never above that of a smooth sphere; whether scans, windows and pixels are
    large or small enough (`finite_scan`); the scatter of single forces (`force_scatter`); and the
    place among the regimes (`regime_coordinates`). Attributes hold the Tabor parameter, and whether
    it says that the bodies are hard (`tabor`).
    """
    force = predicted_force(
        adhesion,
        work=contact.work,
        rho=contact.range,
        sizes={str(name): size for name, size in topography["scan_size"].to_series().items()},
        confidence=confidence,
    )
    continued = continued_force(scales, masters, contact.work, confidence)
    force = with_continued_force(force, continued, tolerance)
    force = with_smooth_bound(force, contact.area)
    joined = {
        name: spectrum_from(spectra.sel(surface=name)) for name in force["surface"].values.tolist()
    }
    draw_sizes = {
        name: draw_size(spectrum, contact.radius, contact.area) for name, spectrum in joined.items()
    }
    force = with_sizes(force, topography, contact, draw_sizes)
    scatter = force_scatter(
        joined,
        contact,
        [contact.range],
        dict.fromkeys(joined, 0.0),  # the scatter over the places of one scan
        tolerance=tolerance,
        confidence=confidence,
    ).squeeze("rho", drop=True)
    force = force.merge(scatter[["modulus", "spread", "contacts_needed"]])
    stiffness = tabor(contact, assumed_modulus(contact.hardness))
    return force.merge(regime_coordinates(joined, contact)).assign_attrs(
        tabor_parameter=stiffness.value, bodies=stiffness.status
    )


class ScanForces(NamedTuple):
    """Mean forces of one surface, over scans, scans of the sphere and contacts."""

    mean: np.ndarray  #: (rho,) in N, at the work of adhesion of the forces given.
    left_out: np.ndarray  #: (part, rho) logarithms of the mean of all parts but one.
    parts: list[Parts]  #: (rho,) they correlate the more the longer the range.


def fewest_places(adhesion: xr.Dataset) -> dict[str, float]:
    """Return the fewest places that the contacts on a scan touch, by surface.

    Of several scans of the sphere, that one counts with which they touch the most.
    """
    places = adhesion.touched_places.max("sphere_scan").min("scan")
    return {str(surface): float(places.sel(surface=surface)) for surface in places.surface.values}


def forces_of_scans(forces: xr.DataArray, size: float, radius: float, places: float) -> ScanForces:
    """Return the mean forces of one surface and contact model, and those without each part.

    Forces (scan, sphere_scan, rho, contact_y, contact_x) are in N, NaN where a scan is missing;
    `size` is the edge of a scan, `radius` that of the sphere, in nm; `places` are those of
    `fewest_places`.
    """
    scan_forces = forces.dropna("scan", how="all").mean("sphere_scan")
    scan_forces = scan_forces.transpose("scan", "rho", *CONTACTS)
    scans = np.arange(scan_forces.sizes["scan"])
    quarters = quarters_of_contacts(scan_forces.sizes["contact_y"], 1)
    parts = [
        parts_of_scans(scans, quarters, size, float(np.sqrt(radius * rho)), places)
        for rho in scan_forces.rho.values
    ]
    left_out = left_out_logarithms(
        parts[0], "scan", lambda kept: scan_forces.where(kept).mean(CONTACTS).mean("scan")
    )
    return ScanForces(scan_forces.mean(CONTACTS).mean("scan").values, left_out, parts)


def predicted_force(
    adhesion: xr.Dataset, *, work: float, rho: float, sizes: Mapping[str, float], confidence: float
) -> xr.Dataset:
    """Return the pull-off force of every surface at one work of adhesion and all ranges.

    Forces are at 1 J/m², as in adhesion.nc; the work is in J/m², the range of adhesion and the
    edges of the scans of each surface in nm. Raises ValueError if the range was not computed.

    Over surface, contact_model and rho in N are ``force``, the mean over contacts and scans, with
    its interval by Student's t on logarithms, over scans or quarters of one or two, from zero to
    infinity where it is not bounded; and ``force_quantile`` of single contacts over `quantile`.
    Over surface are ``conditional`` (1 for quarters), ``interval_source``, ``interval_scans``,
    ``contacts`` on a scan, ``touched_places`` of `fewest_places`, label, basis and
    ``correlation_of_parts`` at the range asked for, the attribute ``range_of_adhesion``.
    """
    ranges = adhesion.rho.values
    if not np.isclose(ranges, rho, rtol=1e-9).any():
        raise ValueError(
            f"expected a range of adhesion that was computed ({', '.join(f'{r:g}' for r in ranges)}"
            f" nm), found {rho:g} nm"
        )
    places = fewest_places(adhesion)
    surfaces = {
        (surface,): _surface_force(
            adhesion.sel(surface=surface), sizes[surface], places[surface], work, rho, confidence
        )
        for surface in adhesion.surface.values.tolist()
    }
    force = stack(surfaces, ["surface"])
    return force.assign(label=adhesion.label, basis=adhesion.basis).assign_attrs(
        work_of_adhesion=work,
        range_of_adhesion=rho,
        confidence=confidence,
        sphere_radius=adhesion.attrs["sphere_radius"],
    )


def _surface_force(
    adhesion: xr.Dataset, size: float, places: float, work: float, rho: float, confidence: float
) -> xr.Dataset:
    """Return the variables of one surface."""
    radius = float(adhesion.attrs["sphere_radius"])
    forces = adhesion.pull_off_force * work
    models = [
        forces_of_scans(forces.sel(contact_model=model), size, radius, places)
        for model in forces.contact_model.values
    ]
    mean = np.array([scans.mean for scans in models])
    half = np.array(
        [
            [
                half_width([jackknife_variance(left_out, parts)], confidence)
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
    dimensions = ("contact_model", "rho")
    return xr.Dataset(
        with_interval("force", dimensions, mean, interval, NEWTON, confidence)
        | {
            "force_quantile": ((*dimensions, "quantile"), quantiles.values, NEWTON),
            "conditional": int(parts.conditional),
            "interval_source": parts.source,
            "interval_scans": parts.scans,
            "contacts": ((), np.prod([adhesion.sizes[axis] for axis in CONTACTS]), {"units": "1"}),
            "touched_places": ((), places, {"units": "1"}),
            "correlation_of_parts": ((), parts.shared, {"units": "1"}),
        },
        {name: adhesion[name] for name in dimensions} | {"quantile": QUANTILES},
    )


def continued_force(
    scales: xr.Dataset, masters: Masters, work: float, confidence: float
) -> xr.Dataset:
    """Return the mean force on masters with all their roughness, in plastic contact.

    `scales` has the forces of the masters at 1 J/m², as in scales.nc; the work of adhesion is in
    J/m². Over surface and side stand ``continued_force`` in N with its interval, from the same
    parts and realizations as the edges of the band, ``continued_source``, what that comes from, and
    ``continued_end`` in nm, the last wavelength: the shortest or the longest. Over side
    ``transition`` in nm, from which on the roughness is that of the spectrum.
    """
    attributes = NEWTON | {"long_name": "mean pull-off force with roughness continued"}

    def summary(given: MasterForces) -> xr.Dataset:
        force = work * given.forces.unfiltered_pull_off_force.mean().values
        half = half_width_over_masters(
            given, lambda filtered, unfiltered: unfiltered, "unfiltered_shift", confidence
        )
        interval, end = logarithmic_interval(force, half), float(given.forces.unfiltered_wavelength)
        return xr.Dataset(
            with_interval("continued_force", (), force, interval, attributes, confidence)
            | {
                "continued_source": given.parts.source,
                "continued_end": ((), end, {"units": "nm", "long_name": "last wavelength"}),
            }
        )

    return over_masters(scales, masters, summary).assign(transition=scales.transition)


def with_continued_force(force: xr.Dataset, continued: xr.Dataset, tolerance: float) -> xr.Dataset:
    """Return predicted forces with those of continued roughness, and whether the two differ.

    The continued ones are of the same work and of the range that is asked for; the tolerance is the
    relative change of the force that counts as none. ``continued_differs`` (surface, side) is 1
    where the force with continued roughness lies outside the interval of that on the scans, or
    there is none, and the change is more than the tolerance; 0 where one number says both.
    """
    rho = force.attrs["range_of_adhesion"]
    scan_force = force.sel(contact_model=PLASTIC).sel(rho=rho, method="nearest", drop=True)
    low, high = bounds(scan_force, "force")
    inside = (low <= continued.continued_force) & (continued.continued_force <= high)
    changed = np.abs(continued.continued_force / scan_force.force - 1) > tolerance
    differs = (changed & ~inside).drop_vars("contact_model").astype(int)
    differs.attrs = {"units": "1", "long_name": "1 where that differs from the force on the scans"}
    return force.merge(continued).assign(continued_differs=differs.transpose("surface", "side"))


def with_smooth_bound(force: xr.Dataset, area: float) -> xr.Dataset:
    """Return predicted forces of which no mean, nor its interval, exceeds that of a smooth sphere.

    A sphere attracts a surface h by the integral of (W/rho) exp(-g/rho) over the gap g. Where long
    waves alone bend the surface, this is 2 pi R W/sqrt(D), D = det(1 - R Hess h) at the point of
    contact: more than 2 pi R W in a dale. As the apex moves by D times what the point of contact
    does, the mean over places of the apex is that of 2 pi R W sqrt(D) over the surface, and
    sqrt(D) is at most 1 - R lap(h)/2, whose mean is one. Short waves, whose peaks keep the rest
    apart, lower the force; pixels raise it, by 1 + A_pix/(12 R rho), as the highest of them is not
    the highest point. So the mean is at most 2 pi R W, and in plastic contact W/rho times the area
    F/H more, which touches at gap zero. Single contacts (`force_quantile`) have no such bound.

    Forces are those of `with_continued_force`, the area F/H is in nm². They gain ``smooth_bound``
    (contact_model, rho) in N, which replaces larger ones.
    """
    radius, work = force.attrs["sphere_radius"], force.attrs["work_of_adhesion"]
    touching = area * 1e-18 / (1e-9 * force["rho"])
    yields = force["contact_model"] == PLASTIC
    bound = work * (2 * np.pi * 1e-9 * radius + touching * yields).transpose("contact_model", ...)
    rho = force.attrs["range_of_adhesion"]
    master_bound = bound.sel(contact_model=PLASTIC, drop=True).sel(rho=rho, method="nearest")
    bounded = {"smooth_bound": bound.assign_attrs(units="N", long_name="force on a smooth sphere")}
    for name, limit in {"force": bound, "continued_force": master_bound.drop_vars("rho")}.items():
        for variable in (name, f"{name}_interval"):
            value = force[variable]
            # An interval without ends stays one.
            bounded[variable] = value.where((value <= limit) | ~np.isfinite(value), limit)
    return force.assign(bounded)
