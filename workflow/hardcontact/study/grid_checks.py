"""Checks that the pixels of scans permit what a study computes on them."""

from collections.abc import Mapping
from functools import partial
from itertools import product
from typing import Any

import pandas as pd

from hardcontact.study.faults import refuse_all
from hardcontact.study.grids import Grid, surface_grid
from hardcontact.study.master_limits import refuse_on_master
from hardcontact.study.scan_limits import (
    refuse_on_elastic_pair,
    refuse_on_elastic_scan,
    refuse_on_pair,
    refuse_on_scan,
)
from hardcontact.study.stages import PAPER
from hardcontact.surfaces.masters import SIDES

__all__ = ["check_grids", "check_scans"]


def check_scans(config: dict[str, Any], table: pd.DataFrame) -> None:
    """Refuse what the pixels of the scans do not permit; measured scans are read.

    Parameters
    ----------
    config : dict
        Numbers, as `configuration.configuration` returns it.
    table : pandas.DataFrame
        The scans that contacts are made on, as `surface_table.selected_scans` returns them.

    Raises
    ------
    ValueError
        In one line a fault, naming the key or the file.
    """
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
    sections = ("scales", "sets", "insight", "insight.scaling") if of_the_paper else ("scales",)
    masters = list(product(sections, SIDES))
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
