"""Checks of what only a study that is compared with the paper computes."""

from collections.abc import Callable, Collection, Iterator, Sequence
from functools import partial
from typing import Any

import pandas as pd

from hardcontact.study.stages import NONE, PAPER

__all__ = ["checks_of_paper", "refuse_small_realization"]


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
