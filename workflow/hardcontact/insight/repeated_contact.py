"""Pull-off force of a sphere that meets a substrate at the same place of its own many times.

It keeps the indents of the contacts before.
"""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from hardcontact.adhesion.all_surfaces import Described, Parts, of_first_scans, with_names
from hardcontact.adhesion.pull_off import plastic_totals, pull_off_force
from hardcontact.contact.bearing_area import Load, contact_pixel_count
from hardcontact.contact.geometry import Bodies
from hardcontact.contact.repeated_contact import (
    Indentation,
    indent_sizes,
    over_window,
    repeated_contacts,
)
from hardcontact.numbers.statistics import student_interval, student_log_interval
from hardcontact.records.dataset import stack

Floats = NDArray[np.float64]

#: Edge of the map (nm) about the deepest indent.
MAP = 2000.0
FROM_APEX = {"units": "nm", "long_name": "position from the apex"}
#: Numbers of contacts at which indents are measured, evenly on a logarithmic scale.
STAGES = 12
#: Attributes that all pairs share; their preloads differ.
COMMON = ("hardness", "rho", "work_of_adhesion")
#: What is measured of all indents at a stage; lengths and depth are the largest.
SUMMARY = {
    "depth": "nm",
    "edge_length": "nm",
    "lateral_size": "nm",
    "indents": "1",
    "indented_area": "nm2",
}


