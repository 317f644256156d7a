"""Mean forces on your scans and on masters made of them, and the widths of their intervals.

A master is a scan with artificial roughness, which differs between realizations. So the mean over
realizations varies with the scans and, on the same scans, with the random numbers.
"""

from collections.abc import Callable, Mapping
from typing import NamedTuple

import numpy as np
import xarray as xr

from hardcontact.base.arrays import Floats
from hardcontact.base.dataset import stack
from hardcontact.contact.contact import CONTACT_AXES
from hardcontact.inference.scan_parts import (
    ScanParts,
    Variance,
    delete_one_logarithms,
    fewest_touched_patches,
    interval_half_width,
    jackknife_variance,
    parts_of_scans,
    quarters_of_contacts,
)
from hardcontact.surfaces.synthesis import master_scan_index

#: Largest half width of the interval of a logarithm: more than a factor of 1000 is of no use.
MAX_BOUNDED_HALF_WIDTH = float(np.log(1e3))
#: Dimensions over which the forces of single contacts on one surface differ.
SINGLE_CONTACT_AXES = ["scan", "sphere_scan", *CONTACT_AXES]


class SurfaceForces(NamedTuple):
    """Mean forces of one surface in one contact model, over scans of both bodies and contacts."""

    ranges: Floats  #: (rho,) Ranges of adhesion in nm.
    mean: Floats  #: (rho,) Mean in N of the forces in `forces_of_surface`, at their work.
    delete_one_log_means: Floats  #: (rho, part) Logarithms of the mean over all parts but one.
    scan_parts: list[ScanParts]  #: (rho,) The same parts, but with a correlation for each range.
    log_force_std: Floats  #: (rho,) Standard deviation of ln F over single contacts.
    #: (rho,) Variance of ln F from the computed mean to a new position; None for one position.
    position_variance: Variance | None


def forces_of_surface(
    forces: xr.DataArray, scan_size: float, radius: float, touched_patches: float
) -> SurfaceForces:
    """Return the mean forces of one surface and contact model.

    Forces (scan, sphere_scan, rho, contact_y, contact_x) are in N, NaN where a scan is missing;
    lengths are in nm.
    """
    scan_forces = forces.dropna("scan", how="all").mean("sphere_scan")
    scan_forces = scan_forces.transpose("scan", "rho", *CONTACT_AXES)
    scans = np.arange(scan_forces.sizes["scan"])
    quarters = quarters_of_contacts(scan_forces.sizes["contact_y"], 1)
    scan_parts = [
        parts_of_scans(scans, quarters, 2 * scan_size, np.sqrt(radius * rho), touched_patches)
        for rho in scan_forces.rho.values
    ]
    delete_one_log_means = delete_one_logarithms(
        scan_parts[0], "scan", lambda kept: scan_forces.where(kept).mean(CONTACT_AXES).mean("scan")
    )
    mean = scan_forces.mean(CONTACT_AXES).mean("scan").values
    log_force_std = xr.ufuncs.log(forces).std(SINGLE_CONTACT_AXES).values
    return SurfaceForces(
        scan_forces.rho.values, mean, delete_one_log_means.T, scan_parts, log_force_std,
        _position_variance(forces),
    )  # fmt: skip


def forces_by_surface(
    adhesion: xr.Dataset, scan_sizes: Mapping[str, float]
) -> dict[str, SurfaceForces]:
    """Return the forces of each surface in one contact model; scan sizes are in nm."""
    radius = float(adhesion.attrs["sphere_radius"])
    return {
        name: forces_of_surface(
            adhesion.pull_off_force.sel(surface=name), scan_sizes[name], radius, touched_patches
        )
        for name, touched_patches in fewest_touched_patches(adhesion).items()
    }


def _position_variance(forces: xr.DataArray) -> Variance | None:
    """Return the `position_variance` of SurfaceForces."""
    count = forces.sizes["sphere_scan"]
    if count < 2:
        return None
    # The variance of one position and that of the mean over the computed positions add.
    position_means = forces.mean(["scan", *CONTACT_AXES]).transpose("rho", "sphere_scan").values
    return Variance((1 + 1 / count) * np.log(position_means).var(axis=1, ddof=1), count - 1)


def position_half_width(surface_forces: SurfaceForces, confidence: float) -> Floats | None:
    """Return the half width (rho,) of ln(mean) from the unknown position of a rough sphere."""
    variance = surface_forces.position_variance
    return None if variance is None else interval_half_width([variance], confidence)


def mean_intervals(surface_forces: SurfaceForces, confidence: float) -> Floats:
    """Return the intervals (rho, 2) of the mean forces of one surface, in N.

    Half widths from scan parts and from the position of a rough sphere add in squares, so that the
    latter is the one that `position_half_width` gives to other intervals.
    """
    log_means_and_parts = zip(
        surface_forces.delete_one_log_means, surface_forces.scan_parts, strict=True
    )
    variances = [
        jackknife_variance(log_means, scan_parts) for log_means, scan_parts in log_means_and_parts
    ]
    half_widths = np.array([interval_half_width([variance], confidence) for variance in variances])
    position_half_widths = position_half_width(surface_forces, confidence)
    if position_half_widths is not None:
        half_widths = np.hypot(half_widths, position_half_widths)
    return logarithmic_interval(surface_forces.mean, half_widths)


