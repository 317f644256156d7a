"""Checks that the names and values of a study agree with each other, its tables and its scans.

They refuse before any job starts what could only fail later. Every fault is one line: the key or
row, what was expected, what was found.
"""

import math
import os
from collections.abc import Callable, Collection, Iterator
from functools import partial
from itertools import chain, pairwise, product
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from hardcontact.config.configuration import NONE, PAPER, SMOOTH, Limit, refuse_all, refuse_first
from hardcontact.config.grids import MAP_PIXELS, PIXEL_SIZES, Grid
from hardcontact.config.limits import check_grids
from hardcontact.config.patterns import PUBLISHED
from hardcontact.config.selection import CONTACT
from hardcontact.config.tables import measured_forces, refuse_description, refuse_of_paper
from hardcontact.records import published
from hardcontact.surfaces.scans import read_measurement, read_scan
from hardcontact.surfaces.spectral_models import is_calibrated
from hardcontact.surfaces.substitute_spectra import described_rms_height
from hardcontact.surfaces.synthesis import SIDES

#: Upper bound on the differences in height between contacts on a substitute for a surface of the
#: paper, in nm: five times the rms height of the roughest.
SUBSTITUTE_RELIEF = 500.0
#: The same bound over the rms height of all waves of a domain: 3.7 was found at most on 24 random
#: surfaces of 10 to 40 um, from descriptions of 18 to 850 nm rms; a fifth more for others.
RELIEF_OVER_RMS = 4.5


def check(config: dict[str, Any], table: pd.DataFrame, compared: Collection[str]) -> None:
    """Refuse a study that cannot be computed; measured scans are read once all names are known.

    As a ValueError of one line a fault, naming the key or the file: names of surfaces or scans that
    are not in the table, values that contradict each other, unusable scans, wavelengths, windows
    and loads that the pixels do not permit. The configuration has numbers, the table is that of
    `selection.selected_scans`, and surfaces that are compared have a published pull-off force.
    """
    contacts, of_paper = table[table.use == CONTACT], config["published"] == PAPER
    limits = chain(
        _of_sphere(config, contacts),
        _ascending(config),
        _of_scan_sizes(config),
        _of_effort_and_names(config),
    )
    more = _limits_of_paper(config, contacts, compared) if of_paper else ()
    refuse_all(
        [
            *(partial(refuse_first, [one]) for one in limits),
            *_descriptions(table),
            *(partial(refuse_first, [one]) for one in more),
            *(() if of_paper else _checks_of_own_surfaces(config, table)),
        ]
    )
    grids: dict[str, Grid] = {}

    def read(surface: str, rows: pd.DataFrame) -> None:
        grids[surface] = surface_grid(config, surface, rows)

    of_surfaces = contacts.groupby("surface", sort=False)
    refuse_all(partial(read, str(surface), rows) for surface, rows in of_surfaces)
    check_grids(config, grids)


def _of_sphere(config: dict[str, Any], table: pd.DataFrame) -> Iterator[Limit]:
    """Give the limit of a sphere: a surface of the table, or smooth without roughness."""
    surfaces, sphere = list(table.surface.unique()), config["sphere"]["surface"]
    if config["published"] != PAPER and sphere == SMOOTH:
        rough = config["scales"]["sphere_roughness"]
        expected = f"false with sphere.surface: {SMOOTH}"
        yield Limit(not rough, "scales.sphere_roughness", expected, "true")
    else:
        yield _one_of("sphere.surface", sphere, surfaces)


def _one_of(key: str, surface: str, known: list[str]) -> Limit:
    """Return the limit of the name of a surface: it is one of those in the table."""
    expected = f"one of {', '.join(known)}, surfaces of the table"
    return Limit(surface in known, key, expected, surface)


def _ascending(config: dict[str, Any]) -> Iterator[Limit]:
    """Give the limits of lists of quantities: they ascend, in whatever units they are written."""
    insight, robustness = config["insight"], config["robustness"]
    lists = [
        (f"{section}.ranges", config[section]["ranges"], "nm")
        for section in ("adhesion", "asperities", "insight")
    ]
    of_masters = {name: config[name] for name in ("scales", "sets", "insight")}
    of_masters["insight.scaling"] = insight["scaling"]
    lists += [
        (f"{section}.{side}.cutoffs", values[side]["cutoffs"], "nm")
        for (section, values), side in product(of_masters.items(), SIDES)
    ]
    lists += [
        ("insight.sizes", insight["sizes"], "nm"),
        ("insight.scaling.radii", insight["scaling"]["radii"], "nm"),
        ("insight.scaling.ranges", insight["scaling"]["ranges"], "nm"),
        ("insight.scan_sizes.radii", insight["scan_sizes"]["radii"], "nm"),
        ("insight.scan_sizes.ranges", insight["scan_sizes"]["ranges"], "nm"),
        ("insight.scan_sizes.sizes", insight["scan_sizes"]["sizes"], "nm"),
        ("insight.scan_sizes.edges.cutoffs", insight["scan_sizes"]["edges"]["cutoffs"], "nm"),
        ("insight.scaling.preloads", insight["scaling"]["preloads"], "N"),
        ("indent.preloads", config["indent"]["preloads"], "N"),
        ("robustness.preloads", robustness["preloads"], "N"),
        ("robustness.hardnesses", robustness["hardnesses"], "Pa"),
        ("robustness.tip.radii", robustness["tip"]["radii"], "nm"),
    ]
    for key, values, unit in lists:
        for smaller, larger in pairwise(values):
            if smaller >= larger:
                found = f"{larger:.12g} {unit} after {smaller:.12g} {unit}"
                yield Limit(False, key, "ascending values", found)
                break


