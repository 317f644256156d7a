"""The edges of the band: the cutoffs at which the change of the force exceeds a tolerance.

A filter removes all wavelengths below a cutoff (side ``short``) or above it (side ``long``). Its
force ratio is the force on the filtered roughness relative to the force on all roughness. A curve
(..., cutoff_wavelength) is the change of the force with the cutoff: ln(ratio) for a single surface,
the mean of |ratio - 1| for several. The edge of a curve is the cutoff at which it first leaves
`limits`, as more and more waves are removed.

Curves of both sides may share one dimension of cutoffs. Each is NaN at the cutoffs of the other.
"""

from enum import StrEnum
from typing import Any

import numpy as np
import xarray as xr

from hardcontact.base.arrays import SEED_WORDS, Floats
from hardcontact.base.statistics import ENDS, Sampling, as_variables, widen_interval
from hardcontact.base.units import DIMENSIONLESS, NM
from hardcontact.inference.mean_forces import (
    MasterForces,
    MasterScans,
    half_width_over_masters,
    logarithmic_interval,
    mean_force_ratio,
    summarize_masters,
)

#: The label in `group` of the change averaged over all surfaces; other groups are single surfaces.
AVERAGED = "averaged"
#: Names of the numbers of both edges by the side of the band.
EDGE_NAMES = {"short": "short_edge", "long": "long_edge"}
#: The dimension of curves: the cutoffs of both sides in nm.
CUTOFF = "cutoff_wavelength"


class EdgeStatus(StrEnum):
    """Whether a curve has an edge."""

    FOUND = "found"
    OPEN_ABOVE = "open_above"  #: The edge is longer than its bound.
    OPEN_BELOW = "open_below"  #: The edge is shorter than its bound.
    RIPPLES = "ripples"  #: No edge: ripples of the filter, not the roughness, change the force.
    NO_EDGE = "none"  #: No cutoff changes the force in closed form by the tolerance.


def logarithmic_limits(tolerance: float) -> tuple[float, float]:
    """Return both limits of ln(ratio) for a relative change of the force, such as 0.1."""
    return float(np.log1p(-tolerance)), float(np.log1p(tolerance))


def find_edges(
    curves: xr.DataArray, limits: tuple[float, float], spectrum_ends: xr.DataArray | float = np.nan
) -> xr.Dataset:
    """Return ``edge``, ``edge_bound`` (...) in nm and ``edge_status`` of curves.

    Each curve is followed from few removed waves to many: towards longer cutoffs on the short side,
    towards shorter ones on the long side. Between cutoffs it is linear in the logarithm of the
    cutoff. For example, with limits of -0.1 and 0.1:

        side    10 nm   20 nm   40 nm   leaves the limits between   edge
        short   0.00    0.05    0.15    20 and 40 nm                28 nm
        long    0.15    0.05    0.00    20 and 10 nm                14 nm

    If no limit is crossed between cutoffs, the edge is open: ``edge`` is NaN, ``edge_bound`` is the
    cutoff nearest to the edge, and the status says on which side of this bound the edge lies.

        side    the curve is               edge_status   edge_bound
        short   outside from the first on  open_below    shortest cutoff
        short   inside to the last         open_above    longest cutoff
        long    outside from the first on  open_above    longest cutoff
        long    inside to the last         open_below    shortest cutoff

    A curve is zero at the end of its spectrum (nm), if known, because no waves are removed there.
    Then a curve that is outside from the first on has its edge between this end and its first
    cutoff.
    """
    lower, upper = limits
    # Variables have no labels, because aligning labels would take most of the time.
    changes: Any = curves.variable
    signed_cutoffs = _signed_cutoffs(curves)
    is_outside = (changes < lower) | (changes > upper)
    first_outside, last_inside = _first_and_last_before(signed_cutoffs, is_outside)
    change_outside = _change_at(changes, signed_cutoffs, first_outside)
    # Without a cutoff inside, the curve comes from the end of its spectrum, where it is zero.
    change_inside = _change_at(changes, signed_cutoffs, last_inside).fillna(0.0)
    cutoff_inside = abs(last_inside).fillna(xr.as_variable(spectrum_ends))
    crossed_limit = change_outside.clip(lower, upper)
    fraction = (crossed_limit - change_inside) / (change_outside - change_inside)
    edge = np.exp(np.log(cutoff_inside) + fraction * np.log(abs(first_outside) / cutoff_inside))
    # An open edge comes after the last cutoff inside or, if none is inside, before the first one.
    is_open = edge.isnull()
    signed_bound = last_inside.fillna(first_outside).where(is_open)
    starts_outside = first_outside.notnull()
    # The second table: short and outside from the first on, or long and inside to the last.
    lies_below = (signed_bound > 0) == starts_outside
    open_status = np.where(lies_below, EdgeStatus.OPEN_BELOW, EdgeStatus.OPEN_ABOVE)
    return xr.Dataset(
        {
            "edge": (edge.dims, edge.values, NM),
            "edge_bound": (edge.dims, abs(signed_bound).values, NM),
            "edge_status": (edge.dims, np.where(is_open, open_status, EdgeStatus.FOUND)),
        },
        {dim: curves[dim] for dim in edge.dims},
    )


