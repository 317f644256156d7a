"""Pull-off force of a sphere that meets a substrate at the same place of its own many times.

It keeps the indents of the contacts before.
"""

from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from hardcontact.adhesion.all_surfaces import Described, with_names
from hardcontact.adhesion.force_sum import pull_off_force
from hardcontact.adhesion.pull_off import plastic_totals
from hardcontact.contact.bearing_area import Load, contact_pixel_count
from hardcontact.contact.geometry import Bodies
from hardcontact.contact.repeated_contact import (
    Indentation,
    IndentSizes,
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

    Each time, for a number of orders that the generator draws, a sphere without indents begins, and
    meets all places of the array in a random order.

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
    parts, indentation = {}, xr.Dataset()
    for order in range(orders):
        drawn = rng.permutation(len(places))
        parts[(order,)], about_deepest = _one_order(bodies, places[drawn], contact_pixels, adhesion)
        parts[(order,)]["single_pull_off_force"] = (
            "contact",
            _force(single.ravel()[drawn], bodies, adhesion),
            {"units": "N"},
        )
        if order == 0:
            indentation = about_deepest
    return (
        stack(parts, ["order"])
        .merge(indentation)
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
    totals, penetration, sizes = [], [], []
    for number, (total, one) in enumerate(
        repeated_totals(bodies, positions, contact_pixels, adhesion.rho), 1
    ):
        totals.append(total)
        penetration.append(one.contact.gaps[-1] - one.contact.gaps[0])
        if number in stages:
            sizes.append(indent_sizes(one.depth, pixel_size))
    of_stages = np.array([_summary(indents) for indents in sizes])
    last = sizes[-1]
    variables = {
        "pull_off_force": ("contact", _force(totals, bodies, adhesion), {"units": "N"}),
        "penetration": ("contact", penetration, {"units": "nm"}),
        "indent_depth": ("indent", last.depth, {"units": "nm"}),
        "indent_size": ("indent", last.lateral_size, {"units": "nm"}),
    } | {
        name: ("stage", of_stages[:, k], {"units": unit})
        for k, (name, unit) in enumerate(SUMMARY.items())
    }
    coordinates = {
        "contact": np.arange(1, contacts + 1),
        "stage": stages,
        "indent": np.arange(len(last.depth)),
    }
    return xr.Dataset(variables, coordinates), _map_about_deepest(one.depth, pixel_size)


def _summary(indents: IndentSizes) -> tuple[float, ...]:
    """Return the numbers of SUMMARY of all indents at one stage."""
    area = float((indents.edge_length**2).sum())
    largest = (float(values.max()) for values in indents)
    return (*largest, len(indents.depth), area)


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


def repeated_contact(
    pairs: Mapping[tuple[Any, ...], xr.Dataset], described: Described, confidence: float
) -> xr.Dataset:
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
    ratios = {"force_ratio": of_stages, "mean_ratio": whole}
    summary: dict[str, xr.DataArray] = {}
    for name, parts in ratios.items():
        ratio = parts["pull_off_force"] / parts["single_pull_off_force"]
        summary[name] = ratio.mean("scan").assign_attrs(units="1")
        summary[f"{name}_interval"] = student_log_interval(ratio, confidence, "scan")
    for name in SUMMARY:
        of_scans = stacked[name].mean("order", keep_attrs=True)
        summary[name] = of_scans.mean("scan", keep_attrs=True)
        interval = student_interval(of_scans, confidence, "scan")
        summary[f"{name}_interval"] = interval.clip(0, keep_attrs=True)
    drawn: dict[tuple[Any, ...], xr.Dataset] = {}
    for (*of_surface, _), pair in pairs.items():
        of_first = {"indentation": _centred(pair["indentation"])}
        drawn.setdefault(tuple(of_surface), xr.Dataset(of_first))
    return with_names(
        xr.Dataset(summary)
        .merge(stacked[["indent_depth", "indent_size"]])
        .merge(stack(drawn, dimensions[:2]))
        .assign_attrs({name: stacked.attrs[name] for name in COMMON}, confidence=confidence),
        described,
    )


def _centred(indentation: xr.DataArray) -> xr.DataArray:
    """Return a map with positions in nm from its middle, the same for every surface."""
    middle = {axis: indentation[axis] - indentation[axis].mean().item() for axis in "yx"}
    return indentation.assign_coords(middle)
