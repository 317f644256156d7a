"""The surfaces of the paper, some of their scans, and a configuration to change."""

import copy

import pandas as pd
from repository import PAPER, ROOT

from hardcontact.config import model
from hardcontact.config.files import Files
from hardcontact.config.patterns import Patterns
from hardcontact.config.selection import CONTACT, Selection

PATTERNS = Patterns("results/paper", "results/store", "ruby")


def selection(scans=(1, 2), measured=()):
    """Return the paper's surfaces with these scans; those that are measured have files."""
    table = pd.read_csv(ROOT / "config/surfaces.tsv", sep="\t", keep_default_na=False)
    table = table.assign(use=CONTACT, tip_radius="")
    rows = table[table.scan.isin(scans)].copy()
    own = rows.surface.isin(measured)
    rows.loc[own, "source"] = "measured"
    rows.loc[own, "path"] = [f"{row.surface}-{row.scan}.nc" for row in rows[own].itertuples()]
    return Selection(rows, "ruby")


def configuration(**changes):
    """Return the paper's configuration in numbers, with other texts of ``scales__range``."""
    changed = copy.deepcopy(PAPER)
    for name, value in changes.items():
        *above, key = name.split("__")
        part = changed
        for step in above:
            part = part[step]
        part[key] = value
    return model.configuration(changed)


def files(scans=(1, 2), measured=(), **changes):
    """Return the files of a study of these scans, with other values of some keys."""
    return Files(configuration(**changes), selection(scans, measured), PATTERNS)
