"""Checks that the names and values of a study agree with each other, its tables and its scans.

They refuse before any job starts what could only fail later. Every fault is one line: the key or
row, what was expected, what was found.
"""

import os
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from functools import partial
from itertools import pairwise, product
from pathlib import Path
from typing import Any

import pandas as pd

from hardcontact import published
from hardcontact.study.faults import refuse_all
from hardcontact.study.grids import Grid, surface_grid
from hardcontact.study.master_limits import refuse_on_master
from hardcontact.study.measured_forces import measured_forces
from hardcontact.study.patterns import PUBLISHED
from hardcontact.study.scan_limits import (
    refuse_on_elastic_pair,
    refuse_on_elastic_scan,
    refuse_on_pair,
    refuse_on_scan,
)
from hardcontact.study.stages import NONE, PAPER, SMOOTH
from hardcontact.study.substitute_descriptions import refuse_description
from hardcontact.study.surface_table import CONTACT
from hardcontact.surfaces.scans import read_measurement

__all__ = ["check", "check_grids"]


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
    of_the_paper = config["published"] == PAPER
    refuse_all(
        [
            partial(_refuse_unknown_sphere, config, contacts),
            partial(_refuse_disorder, config),
            partial(_refuse_names, config),
            *_descriptions(table),
            *(_checks_of_paper(config, contacts, compared) if of_the_paper else []),
            *([] if of_the_paper else _checks_of_own_surfaces(config, table)),
        ]
    )
    _refuse_on_grids(config, contacts)


def _checks_of_paper(
    config: dict[str, Any], table: pd.DataFrame, compared: Collection[str]
) -> list[Callable[[], None]]:
    """Return the checks of a study that is compared with the paper."""
    return [
        partial(_refuse_unknown_surfaces, config, table),
        partial(_refuse_contradictions, config),
        partial(_refuse_unknown_reference, config, compared),
        partial(_refuse_small_pool, config, table),
    ]


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
        checks.append(partial(measured_forces, config["forces"], list(table.surface.unique())))
    return [partial(_refuse_substitutes, table), *checks]


def _refuse_substitutes(table: pd.DataFrame) -> None:
    """Refuse substitutes in a study of own surfaces: they stand for the paper's."""
    substitutes = table.surface[table.source == "substitute"].unique()
    if len(substitutes):
        raise ValueError(
            "config key published: expected paper in a study with substitutes "
            f"({', '.join(substitutes)}), found {NONE}"
        )


def _descriptions(table: pd.DataFrame) -> Iterator[Callable[[], None]]:
    """Yield the check of the description of each substitute."""
    rows_of_table1 = (
        published.table1(PUBLISHED["published_table1"]).groupby("surface").quantity.agg(set)
    )
    substitutes = table[table.source == "substitute"].drop_duplicates("surface")
    for surface, path in zip(substitutes.surface, substitutes.path, strict=True):
        yield partial(refuse_description, path, rows_of_table1.get(surface, set()))


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


def _refuse_on_grids(config: dict[str, Any], table: pd.DataFrame) -> None:
    """Refuse what the pixels of the scans do not permit; measured scans are read."""
    grids: dict[str, Grid] = {}

    def read(surface: str, rows: pd.DataFrame) -> None:
        grids[surface] = surface_grid(config, surface, rows)

    refuse_all(
        partial(read, str(surface), rows) for surface, rows in table.groupby("surface", sort=False)
    )
    check_grids(config, grids)


def check_grids(config: dict[str, Any], grids: Mapping[str, Grid]) -> None:
    """Refuse what the pixels of scans do not permit.

    Parameters
    ----------
    config : dict
        Numbers, as `configuration.configuration` returns it.
    grids : mapping
        Grid of the scans of each surface.

    Raises
    ------
    ValueError
        In one line a fault, naming the key.
    """
    name, of_the_paper = config["sphere"]["surface"], config["published"] == PAPER
    if name in grids:
        _refuse_small_sphere(config, grids[name])
    on_scan = [refuse_on_scan, refuse_on_elastic_scan] if of_the_paper else [refuse_on_scan]
    on_pair = [refuse_on_pair, refuse_on_elastic_pair] if of_the_paper else [refuse_on_pair]
    sections = ("scales", "sets") if of_the_paper else ("scales",)
    masters = list(product(sections, ("small", "large")))
    checks = [partial(limit, config, *one) for one, limit in product(grids.items(), on_scan)]
    for surface, grid in grids.items():
        if surface != name:
            sphere = grids.get(name, grid)  # A smooth sphere has the pixels of what it meets.
            checks += [partial(limit, config, surface, grid, sphere) for limit in on_pair]
            checks += [
                partial(refuse_on_master, config, section, side, surface, grid, sphere)
                for section, side in masters
            ]
    refuse_all(checks)


