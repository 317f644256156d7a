"""How forces and edges of the band depend on the contact: exponents.nc and edge_shifts.nc.

Edges are fitted as powers of the root of the sphere's radius, because the interaction radius √(Dρ)
grows like this root, and of the root of the area in contact, a length.
"""

import numpy as np
import xarray as xr

from hardcontact.base.arrays import Floats
from hardcontact.base.statistics import Sampling, as_variables, jackknife_interval, student_interval
from hardcontact.base.units import DIMENSIONLESS
from hardcontact.contact.contact import CONTACT_AXES, CONTACT_MODELS, PLASTIC, RIGID
from hardcontact.inference.edges import edges_of_independent_masters, find_edges, logarithmic_limits

#: Labels of the exponents against the roots of the sphere's radius and of the area in contact.
SCALED_QUANTITIES = ["radius", "contact"]


def fit_exponents(
    forces: xr.Dataset, contact_area: float, tolerance: float, confidence: float
) -> xr.Dataset:
    """Return exponents.nc, from forces of `read_master_forces` at a single range of adhesion."""
    forces = forces.squeeze("rho", drop=True)
    forces = forces.swap_dims(loading="contact_area").drop_vars("loading")
    exponents = force_exponent(forces, contact_area, confidence)
    return exponents.merge(edge_exponents(forces, tolerance, confidence)).assign_attrs(
        contact_area=contact_area, tolerance=tolerance, confidence=confidence
    )


def force_exponent(forces: xr.Dataset, contact_area: float, confidence: float) -> xr.Dataset:
    """Return the exponent of the force on unfiltered long-edge masters against the radius.

    It is the mean (surface,) over masters, with its interval. Of the areas in contact, the nearest
    to `contact_area` (nm²) counts.
    """
    long_edge_forces = forces["unfiltered_pull_off_force"].sel(side="long")
    means = long_edge_forces.sel(contact_area=contact_area, method="nearest").mean(CONTACT_AXES)
    log_means = xr.DataArray(np.log(means)).assign_coords(radius=np.log(means["radius"]))
    slopes = log_means.polyfit("radius", 1)["polyfit_coefficients"].sel(degree=1, drop=True)
    interval = student_interval(slopes, confidence, "realization").transpose("surface", "end")
    exponent = slopes.mean("realization")
    variables = as_variables(
        "force_exponent", "surface", exponent.values, interval.values, DIMENSIONLESS, confidence
    )
    return xr.Dataset(variables, {"surface": forces["surface"]})


def edge_exponents(forces: xr.Dataset, tolerance: float, confidence: float) -> xr.Dataset:
    """Return the exponents of the edges against the roots of SCALED_QUANTITIES.

    They are (surface, side, exponent_of), with jackknife intervals: NaN for fewer than three
    masters.
    """
    exponents = _fit_all_edges(forces, tolerance)
    count = forces.sizes["realization"]
    jackknife_exponents = [
        _fit_all_edges(forces.drop_isel(realization=index), tolerance)
        for index in range(count if count > 2 else 0)
    ]
    # `jackknife_interval` works on logarithms, so it gets exp(exponent).
    interval = jackknife_interval(np.exp(exponents), np.exp(jackknife_exponents), confidence)
    dimensions = ("surface", "side", "exponent_of")
    variables = as_variables(
        "edge_exponent", dimensions, exponents, np.log(interval), DIMENSIONLESS, confidence
    )
    coordinates = {name: forces[name].values for name in ("surface", "side")}
    return xr.Dataset(variables, coordinates | {"exponent_of": SCALED_QUANTITIES})


def _fit_all_edges(forces: xr.Dataset, tolerance: float) -> Floats:
    """Return the exponents (surface, side, exponent_of) of the edges of all surfaces."""
    # Pixels, and so the areas, are the same on all masters of a side.
    touching_area = forces["touching_area"].isel(surface=0, realization=0)
    log_roots = [np.log(forces["radius"]) / 2, np.log(touching_area) / 2]
    curves = xr.ufuncs.log(forces["filtered_force_ratio"].mean("realization", skipna=False))
    edges = find_edges(curves, logarithmic_limits(tolerance), forces["spectrum_end"])
    exponents: xr.DataArray = xr.apply_ufunc(
        _fit_edges,
        np.log(edges["edge"]),
        *log_roots,
        input_core_dims=[["radius", "contact_area"], ["radius"], ["contact_area"]],
        output_core_dims=[["exponent_of"]],
        vectorize=True,
    )
    return np.asarray(exponents.transpose("surface", "side", "exponent_of"))


def _fit_edges(log_edge: Floats, log_radius_root: Floats, log_area_root: Floats) -> Floats:
    """Return the exponents (2,) of SCALED_QUANTITIES for the edges of one surface and side.

    They are a and b in ln(edge) = c + a ln √R + b ln √A, fitted by least squares, with the radius R
    of the sphere and the area A in contact. Open edges (radius, contact_area) are NaN. Exponents
    are NaN if fewer than four edges are found, or found edges do not determine both.
    """
    log_roots = np.broadcast_arrays(log_radius_root[:, None], log_area_root)
    is_found = np.isfinite(log_edge)
    columns = [np.ones(is_found.sum()), *(log_root[is_found] for log_root in log_roots)]
    design = np.stack(columns, axis=-1)
    count = len(SCALED_QUANTITIES)
    if len(design) <= count + 1 or np.linalg.matrix_rank(design) <= count:
        return np.full(count, np.nan)
    return np.asarray(np.linalg.lstsq(design, log_edge[is_found])[0][1:])


def compute_edge_shifts(forces: xr.Dataset, tolerance: float, sampling: Sampling) -> xr.Dataset:
    """Return edge_shifts.nc, from forces of `read_master_forces` at a single radius.

    Edges are (contact_model, rho, side, group). ``edge_shift`` (cause, side, group) is the edge of
    plastic contact at the longest range, relative to rigid contact (``"plasticity"``) or to the
    shortest range (``"range"``).
    """
    # Sorted by area, rigid contact is the first, as in CONTACT_MODELS: its area is zero.
    forces = forces.squeeze("radius", drop=True).sortby("contact_area").drop_vars("contact_area")
    forces = forces.rename(loading="contact_model").assign_coords(contact_model=CONTACT_MODELS)
    edges, sampled_edges = edges_of_independent_masters(forces, tolerance, sampling)
    shortest_range, longest_range = forces["rho"].min().item(), forces["rho"].max().item()
    with_both_causes = sampled_edges.sel(contact_model=PLASTIC, rho=longest_range, drop=True)
    without_cause = {
        "plasticity": sampled_edges.sel(contact_model=RIGID, rho=longest_range, drop=True),
        "range": sampled_edges.sel(contact_model=PLASTIC, rho=shortest_range, drop=True),
    }
    shifts = np.stack([with_both_causes / edge for edge in without_cause.values()], axis=1)
    variables = sampling.sampled_variables(
        "edge_shift", ("cause", "side", "group"), shifts, DIMENSIONLESS
    )
    edge_shifts = edges.assign_coords(cause=list(without_cause)).assign(variables)
    return edge_shifts.assign_attrs(tolerance=tolerance, confidence=sampling.confidence)
