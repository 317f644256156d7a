"""How both edges of the critical band scale with R, rho and the contact area F/H.

The attraction reaches sqrt(2 R rho) along the surface (Eq. 3 of the paper) and the contact
sqrt(F/H). If one of them set an edge, the edge would be proportional to it: an exponent of 1. An
edge that belongs to the surface has the exponents 0.
"""

from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr

from hardcontact.adhesion.all_surfaces import Described
from hardcontact.adhesion.critical_band import POOLED, critical_band
from hardcontact.adhesion.sampling import Sampling
from hardcontact.records.dataset import stack
from hardcontact.statistics import jackknife_interval, with_interval
from hardcontact.surfaces.spectrum import Spectrum, all_scales_moments

__all__ = ["LENGTHS", "PARTS", "REGIMES", "edge_scaling", "regime", "stacked_scaling"]

#: What an edge may be proportional to: the reach of the attraction, the edge of the contact.
LENGTHS = ["interaction", "contact"]

#: Combinations that an exponent is fitted to: all, and those of either side of the roll-off.
PARTS = ["all", "reach below roll-off", "reach above roll-off"]

#: What the exponents of an edge say.
REGIMES = ["interaction", "contact", "both", "surface", "undecided"]

COMBINATION = ["radius", "area", "rho"]


def stacked_scaling(
    masters: Mapping[tuple[Any, ...], xr.Dataset],
    spectra: Mapping[str, Spectrum],
    described: Described,
) -> xr.Dataset:
    """Return the ratios of all masters, and what the spectrum says of each surface.

    Parameters
    ----------
    masters : mapping of tuple to xarray.Dataset
        (surface, realization, side) -> `scaled_pull_off`.
    spectra : mapping of str to Spectrum
        By surface.
    described : Described
        Labels and bases.

    Returns
    -------
    xarray.Dataset
        ``ratio`` (surface, realization, side, cutoff_wavelength, radius, area, rho) of filtered
        over unfiltered force, NaN at cutoffs of the other side; ``unfiltered_wavelength``
        (surface, side) and ``contact_area`` (side, area); ``rms_height`` and ``roll_off`` (surface)
        in nm, the latter the wavelength whose octave holds most of the variance of heights; label
        and basis.
    """
    parts = {
        key: one[["unfiltered_wavelength", "contact_area"]].assign(
            ratio=one["pull_off_force"] / one["unfiltered_pull_off_force"]
        )
        for key, one in masters.items()
    }
    stacked = stack(parts, ["surface", "realization", "side"]).sortby("cutoff_wavelength")
    first = stacked.isel(realization=0, drop=True)
    names = stacked["surface"].values.tolist()
    of_surfaces = [spectra[name] for name in names]
    nm = {"units": "nm"}
    return stacked.assign(
        unfiltered_wavelength=first["unfiltered_wavelength"],
        contact_area=first["contact_area"].isel(surface=0, drop=True),
        rms_height=("surface", [all_scales_moments(one)[0] for one in of_surfaces], nm),
        roll_off=("surface", [_roll_off(one) for one in of_surfaces], nm),
        label=("surface", [described["labels"][name] for name in names]),
        basis=("surface", [described["basis"][name] for name in names]),
    )


def _roll_off(spectrum: Spectrum) -> float:
    """Return the wavelength (nm) whose octave holds most of the variance of heights."""
    variance = spectrum.wavevector**2 * spectrum.density
    return float(2 * np.pi / spectrum.wavevector[variance.argmax()])


def edge_scaling(scaling: xr.Dataset, tolerance: float, sampling: Sampling) -> xr.Dataset:
    """Return edges, exponents and regimes of all surfaces.

    Parameters
    ----------
    scaling : xarray.Dataset
        Of `stacked_scaling`.
    tolerance : float
        Relative change of the force that counts.
    sampling : Sampling
        Of the intervals of edges; its confidence is that of all intervals.

    Returns
    -------
    xarray.Dataset
        ``edge`` (side, surface, radius, area, rho) in nm with its interval over realizations, NaN
        where it is open; ``exponent`` (side, surface, part, length) by least squares of ln(edge)
        against ln sqrt(2 R rho) and ln sqrt(contact area), with intervals by the jackknife over
        realizations; ``explained`` (side, surface, part), the share of the variance of ln(edge)
        that the fit explains, ``edges_found`` and ``regime`` of the same; the variables of the
        surfaces, and ``reach`` (radius, rho), sqrt(2 R rho) in nm.
    """
    reach = np.sqrt(2 * scaling["radius"] * scaling["rho"]).assign_attrs(units="nm")
    scaling = scaling.assign(reach=reach)
    edges = _edges(scaling, tolerance, sampling)
    unsampled = Sampling(sampling.seed, 0, sampling.confidence)
    count = scaling.sizes["realization"]
    left_out = [
        _edges(scaling.isel(realization=np.arange(count) != one), tolerance, unsampled)["edge"]
        for one in range(count if count > 2 else 0)
    ]
    fits = _with_interval(
        _fits(scaling, edges["edge"]),
        [_fits(scaling, edge)["exponent"].values for edge in left_out],
        sampling.confidence,
    )
    regimes = xr.apply_ufunc(
        regime,
        fits["exponent_interval"],
        input_core_dims=[["length", "bound"]],
        vectorize=True,
        output_dtypes=[object],
    ).astype(str)
    kept = scaling[["rms_height", "roll_off", "reach", "contact_area", "label", "basis"]]
    return xr.merge([edges, fits.assign(regime=regimes), kept]).assign_attrs(
        tolerance=tolerance, confidence=sampling.confidence
    )


