"""How both edges of the critical band scale with R, rho and the contact area, and what sets them.

An edge that belongs to the surface has the exponents 0 against sqrt(R), sqrt(rho) and sqrt(F/H).
The short edge has 1 against sqrt(F/H) if the contact sets it, and 2/H against sqrt(rho), H the
Hurst exponent, if the range does. The formulas are those of `edge_formulas`.
"""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.band.critical_band import POOLED, critical_band
from hardcontact.base.statistics import (
    Sampling,
    jackknife_interval,
    student_interval,
    with_interval,
)
from hardcontact.contact.all_surfaces import (
    CONTACT_AXES,
    Described,
    Parts,
    stacked_forces,
    with_names,
)
from hardcontact.contact.contact import Contact, contact_of_area
from hardcontact.surfaces.spectrum import Floats, Spectrum, roll_off
from hardcontact.surfaces.synthesis import SIDES
from hardcontact.theory.closed_form import closed_form
from hardcontact.theory.edge_formulas import formula_edges

#: What an edge may follow: sqrt(R), sqrt(rho) and sqrt(F/H), by the axis of the grid.
LENGTHS = {"radius": "radius", "rho": "rho", "contact": "area"}
#: The predictions that edges of designed surfaces are compared with.
FORMULA, CLOSED_FORM = "formula", "closed form"

COMBINATION = ["radius", "area", "rho"]
ONE, NM = {"units": "1"}, {"units": "nm"}


