"""Checks that the values of a study agree with each other, with its tables and its scans."""

from collections.abc import Callable, Collection, Iterator
from functools import partial
from typing import Any

import pandas as pd

from hardcontact.base import published
from hardcontact.config.arguments import unit_question
from hardcontact.config.configuration import (
    CONTACT_QUANTITIES,
    contact_words,
    get_key,
    is_paper_study,
)
from hardcontact.config.descriptions import refuse_description, refuse_paper_surface
from hardcontact.config.faults import key_fault, raise_faults, run_checks
from hardcontact.config.force_table import measured_forces
from hardcontact.config.keys import NONE, SMOOTH_SPHERE
from hardcontact.config.limits import refuse_unfit_grids
from hardcontact.config.selected_surfaces import CONTACT_USE
from hardcontact.run.scan_grids import stored_scan, surface_grid


def check_study(config: dict[str, Any], table: pd.DataFrame) -> None:
    """Refuse a study that would fail in a job; scans with contacts are read last."""
    contacts = table[table.use == CONTACT_USE]
    substitutes = table[table.source == "substitute"].drop_duplicates("surface")
    table1 = published.read_table1(published.PUBLISHED_TABLES["published_table1"])
    rows_of_table1 = {str(name): set(rows.quantity) for name, rows in table1.groupby("surface")}
    faults = list[str]()
    for row in substitutes.itertuples():
        published_rows = rows_of_table1.get(str(row.surface), set())
        faults += _faults_found_by(refuse_description, row.path, published_rows)
    if is_paper_study(config):
        faults += _paper_faults(config, contacts)
    else:
        faults += _own_surface_faults(config, table, substitutes, rows_of_table1)
    raise_faults(dict.fromkeys(faults))
    rows_by_surface = {str(name): rows for name, rows in contacts.groupby("surface", sort=False)}
    grids = run_checks(partial(surface_grid, config, *item) for item in rows_by_surface.items())
    try:
        refuse_unfit_grids(config, dict(zip(rows_by_surface, grids, strict=True)))
    except ValueError as error:
        raise_faults(_unusual_quantity_faults(config, str(error).splitlines()[-1]))
        raise


def _faults_found_by(check: Callable[..., object], *arguments: Any) -> list[str]:
    """Return the lines of the ValueError that a check raises, if it does."""
    try:
        check(*arguments)
    except ValueError as error:
        return str(error).splitlines()
    return []


def _unusual_quantity_faults(config: dict[str, Any], fault: str) -> Iterator[str]:
    """Yield a line for each quantity of the contact that is not usual and may cause the fault."""
    for quantity, (key, name) in CONTACT_QUANTITIES.items():
        if question := unit_question(quantity, get_key(config, key)):
            words = f"{contact_words(config)[name]}: {question}; if it is: {fault}"
            yield key_fault(key, "a value that the scans permit", words)


def _name_faults(config: dict[str, Any], key: str, surfaces: list[str]) -> list[str]:
    """Return the fault of a key that names a surface that is not in the table."""
    if get_key(config, key) in surfaces:
        return []
    accepted = f"a surface of the table ({', '.join(surfaces)})"
    return [key_fault(key, accepted, get_key(config, key))]


def _paper_faults(config: dict[str, Any], contacts: pd.DataFrame) -> list[str]:
    """Return the faults of a study that is compared with the paper."""
    sphere = config["sphere"]["surface"]
    surfaces = list(contacts.surface.unique())
    faults = _name_faults(config, "sphere.surface", surfaces)
    substrates = [surface for surface in surfaces if surface != sphere]
    for key in ("reference_surface", "indent.surface"):
        faults += _name_faults(config, key, substrates)
    if config["substitutes"]["featured_surface"] != NONE:
        faults += _name_faults(config, "substitutes.featured_surface", substrates)
    pull_off_table = published.PUBLISHED_TABLES["published_pull_off"]
    compared = published.read_published_forces(pull_off_table).index
    unpublished = [surface for surface in substrates if surface not in compared]
    if unpublished:
        accepted = (
            f"substrates with a published pull-off force ({', '.join(compared)}); with `published: "
            "none` a study has any"
        )
        faults.append(key_fault("surfaces", accepted, ", ".join(unpublished)))
    if len(substrates) == 1:
        accepted = "two substrates or more, because range and work are fitted to their forces"
        faults.append(key_fault("surfaces", accepted, *substrates))
    pool = config["sets"]["pool_size"]
    substitutes = contacts[(contacts.source == "substitute") & (contacts.surface != sphere)]
    scans = substitutes.surface.value_counts(sort=False)
    if len(scans) and scans.max() > pool:
        accepted = f"at least the {scans.max()} scans of {scans.idxmax()}"
        faults.append(key_fault("sets.pool_size", accepted, pool))
    # Imported here, as the claims would cost studies of the user's surfaces almost a second.
    from hardcontact.paper.claims.statements import check_claims

    return faults + _faults_found_by(check_claims, published.CLAIMS)


def _own_surface_faults(
    config: dict[str, Any],
    table: pd.DataFrame,
    substitutes: pd.DataFrame,
    paper_surfaces: Collection[str],
) -> list[str]:
    """Return the faults of a study of the user's surfaces; scans under contact are not read."""
    faults = list[str]()
    sphere = config["sphere"]["surface"]
    if sphere != SMOOTH_SPHERE:
        contacts = table[table.use == CONTACT_USE]
        faults += _name_faults(config, "sphere.surface", list(contacts.surface.unique()))
    for row in substitutes.itertuples():
        faults += _faults_found_by(refuse_paper_surface, row.path, row.surface, paper_surfaces)
    for row in table[table.use != CONTACT_USE].itertuples():
        faults += _faults_found_by(stored_scan, config, row)
    if config["forces"] != NONE:
        substrates = list(table.surface[table.surface != sphere].unique())
        radius = config["sphere"]["radius"]
        faults += _faults_found_by(measured_forces, config["forces"], substrates, radius)
    return faults