def _of_scan_sizes(config: dict[str, Any]) -> Iterator[Limit]:
    """Give the limits of windows, smaller than their surfaces, and of larger whole surfaces."""
    given = config["insight"]["scan_sizes"]
    size, cutoffs = given["size"], given["edges"]["cutoffs"]
    whole, window, pixel_size = given["edges"]["size"], max(given["sizes"]), size / given["pixels"]
    largest, key = MAP_PIXELS * pixel_size, "insight.scan_sizes"
    less = f"less than insight.scan_sizes.size ({size:.6g} nm)"
    yield Limit(window < size, f"{key}.sizes", less, f"{window:.6g} nm")
    more = (
        f"more than insight.scan_sizes.size ({size:.6g} nm) and at most {MAP_PIXELS} of its pixels "
        f"({largest:.6g} nm)"
    )
    fits = size < whole <= largest
    yield Limit(fits, f"{key}.edges.size", more, f"{whole:.6g} nm")
    within = (
        f"more than two pixels ({2 * pixel_size:.4g} nm) and at most insight.scan_sizes.size "
        f"({size:.6g} nm)"
    )
    wrong = [one for one in cutoffs if not 2 * pixel_size * (1 + 1e-9) < one <= size]
    if fits and wrong:
        yield Limit(False, f"{key}.edges.cutoffs", within, f"{wrong[0]:.6g} nm")


def _of_effort_and_names(config: dict[str, Any]) -> Iterator[Limit]:
    """Give the limits of the effort, of folders, and of values that stand in names."""
    no_keys = (
        "full where no keys stand under quick",
        "quick (the quick study of the paper: --configfile config/quick.yaml)",
    )
    yield Limit(config["effort"] != "quick" or bool(config["quick"]), "effort", *no_keys)
    folders = (f"results/{config['study']}", config["store"])
    results, store = (Path(os.path.realpath(folder)) for folder in folders)
    apart = not (results.is_relative_to(store) or store.is_relative_to(results))
    yield Limit(apart, "store", f"a folder apart from results/{config['study']}", config["store"])
    for skewness in config["robustness"]["heights"]["skewness"]:
        if float(f"{skewness:g}") != skewness:  # Two of them might have the same name.
            key = "robustness.heights.skewness"
            yield Limit(False, key, "at most six digits", repr(skewness))
            break


def _limits_of_paper(
    config: dict[str, Any], table: pd.DataFrame, compared: Collection[str]
) -> Iterator[Limit]:
    """Give the limits of what only a study that is compared with the paper computes."""
    sphere, traced = config["sphere"]["surface"], config["adhesion"]["traced_contact"]
    surfaces, count = list(table.surface.unique()), config["contact"]["count"]
    substrates = [surface for surface in surfaces if surface != sphere]
    for key, surface in (
        ("reference_surface", config["reference_surface"]),
        ("adhesion.traced_contact.surface", traced["surface"]),
        ("indent.surface", config["indent"]["surface"]),
        ("robustness.heights.surface", config["robustness"]["heights"]["surface"]),
        ("robustness.tip.surface", config["robustness"]["tip"]["surface"]),
    ):
        yield _one_of(key, surface, substrates)
    for key, surface in (("scan", traced["surface"]), ("sphere_scan", sphere)):
        if surface in surfaces:
            scans = table.scan[table.surface == surface].tolist()
            name, expected = f"adhesion.traced_contact.{key}", f"a scan of {surface} {scans}"
            yield Limit(traced[key] in scans, name, expected, traced[key])
    reference, forces = config["reference_surface"], config["forces"]
    expected = f"a surface with a published pull-off force ({', '.join(compared)})"
    yield Limit(reference in compared, "reference_surface", expected, reference)
    yield Limit(forces == NONE, "forces", f"{NONE} with published: {PAPER}", forces)
    place, expected = traced["contact"], f"indices below contact.count = {count}"
    yield Limit(max(place) < count, "adhesion.traced_contact.contact", expected, place)
    yield _of_realization(config)
    for section in ("elastic", "asperities"):
        expected, contacts = f"contact.count squared = {count**2}", config[section]["contacts"]
        yield Limit(contacts <= count**2, f"{section}.contacts", f"at most {expected}", contacts)
    pool = config["sets"]["pool"]
    scans_of = table[table.source == "substitute"].groupby("surface", sort=False).size()
    for surface, scans in scans_of.items():
        if surface != sphere and scans > pool:
            yield Limit(False, "sets.pool", f"at least the {scans} scans of {surface}", pool)
            break