def _signed_cutoffs(curves: xr.DataArray) -> Any:
    """Return the cutoffs (nm) of curves, negative on the long side.

    A larger signed cutoff removes more waves on both sides, so that both are searched alike:
    10, 20, 40 nm on the short side, -40, -20, -10 nm on the long side. NaN where the curve is NaN.
    """
    is_short = curves["side"].variable == "short"
    cutoffs: Any = curves[CUTOFF].variable * (2 * is_short - 1)
    return cutoffs.where(curves.variable.notnull()).transpose(*curves.dims)


def _change_at(changes: Any, signed_cutoffs: Any, signed_cutoff: Any) -> Any:
    """Return the change (...) of each curve at one of its signed cutoffs (...), NaN at NaN."""
    return changes.where(signed_cutoffs == signed_cutoff).max(CUTOFF)


def _first_and_last_before(signed_cutoffs: Any, mask: Any) -> tuple[Any, Any]:
    """Return the first signed cutoff (...) at which a mask is true, and the last before it.

    If the mask is true nowhere, the first is NaN, and the last is the last of the curve. If it is
    true at the first cutoff of the curve, the last before it is NaN.
    """
    first = signed_cutoffs.where(mask).min(CUTOFF)
    # Nothing is at or above NaN: without a first, all cutoffs are before it.
    return first, signed_cutoffs.where(~(signed_cutoffs >= first)).max(CUTOFF)


def edge_intervals(
    curves: xr.DataArray, lowest: xr.DataArray, highest: xr.DataArray, limits: tuple[float, float]
) -> xr.Variable:
    """Return the shorter and the longer cutoff (..., end) in nm between which edges lie.

    At each cutoff the curve lies between `lowest` and `highest`, its interval. As more and more
    waves are removed, this interval is first inside the limits, then across one of them, and at
    last outside. The edge lies between the last cutoff inside and the first one outside. For
    example, on the short side, with limits of -0.1 and 0.1:

        cutoff               10 nm          20 nm          40 nm         80 nm
        lowest to highest    -0.01 to 0.02  -0.02 to 0.08  0.05 to 0.15  0.2 to 0.4
        the interval is      inside         inside         across        outside

    Here the edge lies between 20 and 80 nm. An end is NaN if the curve has no such cutoff; both are
    NaN if an interval is missing.
    """
    lower, upper = limits
    low, high = lowest.variable, highest.variable
    signed_cutoffs = _signed_cutoffs(curves)
    is_complete = ((low.notnull() & high.notnull()) | signed_cutoffs.isnull()).all(CUTOFF)
    signed_cutoffs = signed_cutoffs.where(is_complete)
    _, last_inside = _first_and_last_before(signed_cutoffs, (low < lower) | (high > upper))
    first_outside, before = _first_and_last_before(signed_cutoffs, (high < lower) | (low > upper))
    # An edge before the first cutoff has no interval.
    first_outside = first_outside.where(before.notnull())
    is_short = curves["side"].variable == "short"
    shorter = last_inside.where(is_short, first_outside)
    longer = first_outside.where(is_short, last_inside)
    return xr.Variable((*shorter.dims, "end"), abs(np.stack([shorter, longer], axis=-1)), NM)


