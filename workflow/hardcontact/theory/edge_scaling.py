"""How both edges of the critical band scale with R, rho and the contact area, and what sets them.

If the surface alone sets an edge, its exponents against sqrt(R), sqrt(rho) and sqrt(F/H) are 0. If
the contact sets the short edge, its exponent against sqrt(F/H) is 1. If the range sets the short
edge, its exponent against sqrt(rho) is 2 over the Hurst exponent. The formulas are in
`edge_formulas`.
"""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.base.statistics import (
    Sampling,
    jackknife_interval,
    student_interval,
    with_interval,
)
from hardcontact.base.units import DIMENSIONLESS, NM
from hardcontact.contact.all_surfaces import (
    Described,
    Parts,
    stacked_forces,
    with_names,
)
from hardcontact.contact.contact import CONTACT_AXES, Contact, contact_of_area
from hardcontact.inference.edges import POOLED, edges_of_realizations
from hardcontact.surfaces.spectrum import Floats, Spectrum, roll_off
from hardcontact.surfaces.synthesis import SIDES
from hardcontact.theory.closed_form import closed_form
from hardcontact.theory.edge_formulas import formula_edges

#: Lengths that may set an edge: sqrt(R), sqrt(rho) and sqrt(F/H), with the axis of the grid.
SCALED_LENGTHS = {"radius": "radius", "rho": "rho", "contact": "area"}
#: Predictions with which computed edges of designed surfaces are compared.
FORMULA, CLOSED_FORM = "formula", "closed form"

COMBINATION = ["radius", "area", "rho"]


def stack_scaling(masters: Parts, described: Described) -> xr.Dataset:
    """Return the ratios of filtered to unfiltered forces on all masters.

    masters: from `filtered_pull_off`, by (surface, realization, side).
    described: label and basis of each surface.
    Returns ``filtered_force_ratio`` (surface, realization, side, cutoff_wavelength, radius, area,
        rho), NaN at cutoffs of the other side; ``unfiltered_wavelength`` (surface, side) in nm;
        ``contact_area`` (side, area) of touching pixels in nm².
    """
    stacked = stacked_forces(masters).swap_dims(load="area").drop_vars("load")
    contact_area = stacked["contact_area"].isel(surface=0, realization=0, drop=True)
    return with_names(stacked, described).assign(contact_area=contact_area)


def edge_scaling(
    scaling: xr.Dataset,
    spectra: Mapping[str, Spectrum],
    contact: Contact,
    tolerance: float,
    sampling: Sampling,
) -> xr.Dataset:
    """Return computed edges, edges by the formulas, and exponents of the computed edges.

    scaling: from `stack_scaling`.
    spectra: c_iso in nm⁴ by surface.
    contact: the contact of the paper, for the coordinates among the regimes.
    tolerance: relative change of the force that defines an edge.
    sampling: random numbers and confidence of all intervals.
    Returns by (side, surface, radius, area, rho): ``edge`` in nm, NaN if it is open, with its
        interval over realizations, and ``formula_edge`` in nm. ``exponent`` (side, surface,
        exponent_of) by least squares of ln(edge) against the logarithms of SCALED_LENGTHS, without
        open edges, with intervals by the jackknife over realizations. ``interaction_radius``
        (radius, rho), sqrt(2 R rho) in nm. The variables of `regime_coordinates`.
    """
    edges = _edges(scaling, tolerance, sampling)
    formula = _formula_edges(spectra, scaling, contact.work, tolerance)
    interaction_radius = (2 * scaling["radius"] * scaling["rho"]) ** 0.5
    return xr.merge(
        [
            edges.assign(
                formula_edge=formula.assign_attrs(NM),
                interaction_radius=interaction_radius.assign_attrs(NM),
            ),
            _exponents(scaling, edges["edge"], tolerance, sampling),
            regime_coordinates(spectra, contact),
            scaling[["label", "basis"]],
        ]
    ).assign_attrs(tolerance=tolerance, confidence=sampling.confidence)


