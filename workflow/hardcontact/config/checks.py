"""Checks that the names and values of a study agree with each other, its tables and its scans.

They refuse before any job starts what could only fail later. Every fault is one line: the key or
row, what was expected, what was found.

Checks of what only a study that is compared with the paper computes.
"""

import os
from collections.abc import Callable, Collection, Iterator, Sequence
from functools import partial
from itertools import pairwise, product
from pathlib import Path
from typing import Any

import pandas as pd

from hardcontact.config.configuration import NONE, PAPER, SMOOTH, refuse_all
from hardcontact.config.limits import MAP_PIXELS
from hardcontact.config.patterns import PUBLISHED
from hardcontact.config.scan_limits import check_scans
from hardcontact.config.selection import CONTACT
from hardcontact.config.substitute_descriptions import refuse_description, refuse_of_paper
from hardcontact.config.tables import measured_forces
from hardcontact.records import published
from hardcontact.surfaces.scans import read_measurement
from hardcontact.surfaces.synthesis import SIDES

__all__ = ["check", "checks_of_paper", "refuse_small_realization"]


def check(config: dict[str, Any], table: pd.DataFrame, compared: Collection[str]) -> None:
    """Refuse a study that cannot be computed; measured scans are read.

    Parameters
    ----------
    config : dict
        Numbers, as `configuration.configuration` returns it.
    table : pandas.DataFrame
        The scans of the study, as `surface_table.selected_scans` returns them.
    compared : collection of str
        Surfaces with a published pull-off force.

    Raises
    ------
    ValueError
        In one line a fault, naming the key or the file: names of surfaces or scans that are not in
        the table, values that contradict each other, unusable scans, wavelengths, windows and
        loads that the pixels do not permit. Scans are read once all names are known.
    """
    contacts = table[table.use == CONTACT]
    refuse_all(
        [
            partial(_refuse_unknown_sphere, config, contacts),
            *_ascending(config),
            partial(_refuse_large_windows, config),
            partial(_refuse_small_surfaces, config),
            partial(_refuse_quick_without_keys, config),
            partial(_refuse_common_folder, config),
            partial(_refuse_long_numbers, config),
            *_descriptions(table),
            *(
                checks_of_paper(config, contacts, compared)
                if config["published"] == PAPER
                else _checks_of_own_surfaces(config, table)
            ),
        ]
    )
    check_scans(config, contacts)


def _checks_of_own_surfaces(
    config: dict[str, Any], table: pd.DataFrame
) -> list[Callable[[], object]]:
    """Return the checks of a study of own surfaces: its forces, scans that contacts do not use."""
    others = table[table.use != CONTACT]
    checks: list[Callable[[], object]] = [
        partial(read_measurement, path, dataset, config["scan"]["undefined_pixels"])
        for path, dataset in zip(others.path, others.dataset, strict=True)
    ]
    if config["forces"] != NONE:
        substrates = table.surface[table.surface != config["sphere"]["surface"]]
        checks.append(partial(measured_forces, config["forces"], list(substrates.unique())))
    return [*_substitutes(config, table), *checks]


def _substitutes(config: dict[str, Any], table: pd.DataFrame) -> Iterator[Callable[[], None]]:
    """Yield the checks of substitutes in a study of own surfaces: none stands for the paper's."""
    of_paper = published.table1(PUBLISHED["published_table1"]).surface.unique()
    substitutes = table[table.source == "substitute"].drop_duplicates("surface")
    for surface, path in zip(substitutes.surface, substitutes.path, strict=True):
        yield partial(refuse_of_paper, path, surface, of_paper)
    if len(substitutes):
        yield partial(refuse_small_realization, config["scan"])


def _descriptions(table: pd.DataFrame) -> Iterator[Callable[[], None]]:
    """Yield the check of the description of each substitute."""
    rows_of_table1 = (
        published.table1(PUBLISHED["published_table1"]).groupby("surface").quantity.agg(set)
    )
    substitutes = table[table.source == "substitute"].drop_duplicates("surface")
    for surface, path in zip(substitutes.surface, substitutes.path, strict=True):
        yield partial(refuse_description, path, rows_of_table1.get(surface, set()))


def _refuse_unknown_sphere(config: dict[str, Any], table: pd.DataFrame) -> None:
    """Refuse a sphere that the table does not have, and roughness of a smooth one."""
    surfaces, sphere = list(table.surface.unique()), config["sphere"]["surface"]
    if config["published"] != PAPER and sphere == SMOOTH:
        if config["scales"]["sphere_roughness"]:
            raise ValueError(
                "config key scales.sphere_roughness: expected false with sphere.surface: "
                f"{SMOOTH}, found true"
            )
    elif sphere not in surfaces:
        raise ValueError(
            f"config key sphere.surface: expected one of {', '.join(surfaces)}, "
            f"surfaces of the table, found {sphere}"
        )