def edges_of_ratios(ratios: xr.Dataset, tolerance: float) -> xr.Dataset:
    """Return the edges of ``filtered_force_ratio`` (..., cutoff_wavelength) of single surfaces."""
    ratio = ratios["filtered_force_ratio"]
    curves = xr.ufuncs.log(ratio)
    limits = logarithmic_limits(tolerance)
    edges = find_edges(curves, limits)
    if "filtered_force_ratio_interval" in ratios:
        interval = ratios["filtered_force_ratio_interval"]
        with np.errstate(divide="ignore"):  # the lower end of an interval without bounds is zero
            lowest, highest = (xr.ufuncs.log(interval.isel(end=end, drop=True)) for end in (0, 1))
        edges["edge_interval"] = edge_intervals(curves, lowest, highest, limits)
        edges = edges.assign_coords(end=ENDS)
    return remove_rippled_edges(edges, find_ripples(curves, limits))


def find_ripples(curves: xr.DataArray, limits: tuple[float, float]) -> xr.DataArray:
    """Return whether ripples of the filter, not the roughness, change curves of ln(ratio).

    A random surface without its short waves has lower summits, so that the force rises. A filter
    makes ripples near a step. They are summits that the scan does not have, so that the force
    falls. So a short edge is due to ripples if the force falls below the limits before it rises
    above them. Ripples do not spoil the long side, where the force may do either.
    """
    lower, upper = limits
    falls_at = curves[CUTOFF].where(curves < lower).min(CUTOFF)
    rises_at = curves[CUTOFF].where(curves > upper).min(CUTOFF)
    return falls_at.notnull() & ~(rises_at < falls_at) & (curves["side"] == "short")


def remove_rippled_edges(edges: xr.Dataset, are_rippled: xr.DataArray) -> xr.Dataset:
    """Return edges with the status `RIPPLES` instead of an edge where there are ripples."""
    status = edges["edge_status"].where(~are_rippled, EdgeStatus.RIPPLES)
    return edges.where(~are_rippled).assign(edge_status=status)


def computed_cutoffs(values: xr.DataArray) -> Floats:
    """Return the ascending cutoffs (nm) at which any value (..., cutoff_wavelength) is not NaN."""
    dimensions = [dim for dim in values.dims if dim != CUTOFF]
    return np.sort(values[CUTOFF].values[values.notnull().any(dimensions).values])


def last_cutoff(values: xr.DataArray, side: str) -> float:
    """Return the cutoff (nm) that removes most roughness; all values are of one side."""
    return float(computed_cutoffs(values)[-1 if side == "short" else 0])


def edges_or_bounds(edges: xr.Dataset) -> xr.DataArray:
    """Return the edges (..., side, group) in nm, with their bounds in place of open edges."""
    return edges["edge"].fillna(edges["edge_bound"])


def averaged_band(edges: xr.Dataset) -> tuple[float, float]:
    """Return both edges or bounds (nm) of the change averaged over all surfaces."""
    averaged_edges = edges_or_bounds(edges).sel(group=AVERAGED)
    return float(averaged_edges.sel(side="short")), float(averaged_edges.sel(side="long"))


def labelled_edges(
    edges: xr.Dataset, forces: xr.Dataset, tolerance: float, confidence: float
) -> xr.Dataset:
    """Return edges.nc: edges with label and source of each surface, and settings of the study."""
    return edges.assign(label=forces["label"], source=forces["source"]).assign_attrs(
        tolerance=tolerance,
        confidence=confidence,
        rho=forces.attrs["rho"],
        sphere_radius=forces.attrs["sphere_radius"],
    )