class _Attraction:
    """Sums of exp(-g/rho) at the contacts of a sphere whose roughness changes.

    The factor of the substrate is computed once, that of the sphere is changed where it is indented
    alone; a contact is a product of both. Indented pixels touch, so that their gap of zero counts
    as any other and no pixel is left out.
    """

    def __init__(self, bodies: Bodies, rho: float) -> None:
        whole = over_window(bodies)
        assert whole.roughness is not None
        self.geometry, self.rho, self.pixels = bodies.geometry, rho, bodies.substrate.pixels
        offset = bodies.geometry.offsets()
        shape = bodies.geometry.paraboloid(offset)
        self.heights = np.fft.fftshift(whole.roughness.heights) - shape[:, None] - shape
        h_max, self.t_max = float(bodies.substrate.heights.max()), float(self.heights.max())
        self.highest = h_max + self.t_max
        of_substrate = np.exp((bodies.substrate.heights.astype(float) - h_max) / rho)
        self.of_substrate = np.tile(of_substrate, (2, 2))
        #: Pixel of the substrate below each offset, for the apex at the origin.
        self.folded = offset % self.pixels
        self.of_sphere = np.zeros((self.pixels,) * 2)
        np.add.at(
            self.of_sphere,
            np.ix_(self.folded, self.folded),
            np.exp((self.heights - self.t_max) / rho),
        )

    def total(self, position: NDArray[np.int_], indentation: Indentation) -> float:
        """Return the sum at the closest approach of a contact that has indented the sphere."""
        offsets = indentation.contact.offsets
        self._indent(offsets, indentation.depth)
        (y, x), pixels = position % self.pixels, self.pixels
        seen = self.of_substrate[y : y + pixels, x : x + pixels]
        approach = indentation.contact.gaps[-1]
        product = np.einsum("ij,ij", seen, self.of_sphere)
        return float(np.exp((approach + self.highest) / self.rho) * product)

    def _indent(self, offsets: NDArray[np.int_], depth: Floats) -> None:
        """Compute the factor of the sphere anew where it is indented, from all periodic images."""
        window, pixels = self.geometry.window, self.pixels
        places = np.unique((offsets % pixels), axis=0)
        first = (places + window // 2) % pixels
        reach = np.arange(-(-window // pixels)) * pixels
        rows, columns = (first[:, axis, None] + reach for axis in (0, 1))
        inside = (rows < window)[:, :, None] & (columns < window)[:, None, :]
        at = np.minimum(rows, window - 1)[:, :, None], np.minimum(columns, window - 1)[:, None, :]
        terms = np.exp((self.heights[at] - depth[at] - self.t_max) / self.rho)
        self.of_sphere[tuple(places.T)] = np.where(inside, terms, 0.0).sum(axis=(1, 2))


def repeated_totals(
    bodies: Bodies, positions: NDArray[np.int_], contact_pixels: int, rho: float
) -> Iterator[tuple[float, Indentation]]:
    """Press one place of a sphere onto places of a substrate, and sum exp(-gap/rho) at each.

    `positions` (contacts, 2) are the pixels (row, column) of the substrate under the apex. Yields
    the total at plastic closest approach, with the sphere as all contacts so far have left it, and
    the indentation of the contact.
    """
    attraction = _Attraction(bodies, rho)
    contacts = repeated_contacts(bodies, positions, contact_pixels)
    for position, indentation in zip(positions, contacts, strict=True):
        yield attraction.total(position, indentation), indentation


class Adhesion(NamedTuple):
    """Range of adhesion (nm) and work of adhesion (J/m²)."""

    rho: float
    work: float


def repeated_contact_of_pair(
    bodies: Bodies, load: Load, adhesion: Adhesion, rng: np.random.Generator, orders: int
) -> xr.Dataset:
    """Return the forces and the indents of one place of a sphere that meets an array of places.

    For each of some orders, which the generator draws, a sphere without indents meets all places.

    By order and number of the contact: ``pull_off_force`` and, at the same place by a sphere
    without indents, ``single_pull_off_force`` (N), ``penetration`` (nm). By order and stage, a
    number of contacts: ``depth``, ``edge_length`` and ``lateral_size`` (nm), each the largest of
    all indents, ``indents`` and ``indented_area`` (nm2). By order and indent of the last contact
    ``indent_depth`` and ``indent_size`` (nm). ``indentation`` (y, x) about the deepest indent of
    the first order (nm).
    """
    positions = bodies.geometry.positions
    places = np.stack(np.meshgrid(positions, positions, indexing="ij"), -1).reshape(-1, 2)
    contact_pixels = contact_pixel_count(load, bodies.geometry.pixel_size)
    (single,) = plastic_totals(bodies, [contact_pixels], adhesion.rho)
    parts, maps = {}, []
    for order in range(orders):
        drawn = rng.permutation(len(places))
        part, about_deepest = _one_order(bodies, places[drawn], contact_pixels, adhesion)
        force = _force(single.ravel()[drawn], bodies, adhesion)
        parts[(order,)] = part.assign(single_pull_off_force=("contact", force, {"units": "N"}))
        maps.append(about_deepest)
    return (
        stack(parts, ["order"])
        .merge(maps[0])
        .assign_attrs(load, rho=adhesion.rho, work_of_adhesion=adhesion.work)
    )


def _force(total: ArrayLike, bodies: Bodies, adhesion: Adhesion) -> Floats:
    """Return pull-off forces in N."""
    return pull_off_force(total, adhesion.rho, bodies.geometry.pixel_size, adhesion.work)


def _one_order(
    bodies: Bodies, positions: NDArray[np.int_], contact_pixels: int, adhesion: Adhesion
) -> tuple[xr.Dataset, xr.Dataset]:
    """Return forces and indents of one order of contacts, and their map about the deepest."""
    contacts, pixel_size = len(positions), bodies.geometry.pixel_size
    stages = np.unique(np.geomspace(1, contacts, STAGES).round().astype(int))
    totals, penetration, summaries = [], [], []
    for number, (total, one) in enumerate(
        repeated_totals(bodies, positions, contact_pixels, adhesion.rho), 1
    ):
        totals.append(total)
        penetration.append(one.contact.gaps[-1] - one.contact.gaps[0])
        if number in stages:
            sizes = indent_sizes(one.depth, pixel_size)
            largest = (float(values.max()) for values in sizes)
            summaries.append([*largest, len(sizes.depth), float((sizes.edge_length**2).sum())])
    of_stages = zip(SUMMARY.items(), np.transpose(summaries), strict=True)
    variables = {
        "pull_off_force": ("contact", _force(totals, bodies, adhesion), {"units": "N"}),
        "penetration": ("contact", penetration, {"units": "nm"}),
        "indent_depth": ("indent", sizes.depth, {"units": "nm"}),
        "indent_size": ("indent", sizes.lateral_size, {"units": "nm"}),
    } | {name: ("stage", values, {"units": unit}) for (name, unit), values in of_stages}
    coordinates = {
        "contact": np.arange(1, contacts + 1),
        "stage": stages,
        "indent": np.arange(len(sizes.depth)),
    }
    return xr.Dataset(variables, coordinates), _map_about_deepest(one.depth, pixel_size)


def _map_about_deepest(depth: Floats, pixel_size: float) -> xr.Dataset:
    """Return the part of a map (n, n) of depths in nm about its deepest pixel."""
    reach = min(round(MAP / pixel_size), len(depth)) // 2
    deepest = np.unravel_index(depth.argmax(), depth.shape)
    first = [min(max(int(place) - reach, 0), len(depth) - 2 * reach) for place in deepest]
    part = depth[first[0] : first[0] + 2 * reach, first[1] : first[1] + 2 * reach]
    axes = {
        axis: (axis, (start + np.arange(2 * reach) - len(depth) // 2) * pixel_size, FROM_APEX)
        for axis, start in zip("yx", first, strict=True)
    }
    return xr.Dataset({"indentation": (("y", "x"), part.copy(), {"units": "nm"})}, axes)


def repeated_contact(pairs: Parts, described: Described, confidence: float) -> xr.Dataset:
    """Return the force and the indents of repeated contact against the number of contacts.

    The pairs are of `repeated_contact_of_pair`, by (surface, preload in N, scan). Intervals are by
    Student's t over scans: the orders of a scan count as one; those of sizes and numbers are cut at
    0.

    With intervals, by surface and preload: ``force_ratio`` (stage), mean force of the contacts
    since the stage before over that of single contacts at the same places; ``mean_ratio`` of all
    contacts; ``depth``, ``edge_length``, ``lateral_size``, ``indents`` and ``indented_area``
    (stage). ``indent_depth`` and ``indent_size`` (scan, order, indent), and ``indentation`` (y, x)
    of the first scan.
    """
    dimensions = ["surface", "preload", "scan"]
    stacked = stack({key: pair.drop_vars("indentation") for key, pair in pairs.items()}, dimensions)
    forces = stacked[["pull_off_force", "single_pull_off_force"]]
    group = np.searchsorted(stacked["stage"].values, stacked["contact"].values)
    grouped = forces.groupby(xr.DataArray(group, dims="contact", name="group"))
    of_stages = grouped.sum(["contact", "order"], min_count=1)
    of_stages = of_stages.rename(group="stage").assign_coords(stage=stacked["stage"])
    whole = forces.sum(["contact", "order"], min_count=1)
    summary: dict[str, xr.DataArray] = {}
    for name, parts in {"force_ratio": of_stages, "mean_ratio": whole}.items():
        ratio = parts["pull_off_force"] / parts["single_pull_off_force"]
        ratio.attrs["units"] = "1"
        summary[name] = ratio.mean("scan").assign_attrs(units="1")
        summary[f"{name}_interval"] = student_log_interval(ratio, confidence, "scan")
    for name in SUMMARY:
        of_scans = stacked[name].mean("order", keep_attrs=True)
        summary[name] = of_scans.mean("scan", keep_attrs=True)
        interval = student_interval(of_scans, confidence, "scan")
        summary[f"{name}_interval"] = interval.clip(0, keep_attrs=True)
    first = of_first_scans(pairs, ["indentation"])
    drawn = stack({key: _centred(one) for key, one in first.items()}, dimensions[:2])
    return with_names(
        xr.Dataset(summary)
        .merge(stacked[["indent_depth", "indent_size"]])
        .merge(drawn)
        .assign_attrs({name: stacked.attrs[name] for name in COMMON}, confidence=confidence),
        described,
    )


def _centred(mapped: xr.Dataset) -> xr.Dataset:
    """Return a map with positions in nm from its middle, the same for every surface."""
    return mapped.assign_coords({axis: mapped[axis] - mapped[axis].mean().item() for axis in "yx"})