def stacked_scaling(masters: Parts, described: Described) -> xr.Dataset:
    """Return the ratios of all masters, with the names of the surfaces.

    The masters are of `filtered_pull_off`, by (surface, realization, side). ``ratio`` (surface,
    realization, side, cutoff_wavelength, radius, area, rho) is that of filtered to unfiltered
    force, NaN at cutoffs of the other side, beside ``unfiltered_wavelength`` (surface, side) and
    ``contact_area`` (side, area) of touching pixels, in nm².
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
    """Return edges, computed and by the formulas, and their exponents.

    Parameters
    ----------
    scaling : xarray.Dataset
        As of `stacked_scaling`.
    spectra : mapping of str to Spectrum
        By surface.
    contact : Contact
        Of the paper, which places surfaces among the regimes.
    tolerance : float
        Relative change of the force that counts.
    sampling : Sampling
        Of all intervals.

    Returns
    -------
    xarray.Dataset
        Over (side, surface, radius, area, rho) ``edge`` in nm, NaN where it is open, with its
        interval over realizations, and ``formula_edge``. ``exponent`` (side, surface, length), by
        least squares of ln(edge) against the logarithms of LENGTHS, of the edges that are there,
        with intervals by the jackknife over realizations. ``reach`` (radius, rho), sqrt(2 R rho) in
        nm. The variables of `among_regimes`.
    """
    edges = _edges(scaling, tolerance, sampling)
    formula = _formula_edges(spectra, scaling, contact.work, tolerance)
    reach = (2 * scaling["radius"] * scaling["rho"]) ** 0.5
    return xr.merge(
        [
            edges.assign(formula_edge=formula.assign_attrs(NM), reach=reach.assign_attrs(NM)),
            _exponents(scaling, edges["edge"], tolerance, sampling),
            among_regimes(spectra, contact),
            scaling[["label", "basis"]],
        ]
    ).assign_attrs(tolerance=tolerance, confidence=sampling.confidence)


def force_exponent(scaling: xr.Dataset, contact: Contact, confidence: float) -> xr.Dataset:
    """Return the exponent of the mean force against the radius of the sphere.

    Parameters
    ----------
    scaling : xarray.Dataset
        As of `stacked_scaling`, of masters with long waves.
    contact : Contact
        Its range and its contact area are those of the forces.
    confidence : float
        Of the interval over realizations.

    Returns
    -------
    xarray.Dataset
        ``force_exponent`` (surface) by least squares of ln F against ln R, with its interval.
    """
    nearest = {"rho": contact.range, "area": contact.area}
    forces = scaling["unfiltered_pull_off_force"].sel(side="large").sel(nearest, method="nearest")
    forces = forces.mean([axis for axis in CONTACT_AXES if axis in forces.dims])
    logarithms = xr.DataArray(np.log(forces)).assign_coords(radius=np.log(forces["radius"]))
    slopes = logarithms.polyfit("radius", 1)["polyfit_coefficients"].sel(degree=1, drop=True)
    variables = with_interval(
        "force_exponent", "surface", slopes.mean("realization").values,
        student_interval(slopes, confidence, "realization").transpose("surface", "bound").values,
        ONE | {"long_name": "exponent of the pull-off force against the radius"}, confidence,
    )  # fmt: skip
    return xr.Dataset(variables, {"surface": slopes["surface"]})


def _edges(scaling: xr.Dataset, tolerance: float, sampling: Sampling) -> xr.Dataset:
    """Return ``edge`` (side, surface, radius, area, rho) in nm, with its interval.

    To `critical_band` every combination on a surface is a surface of its own.
    """
    combinations = scaling["ratio"].isel(realization=0, cutoff_wavelength=0, drop=True)
    ends = scaling["unfiltered_wavelength"].broadcast_like(combinations)
    cases = scaling[["ratio"]].assign(unfiltered_wavelength=ends)
    cases = cases.stack(case=["surface", *COMBINATION])
    names = [":".join(map(str, case)) for case in cases["case"].values]
    named = cases.drop_vars(["case", "surface", *COMBINATION]).rename(case="surface")
    band = critical_band(named.assign_coords(surface=names), tolerance, sampling)
    renamed = {f"critical_wavelength{end}": f"edge{end}" for end in ("", "_interval")}
    edges = band[list(renamed)].drop_sel(group=POOLED).rename(renamed | {"group": "case"})
    unstacked = edges.assign_coords(cases["case"].coords).unstack("case")
    return unstacked.reindex(surface=scaling["surface"])


def _exponents(
    scaling: xr.Dataset, edge: xr.DataArray, tolerance: float, sampling: Sampling
) -> xr.Dataset:
    """Return ``exponent`` (side, surface, length) with its interval."""
    unsampled, count = replace(sampling, samples=0), scaling.sizes["realization"]
    exponent = _fits(scaling, edge)
    left_out = [
        _fits(scaling, _edges(scaling.drop_isel(realization=n), tolerance, unsampled)["edge"])
        for n in range(count if count > 2 else 0)
    ]
    # The jackknife of a positive number is Student's t of its logarithm, here the exponent.
    interval = np.log(jackknife_interval(np.exp(exponent), np.exp(left_out), sampling.confidence))
    attributes = ONE | {"long_name": "exponent of the edge of the band"}
    dims = ("side", "surface", "length")
    variables = with_interval("exponent", dims, exponent, interval, attributes, sampling.confidence)
    coordinates = {name: edge[name] for name in ("side", "surface")}
    return xr.Dataset(variables, coordinates | {"length": list(LENGTHS)})


def _fits(scaling: xr.Dataset, edge: xr.DataArray) -> Floats:
    """Return exponents (side, surface, length) of every side and surface."""
    logarithms = [np.log(scaling[name]) / 2 for name in ("radius", "rho", "contact_area")]
    exponents: xr.DataArray = xr.apply_ufunc(
        _fit,
        np.log(edge),
        *logarithms,
        input_core_dims=[COMBINATION, ["radius"], ["rho"], ["area"]],
        output_core_dims=[["length"]],
        vectorize=True,
    )
    return np.asarray(exponents.transpose("side", "surface", "length"))


def _fit(edge: Floats, radius: Floats, rho: Floats, contact: Floats) -> Floats:
    """Return exponents (3,), NaN where the edges do not tell the lengths apart.

    edge: logarithms (radius, area, rho), NaN where open; others are logarithms of square roots.
    """
    lengths = np.broadcast_arrays(radius[:, None, None], rho, contact[:, None])
    known = np.isfinite(edge)
    design = np.stack([np.ones(known.sum()), *(length[known] for length in lengths)], axis=-1)
    if len(design) <= len(LENGTHS) + 1 or np.linalg.matrix_rank(design) <= len(LENGTHS):
        return np.full(len(LENGTHS), np.nan)
    return np.asarray(np.linalg.lstsq(design, edge[known])[0][1:])


def _formula_edges(
    spectra: Mapping[str, Spectrum], grid: xr.Dataset, work: float, tolerance: float
) -> xr.DataArray:
    """Return the edges (side, surface, radius, area, rho) in nm by the formulas, over a grid."""
    axes = [grid[name] for name in COMBINATION]
    edges = [
        formula_edges(spectrum, contact_of_area(radius, rho, work, area), tolerance)
        for spectrum in spectra.values()
        for radius in axes[0].values
        for area in axes[1].values
        for rho in axes[2].values
    ]
    values = np.reshape(edges, (len(spectra), *(axis.size for axis in axes), 2))
    coordinates = {"surface": list(spectra), **{axis.name: axis for axis in axes}}
    formula = xr.DataArray(values, coordinates | {"side": list(SIDES)}, [*coordinates, "side"])
    return formula.transpose("side", ...)


def among_regimes(spectra: Mapping[str, Spectrum], contact: Contact) -> xr.Dataset:
    """Return where surfaces with these spectra lie on the map of the regimes, over surface.

    ``over_range`` is sigma/rho, ``approach_level`` m/sigma of the closed form, NaN where the sphere
    follows all waves, ``contact_over_rolloff`` the root of the contact area over the roll-off.
    """
    forms = [closed_form(spectrum, contact) for spectrum in spectra.values()]
    height = np.array([form.rms_height for form in forms])
    approach = np.array([form.closest_approach for form in forms])
    roll_offs = np.array([roll_off(spectrum) for spectrum in spectra.values()])
    return xr.Dataset(
        {
            "over_range": ("surface", height / contact.range, ONE),
            "approach_level": ("surface", approach / np.where(height > 0, height, np.nan), ONE),
            "contact_over_rolloff": ("surface", contact.area**0.5 / roll_offs, ONE),
        },
        {"surface": list(spectra)},
    )


def designed_edges(computed: pd.DataFrame, formulas: pd.DataFrame) -> xr.Dataset:
    """Return how far edges of designed surfaces are off, and where all lie among the regimes.

    Parameters
    ----------
    computed, formulas : pandas.DataFrame
        The tables prediction.csv and edges.csv of resources/validation.

    Returns
    -------
    xarray.Dataset
        Over designed (surfaces): ``designed_over_range``, ``designed_level``,
        ``designed_contact_over_rolloff``, and ``held_back``, 0 of published spectra, which have no
        computed edge; ``designed_error`` (prediction, side, designed), computed edges over those by
        FORMULA and CLOSED_FORM; ``designed_bound`` (side, designed), 1 or -1 where that is at least
        or at most it.
    """
    table = formulas.astype({"surface": str}).set_index("surface").rename_axis("designed")
    known = computed.astype({"surface": str}).set_index("surface").reindex(table.index)
    names, signs = ["short_edge", "long_edge"], {"at least": 1, "at most": -1}
    errors = [
        [known[name] / table[name] for name in names],
        [known[name] / known[f"predicted_{name}"] for name in names],
    ]
    bounds = [known[f"{name}_is"].map(signs).fillna(0) for name in names]
    places = table.drop(columns=names).add_prefix("designed_").to_xarray()
    for name in places.data_vars:
        places[name].attrs = ONE
    return places.assign(
        held_back=("designed", known["held_back"].fillna(0).astype("int8")),
        designed_error=(("prediction", "side", "designed"), errors, ONE),
        designed_bound=(("side", "designed"), np.array(bounds, "int8")),
        prediction=[FORMULA, CLOSED_FORM],
        side=list(SIDES),
    )