def edges_of_independent_masters(
    forces: xr.Dataset, tolerance: float, sampling: Sampling
) -> tuple[xr.Dataset, xr.DataArray]:
    """Return the edges of substitutes, with intervals from samples, and the sampled edges.

    Each master has a scan of its own, so the masters are independent, and intervals come from
    samples of the masters. The dataset also has the ratios and changes of the force. Its groups are
    the surfaces and the change averaged over them.
    Sampled edges are (1 + sample, ..., side, group). The first is the edge itself, NaN if it is
    open. In the samples the bound replaces an open edge.
    """
    seed_word = SEED_WORDS["forces on masters"]
    ratios = sampling.sample_means(seed_word, forces["filtered_force_ratio"], "realization")
    ratios = ratios.transpose("sample", ..., "side", "surface", CUTOFF)
    group_ratios = ratios.rename(surface="group")
    changes = abs(group_ratios - 1)
    # The mean over surfaces is that of |ratio - 1|, because signs would cancel.
    averaged_change = changes.mean("group", skipna=False).expand_dims(group=[AVERAGED], axis=-2)
    spectrum_ends = forces["spectrum_end"].rename(surface="group")
    group_edges = [
        find_edges(xr.ufuncs.log(group_ratios), logarithmic_limits(tolerance), spectrum_ends),
        find_edges(averaged_change, (-np.inf, tolerance), spectrum_ends.mean("group")),
    ]
    edges = xr.concat(group_edges, "group")
    sampled_edges = edges["edge"].where(edges["sample"] == 0, edges_or_bounds(edges))
    variables: dict[str, Any] = {}
    for name, values, attributes in (
        ("edge", sampled_edges, NM),
        ("filtered_force_change", xr.concat([changes, averaged_change], "group"), DIMENSIONLESS),
        ("filtered_force_ratio", ratios, DIMENSIONLESS),
    ):
        dimensions = [str(dim) for dim in values.dims[1:]]
        variables |= sampling.sampled_variables(name, dimensions, values.values, attributes)
    result = edges.isel(sample=0, drop=True).assign_coords(ratios.coords).assign(variables)
    return result, sampled_edges


def edges_of_shared_scans(
    forces: xr.Dataset,
    hindcast: xr.Dataset | None,
    master_scans: MasterScans,
    tolerance: float,
    confidence: float,
) -> xr.Dataset:
    """Return the edges of your surfaces, and their force ratios, with intervals.

    Masters share your few scans, so they are not independent, and intervals come from parts
    of the scans (`inference.scan_parts`), widened by the error of artificial roughness. Which of
    these edges the page gives, `report.own_surfaces.edges` decides.
    `forces` is filtered_forces.nc, `hindcast` hindcast.nc, or None if all surfaces are substitutes.
    """
    ratios = summarize_masters(
        forces, master_scans, lambda masters: _ratios_of_masters(masters, confidence)
    )
    if hindcast is not None:
        ratios = _widen_ratios(ratios, hindcast["hindcast_ratio"])
    edges = edges_of_ratios(ratios, tolerance)
    if hindcast is not None:
        # `find_ripples` has tested the masters. Artificial roughness lowers the forces on all
        # masters, filtered or not, so that ripples may change their ratio little. So the ratio
        # of the forces on the scans alone is tested, too.
        scan_ratio = hindcast["filtered_scan_ratio"].reindex(surface=edges["surface"])
        are_rippled = (edges["side"] == "short") & (scan_ratio < 1 - tolerance)
        edges = remove_rippled_edges(edges, are_rippled).transpose("surface", "side", ...)
    interval_source = ratios["interval_source"].isel(side=0, drop=True)
    return edges.merge(ratios.assign(interval_source=interval_source))


def _ratios_of_masters(master_forces: MasterForces, confidence: float) -> xr.Dataset:
    """Return the force ratios of one surface and side, with intervals and their source."""
    shifts = master_forces.forces.get("log_ratio_shift")
    half_width = half_width_over_masters(master_forces, mean_force_ratio, shifts, confidence)
    ratio = master_forces.forces.filtered_force_ratio.mean("realization").values
    interval = logarithmic_interval(ratio, half_width)
    return xr.Dataset(
        as_variables("filtered_force_ratio", CUTOFF, ratio, interval, DIMENSIONLESS, confidence)
        | {"interval_source": master_forces.scan_parts.interval_source},
        {CUTOFF: master_forces.forces[CUTOFF].variable},
    )


def _widen_ratios(ratios: xr.Dataset, hindcast_ratio: xr.DataArray) -> xr.Dataset:
    """Return ratios whose intervals contain the error of artificial roughness."""
    log_error = abs(np.log(hindcast_ratio.reindex(surface=ratios["surface"]).fillna(1)))
    # The error is at most the change by the filter.
    log_ratio = abs(np.log(ratios["filtered_force_ratio"]))
    return widen_interval(ratios, "filtered_force_ratio", np.exp(np.minimum(log_error, log_ratio)))