def logarithmic_interval(value: Floats, log_half_width: Floats) -> Floats:
    """Return the interval (..., 2) of a positive value from the half width of its logarithm.

    It reaches from zero to infinity if the half width exceeds MAX_BOUNDED_HALF_WIDTH.
    """
    bounded = value[..., None] * np.exp(np.stack([-log_half_width, log_half_width], axis=-1))
    return np.where((log_half_width > MAX_BOUNDED_HALF_WIDTH)[..., None], [0.0, np.inf], bounded)


class MasterScans(NamedTuple):
    """The scans of masters, which take them in turn (`surfaces.synthesis.master_scan_index`)."""

    scan_counts: Mapping[str, int]  #: By surface.
    tiles: int  #: Mirrored scans per row of a long-edge master.
    touched_patches: Mapping[str, float]  #: From `fewest_touched_patches`.


class MasterForces(NamedTuple):
    """Forces on the masters of one surface and side."""

    #: ``pull_off_force`` (realization, cutoff_wavelength, contact_y, contact_x) and
    #: ``unfiltered_pull_off_force`` (realization, contact_y, contact_x), in N at 1 J/m², and the
    #: ``filtered_force_ratio`` of their means over contacts.
    forces: xr.Dataset
    scan_parts: ScanParts


def select_masters(
    filtered_forces: xr.Dataset, surface: str, side: str, master_scans: MasterScans
) -> MasterForces:
    """Return the forces on the masters of one surface and side from filtered_forces.nc."""
    # The spectrum of an unfiltered long-edge master ends at the width of the master.
    master_size = float(filtered_forces.spectrum_end.sel(surface=surface, side="long"))
    tiles = master_scans.tiles if side == "long" else 1
    forces = filtered_forces.sel(surface=surface, side=side).dropna(
        "realization", how="all", subset=["filtered_force_ratio"]
    )
    scan_count = master_scans.scan_counts[surface]
    scan_parts = parts_of_scans(
        np.array([master_scan_index(number, scan_count) for number in forces.realization.values]),
        quarters_of_contacts(forces.sizes["contact_y"], tiles),
        master_size / master_scans.tiles,  # the width of a tile, which is a mirrored scan
        float(np.sqrt(filtered_forces.attrs["sphere_radius"] * filtered_forces.attrs["rho"])),
        master_scans.touched_patches[surface],
    )
    return MasterForces(forces, scan_parts)


def summarize_masters(
    forces: xr.Dataset, master_scans: MasterScans, summary: Callable[[MasterForces], xr.Dataset]
) -> xr.Dataset:
    """Return a summary (surface, side, ...) of the forces of filtered_forces.nc."""
    summaries = {
        (surface, side): summary(select_masters(forces, surface, side, master_scans))
        for surface in forces.surface.values.tolist()
        for side in forces.side.values.tolist()
    }
    return stack(summaries, ["surface", "side"])


def mean_unfiltered_force(forces: xr.Dataset, kept_contacts: xr.DataArray) -> xr.DataArray:
    """Return the mean force (realization,) over the kept contacts of each unfiltered master."""
    return xr.DataArray(forces.unfiltered_pull_off_force.where(kept_contacts).mean(CONTACT_AXES))


def mean_force_ratio(forces: xr.Dataset, kept_contacts: xr.DataArray) -> xr.DataArray:
    """Return the ratio (realization, cutoff_wavelength) of filtered to unfiltered mean forces."""
    filtered_force = xr.DataArray(forces.pull_off_force.where(kept_contacts).mean(CONTACT_AXES))
    ratio = filtered_force / mean_unfiltered_force(forces, kept_contacts)
    return ratio.transpose("realization", ...)


def half_width_over_masters(
    master_forces: MasterForces,
    statistic: Callable[[xr.Dataset, xr.DataArray], xr.DataArray],
    shifts: xr.DataArray | None,
    confidence: float,
) -> Floats:
    """Return the half width (...) of the interval of the logarithm of a statistic over masters.

    The statistic is `mean_force_ratio` or `mean_unfiltered_force`. `shifts` (realization, ...) are
    the changes of its logarithm on masters of sampled spectra
    (`forces_on_masters.add_spectrum_shifts`), None if no spectra are sampled. Up to three
    independent variances of the logarithm add:

    1. other scans: the jackknife over parts of the scans;
    2. other random numbers on the same scans: the scatter over realizations. Only quarters miss
       it; among scans the jackknife contains it, because each scan has its own random numbers;
    3. another spectrum within its uncertainty: the mean square of the shifts, if there are any.
    """
    forces, scan_parts = master_forces

    delete_one_log_means = delete_one_logarithms(
        scan_parts, "realization", lambda kept: statistic(forces, kept).mean("realization")
    )
    variances = [jackknife_variance(delete_one_log_means, scan_parts)]
    count = forces.sizes["realization"]
    if scan_parts.are_quarters and count > 1:
        logarithms = np.log(statistic(forces, xr.DataArray(True)).values)
        variances.append(Variance(logarithms.var(axis=0, ddof=1) / count, count - 1))
    if shifts is not None and shifts.notnull().any():
        # A shift is the change of the logarithm by one sampled spectrum; shifts scatter about zero.
        variances.append(Variance((shifts**2).mean("realization").values, count))
    return interval_half_width(variances, confidence)