def _of_realization(config: dict[str, Any]) -> Limit:
    """Return the limit of a random surface: no smaller than the substitute cut out of it."""
    most, pixels = config["scan"]["realization_pixels"], config["scan"]["pixels"]
    expected = f"at least scan.pixels = {pixels}"
    return Limit(most >= pixels, "scan.realization_pixels", expected, most)


def _checks_of_own_surfaces(
    config: dict[str, Any], table: pd.DataFrame
) -> Iterator[Callable[[], object]]:
    """Yield the checks of a study of own surfaces.

    Substitutes, of which none stands for the paper's, scans that contacts do not use, own forces.
    """
    of_paper = published.table1(PUBLISHED["published_table1"]).surface.unique()
    substitutes = table[table.source == "substitute"].drop_duplicates("surface")
    for surface, path in zip(substitutes.surface, substitutes.path, strict=True):
        yield partial(refuse_of_paper, path, surface, of_paper)
    if len(substitutes):
        yield partial(refuse_first, [_of_realization(config)])
    others = table[table.use != CONTACT]
    for path, dataset in zip(others.path, others.dataset, strict=True):
        yield partial(read_measurement, path, dataset, config["scan"]["undefined_pixels"])
    if config["forces"] != NONE:
        substrates = table.surface[table.surface != config["sphere"]["surface"]]
        yield partial(measured_forces, config["forces"], list(substrates.unique()))


def _descriptions(table: pd.DataFrame) -> Iterator[Callable[[], None]]:
    """Yield the check of the description of each substitute."""
    rows_of_table1 = (
        published.table1(PUBLISHED["published_table1"]).groupby("surface").quantity.agg(set)
    )
    substitutes = table[table.source == "substitute"].drop_duplicates("surface")
    for surface, path in zip(substitutes.surface, substitutes.path, strict=True):
        yield partial(refuse_description, path, rows_of_table1.get(surface, set()))


def surface_grid(config: dict[str, Any], surface: str, rows: pd.DataFrame) -> Grid:
    """Return the grid of the scans of a surface, given its rows in the table; measured are read.

    Relief of measured scans is the largest of them, of substitutes that of their largest master. A
    scan that cannot be used or has other pixels than the first is refused in one line.
    """
    if rows.source.iloc[0] == "substitute":
        pixels, size = config["scan"]["pixels"], config["scan"]["size"]
        relief = _substitute_relief(config, rows.path.iloc[0])
        grid, where = Grid(pixels, size / pixels, size, relief), "config key scan.size"
    else:
        grid, where = _measured_grid(config, surface, rows), rows.path.iloc[0]
    least, most = PIXEL_SIZES
    if not least <= grid.pixel_size <= most:
        raise ValueError(
            f"{where}: expected pixels of {least:g} to {most:g} nm, where spectra are known, "
            f"found {grid.pixel_size:.6g} nm"
        )
    return grid


def _substitute_relief(config: dict[str, Any], path: str) -> float:
    """Return a bound on the differences in height (nm) of contacts on the largest master."""
    if is_calibrated(pd.read_csv(path)):
        return SUBSTITUTE_RELIEF
    period = 2 * config["scan"]["size"] * config["scales"]["large"]["tiles"]
    return RELIEF_OVER_RMS * described_rms_height(path, period)


def _measured_grid(config: dict[str, Any], surface: str, rows: pd.DataFrame) -> Grid:
    grids: list[Grid] = []
    for path, dataset in zip(rows.path, rows.dataset, strict=True):
        scan = read_scan(path, dataset, config["scan"]["undefined_pixels"])
        relief = float(np.ptp(scan.heights))
        if relief == 0:
            raise ValueError(f"{path}: expected a rough surface, found constant height")
        grids.append(Grid(scan.pixels, scan.pixel_size, scan.size, relief))
        first, last = grids[0], grids[-1]
        same_size = math.isclose(last.pixel_size, first.pixel_size, rel_tol=1e-3)
        if last.pixels != first.pixels or not same_size:
            raise ValueError(
                f"{path}: expected, as in the first scan of {surface}, "
                f"{first.pixels} pixels of {first.pixel_size:.4g} nm; "
                f"found {last.pixels} of {last.pixel_size:.4g} nm"
            )
    return grids[0]._replace(relief=max(grid.relief for grid in grids))
