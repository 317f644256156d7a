"""One master on finer and finer pixels: what the roughness below the pixels of a study does.

The coarser masters hold the waves of the finest up to their own pixels, and no other realization.
"""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from hardcontact.contact.bearing_area import ContactSettings
from hardcontact.numbers.statistics import jackknife_interval, with_interval
from hardcontact.records.job import progress
from hardcontact.scales.critical_band import Curve, described_edge, logarithmic_limits
from hardcontact.scales.filtered_masters import filtered_pull_off
from hardcontact.surfaces.filters import filtered
from hardcontact.surfaces.height_map import HeightMap

#: Blocks of contacts along an edge of the array, which intervals are taken over.
BLOCKS = 4
NANOMETRES = {"units": "nm"}


class FinerMaster(NamedTuple):
    """What a master is compared at."""

    pixels: Sequence[int]  #: Along an edge, ascending; the last are those of the master.
    #: Wavelengths in nm below which roughness is removed, ascending, each of more than two of the
    #: coarsest pixels.
    cutoffs: Sequence[float]
    radius: float  #: Of the sphere in nm.
    rho: float  #: Range of adhesion in nm.
    contact: ContactSettings
    tolerance: float  #: Change of the force that counts as none.
    confidence: float


def on_coarser_pixels(master: HeightMap, pixels: int) -> HeightMap:
    """Return the waves of a master that so many pixels (even) hold: orders below half of them."""
    if pixels == master.pixels:
        return master
    shortest = master.size / (pixels // 2 - 1)
    return filtered(master, "small", shortest, pixels)


def on_several_pixels(master: HeightMap, given: FinerMaster) -> xr.Dataset:
    """Compare the force without the shortest waves on a periodic master and on coarser pixels.

    By ``pixels``: ``pull_off_force`` (cutoff_wavelength, contact_y, contact_x) and
    ``unfiltered_pull_off_force`` in N, ``pixel_size`` in nm; with intervals ``ratio``
    (cutoff_wavelength) of their means, ``force_over_finest`` and ``filtered_over_finest``
    (cutoff_wavelength), the means over those of the finest pixels, and ``edge``, the short edge of
    the band in nm. Intervals are those of a jackknife over blocks of contacts. They tell how the
    added roughness differs from place to place; all contacts share the waves of one scan.
    """
    each = progress(given.pixels, len(given.pixels), "pixels")
    forces = np.array([_forces(on_coarser_pixels(master, pixels), given) for pixels in each])
    newton, axes = {"units": "N"}, ("contact_y", "contact_x")
    variables: dict[str, Any] = {
        "unfiltered_pull_off_force": (("pixels", *axes), forces[:, 0], newton),
        "pull_off_force": (("pixels", "cutoff_wavelength", *axes), forces[:, 1:], newton),
        "pixel_size": ("pixels", master.size / np.array(given.pixels), NANOMETRES),
    }
    confidence = given.confidence
    mean, without = forces.mean(axis=(-2, -1)), _without_blocks(forces)
    of_cutoffs = ("pixels", "cutoff_wavelength")
    for name, dims, filtered_or_whole, reference in (
        ("ratio", of_cutoffs, np.s_[..., 1:], np.s_[..., :1]),
        ("force_over_finest", "pixels", np.s_[..., 0], np.s_[..., -1:, 0]),
        ("filtered_over_finest", of_cutoffs, np.s_[..., 1:], np.s_[..., -1:, 1:]),
    ):
        value, left_out = (one[filtered_or_whole] / one[reference] for one in (mean, without))
        interval = jackknife_interval(value, left_out, confidence)
        variables |= with_interval(name, dims, value, interval, {"units": "1"}, confidence)
        if name == "ratio":
            variables |= _edges(value, interval, given)
    return xr.Dataset(
        variables,
        {
            "pixels": ("pixels", list(given.pixels), {"units": "1"}),
            "cutoff_wavelength": ("cutoff_wavelength", list(given.cutoffs), NANOMETRES),
        },
        {"rho": given.rho, "scale_tolerance": given.tolerance, "confidence": confidence},
    )


def _forces(master: HeightMap, given: FinerMaster) -> np.ndarray:
    """Return the forces (1 + cutoff, contact, contact) in N, of all roughness first."""
    contact = given.contact
    found = filtered_pull_off(
        master,
        None,
        {
            "side": "small",
            "scales": {"pixels": master.pixels, "cutoffs": list(given.cutoffs)},
            "radius": given.radius,
            "rho": given.rho,
            "window": contact["window"],
            "count": contact["count"],
            "loads": [{"name": "", "preload": contact["preload"], "hardness": contact["hardness"]}],
        },
    ).isel(load=0)
    return np.array([found["unfiltered_pull_off_force"], *found["pull_off_force"]])


def _without_blocks(forces: np.ndarray) -> np.ndarray:
    """Return means (block, pixels, 1 + cutoff) of all contacts but those of one block."""
    count = forces.shape[-1]
    block = np.arange(count) * BLOCKS // count
    of_contact = block[:, None] * BLOCKS + block
    return np.array([forces[..., of_contact != k].mean(axis=-1) for k in np.unique(of_contact)])


def _edges(ratio: np.ndarray, interval: np.ndarray, given: FinerMaster) -> dict[str, Any]:
    """Return the short edges of curves (pixels, cutoff)."""
    limits, cutoffs = logarithmic_limits(given.tolerance), np.array(given.cutoffs)
    edges = [
        described_edge(Curve("small", np.inf, cutoffs, np.log([value, *ends.T]), limits))
        for value, ends in zip(ratio, interval, strict=True)
    ]
    values, ends = ([edge[name] for edge in edges] for name in ("edge", "edge_interval"))
    return with_interval("edge", "pixels", values, ends, NANOMETRES, given.confidence)