def _ascending(config: dict[str, Any]) -> Iterator[Callable[[], None]]:
    """Yield a check that each list of quantities ascends."""
    for section in ("adhesion", "asperities", "insight"):
        yield partial(_refuse_descent, f"{section}.ranges", config[section]["ranges"], "nm")
    insight = config["insight"]
    of_masters = {name: config[name] for name in ("scales", "sets", "insight")}
    of_masters["insight.scaling"] = insight["scaling"]
    for (section, values), side in product(of_masters.items(), SIDES):
        key, cutoffs = f"{section}.{side}.cutoffs", values[side]["cutoffs"]
        yield partial(_refuse_descent, key, cutoffs, "nm")
    yield partial(_refuse_descent, "insight.sizes", insight["sizes"], "nm")
    for section, key in [*product(("scaling", "scan_sizes"), ("radii", "ranges")),
                         ("scan_sizes", "sizes")]:  # fmt: skip
        yield partial(_refuse_descent, f"insight.{section}.{key}", insight[section][key], "nm")
    of_edges = insight["scan_sizes"]["edges"]["cutoffs"]
    yield partial(_refuse_descent, "insight.scan_sizes.edges.cutoffs", of_edges, "nm")
    preloads = insight["scaling"]["preloads"]
    yield partial(_refuse_descent, "insight.scaling.preloads", preloads, "N")
    for section in ("indent", "robustness"):
        yield partial(_refuse_descent, f"{section}.preloads", config[section]["preloads"], "N")
    robustness = config["robustness"]
    yield partial(_refuse_descent, "robustness.hardnesses", robustness["hardnesses"], "Pa")
    yield partial(_refuse_descent, "robustness.tip.radii", robustness["tip"]["radii"], "nm")


def _refuse_descent(key: str, values: Sequence[float], unit: str) -> None:
    """Refuse quantities that descend, or that repeat, perhaps written in another unit."""
    for smaller, larger in pairwise(values):
        if smaller >= larger:
            raise ValueError(
                f"config key {key}: expected ascending values, "
                f"found {larger:.12g} {unit} after {smaller:.12g} {unit}"
            )


def _refuse_large_windows(config: dict[str, Any]) -> None:
    """Refuse windows that are not smaller than the surfaces that they are cut out of."""
    given = config["insight"]["scan_sizes"]
    largest, size = max(given["sizes"]), given["size"]
    if largest >= size:
        raise ValueError(
            "config key insight.scan_sizes.sizes: expected less than insight.scan_sizes.size "
            f"({size:.6g} nm), found {largest:.6g} nm"
        )


def _refuse_small_surfaces(config: dict[str, Any]) -> None:
    """Refuse whole surfaces that are no larger than the others, or do not hold the cutoffs."""
    given = config["insight"]["scan_sizes"]
    edges, size, pixel_size = given["edges"], given["size"], given["size"] / given["pixels"]
    largest = MAP_PIXELS * pixel_size
    if not size < edges["size"] <= largest:
        raise ValueError(
            "config key insight.scan_sizes.edges.size: expected more than insight.scan_sizes.size "
            f"({size:.6g} nm) and at most {MAP_PIXELS} of its pixels ({largest:.6g} nm), "
            f"found {edges['size']:.6g} nm"
        )
    for cutoff in edges["cutoffs"]:
        if not 2 * pixel_size * (1 + 1e-9) < cutoff <= size:
            raise ValueError(
                "config key insight.scan_sizes.edges.cutoffs: expected more than two pixels "
                f"({2 * pixel_size:.4g} nm) and at most insight.scan_sizes.size ({size:.6g} nm), "
                f"found {cutoff:.6g} nm"
            )


def _refuse_quick_without_keys(config: dict[str, Any]) -> None:
    """Refuse the quick effort where nothing says what it is: it would be the full one."""
    if config["effort"] == "quick" and not config["quick"]:
        raise ValueError(
            "config key effort: expected full where no keys stand under quick, found quick (the "
            "quick study of the paper: --configfile config/quick.yaml)"
        )


def _refuse_common_folder(config: dict[str, Any]) -> None:
    """Refuse folders that contain each other."""
    folders = (f"results/{config['study']}", config["store"])
    results, store = (Path(os.path.realpath(folder)) for folder in folders)
    if results.is_relative_to(store) or store.is_relative_to(results):
        raise ValueError(
            f"config key store: expected a folder apart from results/{config['study']}, "
            f"found {config['store']}"
        )


def _refuse_long_numbers(config: dict[str, Any]) -> None:
    """Refuse values that would have the same name."""
    for skewness in config["robustness"]["heights"]["skewness"]:
        if float(f"{skewness:g}") != skewness:
            raise ValueError(
                "config key robustness.heights.skewness: expected at most six digits, "
                f"found {skewness!r}"
            )


