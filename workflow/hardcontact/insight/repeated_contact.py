"""A sphere that meets a substrate at the same place of its own many times, and keeps its indents.

Forces are those at the places of the array on a scan, beside those of a sphere without indents at
the same places. Indents are of places drawn at random on a large random surface of the same
spectrum: in a mirrored scan every summit would press its indent into the points of a lattice.
"""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from hardcontact.adhesion.all_surfaces import Described, Parts, of_first_scans, with_names
from hardcontact.adhesion.pull_off import plastic_totals, pull_off_force
from hardcontact.contact.bearing_area import Load, contact_pixel_count
from hardcontact.contact.geometry import Bodies, window_pixels
from hardcontact.contact.repeated_contact import (
    Indentation,
    indent_sizes,
    over_window,
    repeated_contacts,
)
from hardcontact.numbers.statistics import student_interval, student_log_interval
from hardcontact.records.dataset import stack
from hardcontact.surfaces.height_map import HeightMap
from hardcontact.surfaces.spectrum import Floats, Spectrum
from hardcontact.surfaces.synthesis import random_surface

#: Edge of the map (nm) about the deepest indent.
MAP = 2000.0
FROM_APEX = {"units": "nm", "long_name": "position from the apex"}
#: Numbers of contacts at which indents are measured, evenly on a logarithmic scale.
STAGES = 12
#: Attributes that all pairs share; their preloads differ.
COMMON = ("hardness", "rho", "work_of_adhesion")
#: What is measured of all indents at a stage: the greatest depth and lateral size, the median one,
#: their number and area, and this area over that of as many separate contacts.
SUMMARY = {
    "depth": "nm",
    "lateral_size": "nm",
    "median_size": "nm",
    "indents": "1",
    "indented_area": "nm2",
    "separate_share": "1",
}
#: Most pixels along an edge of a large surface.
LARGEST = 4096


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


def repeated_forces(
    bodies: Bodies, load: Load, adhesion: Adhesion, rng: np.random.Generator, orders: int
) -> xr.Dataset:
    """Return the forces of one place of a sphere that meets an array of places.

    For each of some orders, which the generator draws, a sphere without indents meets all places.
    By order and number of the contact: ``pull_off_force`` and, at the same place by a sphere
    without indents, ``single_pull_off_force`` (N).
    """
    positions = bodies.geometry.positions
    places = np.stack(np.meshgrid(positions, positions, indexing="ij"), -1).reshape(-1, 2)
    contact_pixels = contact_pixel_count(load, bodies.geometry.pixel_size)
    (single,) = plastic_totals(bodies, [contact_pixels], adhesion.rho)
    forces = []
    for _ in range(orders):
        drawn = rng.permutation(len(places))
        sums = repeated_totals(bodies, places[drawn], contact_pixels, adhesion.rho)
        totals = np.array([[total for total, _ in sums], single.ravel()[drawn]])
        forces.append(
            pull_off_force(totals, adhesion.rho, bodies.geometry.pixel_size, adhesion.work)
        )
    over, newton = ("order", "contact"), {"units": "N"}
    repeated, alone = np.stack(forces, axis=1)
    return xr.Dataset(
        {
            "pull_off_force": (over, repeated, newton),
            "single_pull_off_force": (over, alone, newton),
        },
        {"order": np.arange(orders), "contact": np.arange(1, len(places) + 1)},
        {**load, "rho": adhesion.rho, "work_of_adhesion": adhesion.work},
    )


def large_surface(
    rng: np.random.Generator, spectrum: Spectrum, size: float, pixel_size: float
) -> HeightMap:
    """Return a random surface of at most a size (nm), of at most LARGEST pixels along an edge."""
    pixels = min(window_pixels(size, pixel_size), LARGEST)
    return random_surface(rng, pixels, pixel_size, spectrum)


def indents_at_random_places(
    bodies: Bodies, load: Load, rng: np.random.Generator, contacts: int
) -> xr.Dataset:
    """Return the indents of one place of a sphere that meets random places of a substrate.

    By stage, a number of contacts: the quantities of SUMMARY. Of every indent after the last
    contact ``indent_depth`` and ``indent_size`` (indent) in nm, and about the deepest
    ``indentation`` (y, x) in nm.
    """
    pixel_size = bodies.geometry.pixel_size
    contact_pixels = contact_pixel_count(load, pixel_size)
    places = rng.integers(0, bodies.substrate.pixels, (contacts, 2))
    stages = np.unique(np.geomspace(1, contacts, STAGES).round().astype(int))
    summaries = []
    for number, one in enumerate(repeated_contacts(bodies, places, contact_pixels), 1):
        if number in stages:
            sizes = indent_sizes(one.depth, pixel_size)
            largest = float(sizes.depth.max()), float(sizes.lateral_size.max())
            area = float((sizes.edge_length**2).sum())
            summaries.append([*largest, np.median(sizes.lateral_size), len(sizes.depth), area])
    measured = np.transpose(summaries)
    # The first contact is that of a sphere without indents, and so are as many separate ones.
    measured = np.vstack([measured, measured[-1] / (stages * measured[-1, 0])])
    variables = {
        name: ("stage", values, {"units": unit})
        for (name, unit), values in zip(SUMMARY.items(), measured, strict=True)
    } | {
        "indent_depth": ("indent", sizes.depth, {"units": "nm"}),
        "indent_size": ("indent", sizes.lateral_size, {"units": "nm"}),
    }
    found = xr.Dataset(variables, {"stage": stages, "indent": np.arange(len(sizes.depth))})
    return found.merge(_map_about_deepest(one.depth, pixel_size))


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

    The pairs are `repeated_forces` with `indents_at_random_places`, by (surface, preload in N,
    scan). Intervals are by Student's t over scans: the orders of a scan count as one; those of
    sizes and numbers are cut at 0.

    With intervals, by surface and preload: ``force_ratio`` (stage), mean force of the contacts
    since the stage before over that of single contacts at the same places; ``mean_ratio`` of all
    contacts; the quantities of SUMMARY (stage). ``indent_depth`` and ``indent_size`` (scan,
    indent), and ``indentation`` (y, x) of the first scan.
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
        summary[name] = stacked[name].mean("scan", keep_attrs=True)
        interval = student_interval(stacked[name], confidence, "scan")
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