def _refuse_small_sphere(config: dict[str, Any], sphere: Grid) -> None:
    """Refuse a sphere that is smaller than its scans."""
    radius = config["sphere"]["radius"]
    if radius < sphere.size:
        raise ValueError(
            "config key sphere.radius: expected at least the size of its scans "
            f"({sphere.size:.6g} nm), found {radius:.6g} nm"
        )


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


def _refuse_unknown_surfaces(config: dict[str, Any], table: pd.DataFrame) -> None:
    """Refuse names of surfaces and numbers of scans that the table does not have."""
    sphere, traced = config["sphere"]["surface"], config["adhesion"]["traced_contact"]
    surfaces = list(table.surface.unique())
    substrates = [surface for surface in surfaces if surface != sphere]
    for key, surface, known in (
        ("reference_surface", config["reference_surface"], substrates),
        ("adhesion.traced_contact.surface", traced["surface"], substrates),
        ("indent.surface", config["indent"]["surface"], substrates),
        ("robustness.heights.surface", config["robustness"]["heights"]["surface"], substrates),
        ("robustness.tip.surface", config["robustness"]["tip"]["surface"], substrates),
    ):
        if surface not in known:
            raise ValueError(
                f"config key {key}: expected one of {', '.join(known)}, "
                f"surfaces of the table, found {surface}"
            )
    for key, surface in (("scan", traced["surface"]), ("sphere_scan", sphere)):
        scans = table.scan[table.surface == surface].tolist()
        if traced[key] not in scans:
            raise ValueError(
                f"config key adhesion.traced_contact.{key}: expected a scan of "
                f"{surface} {scans}, found {traced[key]}"
            )


def _refuse_disorder(config: dict[str, Any]) -> None:
    """Refuse lists of quantities that do not ascend."""
    for section in ("adhesion", "asperities"):
        _refuse_descent(f"{section}.ranges", config[section]["ranges"], "nm")
    for section, side in product(("scales", "sets"), ("small", "large")):
        _refuse_descent(f"{section}.{side}.cutoffs", config[section][side]["cutoffs"], "nm")
    for section in ("indent", "robustness"):
        _refuse_descent(f"{section}.preloads", config[section]["preloads"], "N")
    robustness = config["robustness"]
    _refuse_descent("robustness.hardnesses", robustness["hardnesses"], "Pa")
    _refuse_descent("robustness.tip.radii", robustness["tip"]["radii"], "nm")


def _refuse_descent(key: str, values: Sequence[float], unit: str) -> None:
    """Refuse quantities that descend, or that repeat, perhaps written in another unit."""
    for smaller, larger in pairwise(values):
        if smaller >= larger:
            raise ValueError(
                f"config key {key}: expected ascending values, "
                f"found {larger:.12g} {unit} after {smaller:.12g} {unit}"
            )


def _refuse_unknown_reference(config: dict[str, Any], compared: Collection[str]) -> None:
    """Refuse a reference surface without a published force, and own forces beside published."""
    reference = config["reference_surface"]
    if reference not in compared:
        raise ValueError(
            "config key reference_surface: expected a surface with a published "
            f"pull-off force ({', '.join(compared)}), found {reference}"
        )
    if config["forces"] != NONE:
        raise ValueError(
            f"config key forces: expected {NONE} with published: {PAPER}, found {config['forces']}"
        )


def _refuse_contradictions(config: dict[str, Any]) -> None:
    """Refuse values that other values do not permit."""
    count = config["contact"]["count"]
    place = config["adhesion"]["traced_contact"]["contact"]
    if max(place) >= count:
        raise ValueError(
            "config key adhesion.traced_contact.contact: expected indices below "
            f"contact.count = {count}, found {place}"
        )
    scan = config["scan"]
    if scan["realization_pixels"] < scan["pixels"]:
        raise ValueError(
            "config key scan.realization_pixels: expected at least scan.pixels = "
            f"{scan['pixels']}, found {scan['realization_pixels']}"
        )
    for section in ("elastic", "asperities"):
        if config[section]["contacts"] > count**2:
            raise ValueError(
                f"config key {section}.contacts: expected at most contact.count squared = "
                f"{count**2}, found {config[section]['contacts']}"
            )


def _refuse_names(config: dict[str, Any]) -> None:
    """Refuse folders that contain each other, and values that would have the same name."""
    folders = (f"results/{config['study']}", config["store"])
    results, store = (Path(os.path.realpath(folder)) for folder in folders)
    if results.is_relative_to(store) or store.is_relative_to(results):
        raise ValueError(
            f"config key store: expected a folder apart from results/{config['study']}, "
            f"found {config['store']}"
        )
    for skewness in config["robustness"]["heights"]["skewness"]:
        if float(f"{skewness:g}") != skewness:
            raise ValueError(
                "config key robustness.heights.skewness: expected at most six digits, "
                f"found {skewness!r}"
            )
