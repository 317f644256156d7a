"""The long edge of the band from mirrored windows, beside that of whole random surfaces.

A window has no waves longer than its period, so that nothing is known of their removal: where a
window's force changes as soon as its longest waves go, the edge is open, and at least so long.
"""

from collections.abc import Mapping

import numpy as np
import xarray as xr

from hardcontact.own_surfaces.open_edges import edges_of_curves
from hardcontact.records.dataset import stack
from hardcontact.scales.critical_band import logarithmic_limits
from hardcontact.statistics import student_log_interval

__all__ = ["ratio_of_means", "window_edges"]


def ratio_of_means(
    forces: xr.DataArray, reference: xr.DataArray, confidence: float
) -> tuple[xr.DataArray, xr.DataArray]:
    """Return the mean force over realizations over that of a reference, with its interval.

    Parameters
    ----------
    forces, reference : xarray.DataArray
        (realization, ...) above zero.
    confidence : float
        Probability that the interval holds the ratio.

    Returns
    -------
    ratio, interval : xarray.DataArray
        (...) and (..., bound); the interval is that of the ratios of single realizations by
        Student's t of their logarithms, about the ratio of the means.
    """
    ratio = forces.mean("realization") / reference.mean("realization")
    single = forces / reference
    about = student_log_interval(single, confidence, "realization")
    return ratio.assign_attrs(units="1"), ratio * about / single.mean("realization")


def window_edges(
    forces: Mapping[str, xr.Dataset], tolerance: float, confidence: float
) -> xr.Dataset:
    """Return the long edges of the band from windows and whole surfaces, and the forces on them.

    Parameters
    ----------
    forces : mapping of str to xarray.Dataset
        By surface, of `filtered_window_forces`.
    tolerance : float
        Relative change of the force that counts.
    confidence : float
        Of the intervals.

    Returns
    -------
    xarray.Dataset
        Over surface, edge_size and cutoff_wavelength ``long_ratio``, the mean over realizations of
        the force without longer waves over that with all, with its interval; over surface and
        edge_size what `described_edge` says: ``long_edge``, ``long_edge_interval`` and
        ``long_edge_bound`` in nm, ``long_edge_at_least``, ``long_edge_status``,
        ``long_interval_status`` and ``long_edge_text``; and ``force_over_largest``, the force over
        that on the larger whole surface, with its interval; ``period`` and ``mirrored``
        (edge_size).
    """
    given = next(iter(forces.values()))[["period", "mirrored"]]
    measured = {(name,): one[["ratio", "pull_off_force"]] for name, one in forces.items()}
    stacked = stack(measured, ["surface"])
    ratio = stacked["ratio"].mean("realization", keep_attrs=True)
    interval = student_log_interval(stacked["ratio"], confidence, "realization")
    force = stacked["pull_off_force"]
    largest = force.isel(edge_size=-1, drop=True)
    over_largest, over_interval = ratio_of_means(force, largest, confidence)
    cells = given["period"].broadcast_like(over_largest).transpose(*over_largest.dims)
    curves = xr.Dataset(
        {"logarithm": np.log(ratio), "logarithm_interval": np.log(interval), "cell": cells}
    ).assign_coords(side="large")
    edges = edges_of_curves(curves, "logarithm", logarithmic_limits(tolerance))
    of_largest = {"units": "1", "long_name": "force over that on the larger whole surface"}
    return given.assign({f"long_{name}": edge for name, edge in edges.items()}).assign(
        long_ratio=ratio,
        long_ratio_interval=interval.assign_attrs(units="1"),
        force_over_largest=over_largest.assign_attrs(of_largest),
        force_over_largest_interval=over_interval.assign_attrs(of_largest, confidence=confidence),
    )