def force_exponent(scaling: xr.Dataset, contact: Contact, confidence: float) -> xr.Dataset:
    """Return the exponent of the mean force against the radius of the sphere.

    scaling: from `stack_scaling`, for masters with long waves.
    contact: selects the forces at its range and its area in contact.
    confidence: confidence of the interval over realizations.
    Returns ``force_exponent`` (surface) by least squares of ln F against ln R, with its interval.
    """
    nearest = {"rho": contact.range, "area": contact.area}
    forces = scaling["unfiltered_pull_off_force"].sel(side="large").sel(nearest, method="nearest")
    forces = forces.mean([axis for axis in CONTACT_AXES if axis in forces.dims])
    logarithms = xr.DataArray(np.log(forces)).assign_coords(radius=np.log(forces["radius"]))
    slopes = logarithms.polyfit("radius", 1)["polyfit_coefficients"].sel(degree=1, drop=True)
    variables = with_interval(
        "force_exponent", "surface", slopes.mean("realization").values,
        student_interval(slopes, confidence, "realization").transpose("surface", "bound").values,
        DIMENSIONLESS | {"long_name": "exponent of the pull-off force against the radius"},
        confidence,
    )  # fmt: skip
    return xr.Dataset(variables, {"surface": slopes["surface"]})


def _edges(scaling: xr.Dataset, tolerance: float, sampling: Sampling) -> xr.Dataset:
    """Return ``edge`` (side, surface, radius, area, rho) in nm, with its interval.

    Every combination of radius, area and range counts as a surface of its own.
    """
    combinations = scaling["filtered_force_ratio"].isel(
        realization=0, cutoff_wavelength=0, drop=True
    )
    ends = scaling["unfiltered_wavelength"].broadcast_like(combinations)
    cases = scaling[["filtered_force_ratio"]].assign(unfiltered_wavelength=ends)
    cases = cases.stack(case=["surface", *COMBINATION])
    names = [":".join(map(str, case)) for case in cases["case"].values]
    unlabelled = cases.drop_vars(["case", "surface", *COMBINATION]).rename(case="surface")
    band = edges_of_realizations(unlabelled.assign_coords(surface=names), tolerance, sampling)
    edges: xr.Dataset = band[["edge", "edge_interval"]].drop_sel(group=POOLED).rename(group="case")
    unstacked = edges.assign_coords(cases["case"].coords).unstack("case")
    return unstacked.reindex(surface=scaling["surface"])


def _exponents(
    scaling: xr.Dataset, edge: xr.DataArray, tolerance: float, sampling: Sampling
) -> xr.Dataset:
    """Return ``exponent`` (side, surface, exponent_of) with its interval."""
    unsampled = replace(sampling, samples=0)
    count = scaling.sizes["realization"]
    exponent = _fit_all_exponents(scaling, edge)
    jackknife_exponents = [
        _fit_all_exponents(
            scaling, _edges(scaling.drop_isel(realization=n), tolerance, unsampled)["edge"]
        )
        for n in range(count if count > 2 else 0)
    ]
    # The jackknife uses Student's t for the logarithm of a positive number, here the exponent.
    interval = np.log(
        jackknife_interval(np.exp(exponent), np.exp(jackknife_exponents), sampling.confidence)
    )
    attributes = DIMENSIONLESS | {"long_name": "exponent of the edge of the band"}
    dims = ("side", "surface", "exponent_of")
    variables = with_interval("exponent", dims, exponent, interval, attributes, sampling.confidence)
    coordinates = {name: edge[name] for name in ("side", "surface")}
    return xr.Dataset(variables, coordinates | {"exponent_of": list(SCALED_LENGTHS)})


def _fit_all_exponents(scaling: xr.Dataset, edge: xr.DataArray) -> Floats:
    """Return the exponents (side, surface, exponent_of) of the edges on every side and surface."""
    logarithms = [np.log(scaling[name]) / 2 for name in ("radius", "rho", "contact_area")]
    exponents: xr.DataArray = xr.apply_ufunc(
        _fit_exponents,
        np.log(edge),
        *logarithms,
        input_core_dims=[COMBINATION, ["radius"], ["rho"], ["area"]],
        output_core_dims=[["exponent_of"]],
        vectorize=True,
    )
    return np.asarray(exponents.transpose("side", "surface", "exponent_of"))


def _fit_exponents(edge: Floats, radius: Floats, rho: Floats, contact_area: Floats) -> Floats:
    """Return the exponents (3,), NaN if the edges do not determine them.

    `edge` (radius, area, rho) holds logarithms, NaN for open edges. The other arguments are the
    logarithms of the square roots of radius, range and contact area.
    """
    lengths = np.broadcast_arrays(radius[:, None, None], rho, contact_area[:, None])
    is_closed = np.isfinite(edge)
    design = np.stack(
        [np.ones(is_closed.sum()), *(length[is_closed] for length in lengths)], axis=-1
    )
    if len(design) <= len(SCALED_LENGTHS) + 1 or np.linalg.matrix_rank(design) <= len(
        SCALED_LENGTHS
    ):
        return np.full(len(SCALED_LENGTHS), np.nan)
    return np.asarray(np.linalg.lstsq(design, edge[is_closed])[0][1:])