def checks_of_paper(
    config: dict[str, Any], table: pd.DataFrame, compared: Collection[str]
) -> Iterator[Callable[[], None]]:
    """Yield the checks of a study that is compared with the paper, for `faults.refuse_all`.

    Parameters
    ----------
    config : dict
        Numbers, as `configuration.configuration` returns it.
    table : pandas.DataFrame
        The scans of the study, as `surface_table.selected_scans` returns them.
    compared : collection of str
        Surfaces with a published pull-off force.

    Yields
    ------
    callable
        Raises a ValueError of one line, naming the key.
    """
    yield from _unknown_surfaces(config, table)
    yield partial(_refuse_unknown_reference, config, compared)
    yield partial(_refuse_own_forces, config)
    yield partial(_refuse_outside_place, config)
    yield partial(refuse_small_realization, config["scan"])
    for section in ("elastic", "asperities"):
        yield partial(_refuse_many_contacts, config, section)
    yield partial(_refuse_small_pool, config, table)


def _unknown_surfaces(config: dict[str, Any], table: pd.DataFrame) -> Iterator[Callable[[], None]]:
    """Yield a check of each name of a surface, and of the scans of the traced contact."""
    sphere, traced = config["sphere"]["surface"], config["adhesion"]["traced_contact"]
    surfaces = list(table.surface.unique())
    substrates = [surface for surface in surfaces if surface != sphere]
    for key, surface in (
        ("reference_surface", config["reference_surface"]),
        ("adhesion.traced_contact.surface", traced["surface"]),
        ("indent.surface", config["indent"]["surface"]),
        ("robustness.heights.surface", config["robustness"]["heights"]["surface"]),
        ("robustness.tip.surface", config["robustness"]["tip"]["surface"]),
    ):
        yield partial(_refuse_unknown_surface, key, surface, substrates)
    for key, surface in (("scan", traced["surface"]), ("sphere_scan", sphere)):
        if surface in surfaces:
            scans = table.scan[table.surface == surface].tolist()
            yield partial(_refuse_unknown_scan, key, traced[key], surface, scans)


def _refuse_unknown_surface(key: str, surface: str, known: Sequence[str]) -> None:
    if surface not in known:
        raise ValueError(
            f"config key {key}: expected one of {', '.join(known)}, "
            f"surfaces of the table, found {surface}"
        )


def _refuse_unknown_scan(key: str, scan: int, surface: str, known: Sequence[int]) -> None:
    if scan not in known:
        raise ValueError(
            f"config key adhesion.traced_contact.{key}: expected a scan of "
            f"{surface} {known}, found {scan}"
        )


def _refuse_unknown_reference(config: dict[str, Any], compared: Collection[str]) -> None:
    reference = config["reference_surface"]
    if reference not in compared:
        raise ValueError(
            "config key reference_surface: expected a surface with a published "
            f"pull-off force ({', '.join(compared)}), found {reference}"
        )


def _refuse_own_forces(config: dict[str, Any]) -> None:
    if config["forces"] != NONE:
        raise ValueError(
            f"config key forces: expected {NONE} with published: {PAPER}, found {config['forces']}"
        )


def _refuse_outside_place(config: dict[str, Any]) -> None:
    place = config["adhesion"]["traced_contact"]["contact"]
    count = config["contact"]["count"]
    if max(place) >= count:
        raise ValueError(
            "config key adhesion.traced_contact.contact: expected indices below "
            f"contact.count = {count}, found {place}"
        )


def refuse_small_realization(scan: dict[str, Any]) -> None:
    """Refuse a random surface smaller than the substitute cut out of it, as a ValueError."""
    if scan["realization_pixels"] < scan["pixels"]:
        raise ValueError(
            "config key scan.realization_pixels: expected at least scan.pixels = "
            f"{scan['pixels']}, found {scan['realization_pixels']}"
        )


def _refuse_many_contacts(config: dict[str, Any], section: str) -> None:
    count = config["contact"]["count"]
    if config[section]["contacts"] > count**2:
        raise ValueError(
            f"config key {section}.contacts: expected at most contact.count squared = "
            f"{count**2}, found {config[section]['contacts']}"
        )


def _refuse_small_pool(config: dict[str, Any], table: pd.DataFrame) -> None:
    """Refuse a pool with fewer scans than a set has."""
    pool = config["sets"]["pool"]
    scans = table[table.source == "substitute"].groupby("surface", sort=False).size()
    for surface, count in scans.items():
        if surface != config["sphere"]["surface"] and count > pool:
            raise ValueError(
                f"config key sets.pool: expected at least the {count} scans of {surface}, "
                f"found {pool}"
            )