def _with_interval(fits: xr.Dataset, left_out: list[np.ndarray], confidence: float) -> xr.Dataset:
    """Return fits with the interval of their exponents, from those that leave a realization out.

    The jackknife of a positive number is Student's t of its logarithm, here the exponent.
    """
    exponent = fits["exponent"]
    interval = np.full((*exponent.shape, 2), np.nan)
    if left_out:
        others = np.exp(np.array(left_out))
        interval = np.log(jackknife_interval(np.exp(exponent.values), others, confidence))
    dimensions = [str(name) for name in exponent.dims]
    attributes = {"units": "1", "long_name": "exponent of the edge of the band"}
    return fits.drop_vars("exponent").assign(
        with_interval("exponent", dimensions, exponent.values, interval, attributes, confidence)
    )


def regime(interval: np.ndarray) -> str:
    """Return what the intervals of both exponents say.

    An edge follows a length where the interval lies above 1/2, nearer to proportional than to
    independent, and does not where it lies within -1/2 and 1/2.

    Parameters
    ----------
    interval : numpy.ndarray
        (length, bound) of the exponents in the order of LENGTHS.

    Returns
    -------
    str
        One of REGIMES: the length that the edge follows, or both; the surface if it follows
        neither; undecided if an interval does not tell.
    """
    follows = interval[:, 0] > 0.5
    independent = (interval[:, 0] > -0.5) & (interval[:, 1] < 0.5)
    if not (follows | independent).all():
        return "undecided"
    if follows.all():
        return "both"
    return LENGTHS[int(follows.argmax())] if follows.any() else "surface"


def _edges(scaling: xr.Dataset, tolerance: float, sampling: Sampling) -> xr.Dataset:
    """Return ``edge`` (side, surface, radius, area, rho) in nm, with its interval.

    To `critical_band` every combination on a surface is a surface of its own.
    """
    one = scaling["ratio"].isel(realization=0, cutoff_wavelength=0, drop=True)
    ends = scaling["unfiltered_wavelength"].broadcast_like(one)
    cases = xr.Dataset({"ratio": scaling["ratio"], "unfiltered_wavelength": ends})
    stacked = cases.stack(case=["surface", *COMBINATION])
    names = [":".join(map(str, case)) for case in stacked["case"].values]
    named = stacked.drop_vars(["case", "surface", *COMBINATION]).rename(case="surface")
    band = critical_band(named.assign_coords(surface=names), tolerance, sampling)
    found = band[["critical_wavelength", "critical_wavelength_interval"]].drop_sel(group=POOLED)
    found = found.rename(
        group="case", critical_wavelength="edge", critical_wavelength_interval="edge_interval"
    )
    index = xr.Coordinates.from_pandas_multiindex(stacked.indexes["case"], "case")
    unstacked = found.assign_coords(index).unstack("case")
    return unstacked.reindex(surface=scaling["surface"])


def _fits(scaling: xr.Dataset, edge: xr.DataArray) -> xr.Dataset:
    """Return exponents, explained share and number of edges of every side, surface and part."""
    contact = np.sqrt(scaling["contact_area"])
    below = scaling["reach"] < scaling["roll_off"]
    taken = xr.concat([xr.ones_like(below), below, ~below], "part").assign_coords(part=PARTS)
    exponent, explained, found = xr.apply_ufunc(
        _fit,
        np.log(edge),
        np.log(scaling["reach"]),
        np.log(contact),
        taken,
        input_core_dims=[COMBINATION, ["radius", "rho"], ["area"], ["radius", "rho"]],
        output_core_dims=[["length"], [], []],
        vectorize=True,
    )
    return xr.Dataset(
        {
            "exponent": exponent.transpose("side", "surface", "part", "length"),
            "explained": explained.assign_attrs(units="1"),
            "edges_found": found.assign_attrs(units="1"),
        }
    ).assign_coords(length=LENGTHS)


def _fit(
    edge: np.ndarray, reach: np.ndarray, contact: np.ndarray, taken: np.ndarray
) -> tuple[np.ndarray, float, int]:
    """Return exponents (2,), the explained share of the variance and the number of edges.

    edge: logarithms (radius, area, rho), NaN where open; reach (radius, rho) and contact (area,)
    are logarithms too; taken: (radius, rho). Exponents are NaN of fewer edges than four or of a
    length that does not vary.
    """
    predictors = np.stack(
        np.broadcast_arrays(np.ones(edge.shape), reach[:, None, :], contact[None, :, None]), -1
    )
    known = np.isfinite(edge) & taken.astype(bool)[:, None, :]
    design, values = predictors[known], edge[known]
    if len(values) < 4 or np.linalg.matrix_rank(design) < 3:
        return np.full(2, np.nan), np.nan, len(values)
    solution = np.linalg.lstsq(design, values)[0]
    spread = values.var()
    share = 1 - (values - design @ solution).var() / spread if spread > 0 else np.nan
    return solution[1:], float(share), len(values)