def _formula_edges(
    spectra: Mapping[str, Spectrum], grid: xr.Dataset, work: float, tolerance: float
) -> xr.DataArray:
    """Return the edges (side, surface, radius, area, rho) in nm by the formulas on a grid."""
    radii = grid["radius"]
    areas = grid["area"]
    rhos = grid["rho"]
    edges = [
        formula_edges(spectrum, contact_of_area(radius, rho, work, area), tolerance)
        for spectrum in spectra.values()
        for radius in radii.values
        for area in areas.values
        for rho in rhos.values
    ]
    values = np.reshape(edges, (len(spectra), radii.size, areas.size, rhos.size, 2))
    coordinates = {"surface": list(spectra), "radius": radii, "area": areas, "rho": rhos}
    formula = xr.DataArray(values, coordinates | {"side": list(SIDES)}, [*coordinates, "side"])
    return formula.transpose("side", ...)


def regime_coordinates(spectra: Mapping[str, Spectrum], contact: Contact) -> xr.Dataset:
    """Return the coordinates of surfaces on the map of the regimes.

    spectra: c_iso in nm⁴ by surface.
    contact: the sphere, the attraction and the area in contact.
    Returns by surface: ``rms_height_over_range``, sigma/rho; ``apex_level``, m/sigma of the closed
        form, NaN if the sphere follows all waves; ``contact_over_rolloff``, the root of the contact
        area relative to the roll-off.
    """
    forms = [closed_form(spectrum, contact) for spectrum in spectra.values()]
    rms_height = np.array([form.rms_height for form in forms])
    apex_height = np.array([form.apex_height for form in forms])
    roll_offs = np.array([roll_off(spectrum) for spectrum in spectra.values()])
    return xr.Dataset(
        {
            "rms_height_over_range": ("surface", rms_height / contact.range, DIMENSIONLESS),
            "apex_level": (
                "surface",
                apex_height / np.where(rms_height > 0, rms_height, np.nan),
                DIMENSIONLESS,
            ),
            "contact_over_rolloff": ("surface", contact.area**0.5 / roll_offs, DIMENSIONLESS),
        },
        {"surface": list(spectra)},
    )


def designed_edge_errors(computed: pd.DataFrame, formulas: pd.DataFrame) -> xr.Dataset:
    """Return errors of predicted edges of designed surfaces, and the regimes of the surfaces.

    computed, formulas: the tables prediction.csv and edges.csv of resources/validation/README.md.
    Returns by designed surface: ``designed_rms_height_over_range``, ``designed_level``,
        ``designed_contact_over_rolloff``, and ``held_out``, 1 for held-out surfaces; published
        spectra, which have no computed edge, have 0. ``designed_computed_over_predicted``
        (prediction, side, designed), the computed edge relative to the edge by FORMULA and by
        CLOSED_FORM. ``designed_bound`` (side, designed), 1 or -1 if the error is a lower or an
        upper bound.
    """
    table = formulas.astype({"surface": str}).set_index("surface").rename_axis("designed")
    computed_rows = computed.astype({"surface": str}).set_index("surface").reindex(table.index)
    names = ["short_edge", "long_edge"]
    signs = {"at least": 1, "at most": -1}
    errors = [
        [computed_rows[name] / table[name] for name in names],
        [computed_rows[name] / computed_rows[f"predicted_{name}"] for name in names],
    ]
    bounds = [computed_rows[f"{name}_status"].map(signs).fillna(0) for name in names]
    coordinates = table.drop(columns=names).add_prefix("designed_").to_xarray()
    for name in coordinates.data_vars:
        coordinates[name].attrs = DIMENSIONLESS
    return coordinates.assign(
        held_out=("designed", computed_rows["held_out"].fillna(0).astype("int8")),
        designed_computed_over_predicted=(
            ("prediction", "side", "designed"),
            errors,
            DIMENSIONLESS,
        ),
        designed_bound=(("side", "designed"), np.array(bounds, "int8")),
        prediction=[FORMULA, CLOSED_FORM],
        side=list(SIDES),
    )
