"""The surfaces of the paper, some of their scans, and a configuration to change."""

import copy

import pandas as pd
import yaml
from repository import PAPER, ROOT, TINY, merged

from hardcontact.config import model
from hardcontact.config.files import Files
from hardcontact.config.patterns import STORE_KEYS, Patterns, store_digests
from hardcontact.config.selection import CONTACT, Selection

DIGESTS = {kind: "digest" for kind in STORE_KEYS}
PATTERNS = Patterns("results/paper", "results/store", "ruby", DIGESTS)
#: The paths of the tiny study.
TINY_NUMBERS = model.numeric_configuration(merged(PAPER, yaml.safe_load((ROOT / TINY).read_text())))
TINY_PATTERNS = Patterns("results/tiny", "results/store-tiny", "ruby", store_digests(TINY_NUMBERS))


def selection(scans=(1, 2), measured_surfaces=()):
    """Return the paper's surfaces with these scans; those that are measured have files."""
    table = pd.read_csv(ROOT / "config/surfaces.tsv", sep="\t", keep_default_na=False)
    table = table.assign(use=CONTACT, tip_radius="")
    rows = table[table.scan.isin(scans)].copy()
    is_measured = rows.surface.isin(measured_surfaces)
    rows.loc[is_measured, "source"] = "measured"
    rows.loc[is_measured, "path"] = [
        f"{row.surface}-{row.scan}.nc" for row in rows[is_measured].itertuples()
    ]
    return Selection(rows, "ruby")


def configuration(**changes):
    """Return the paper's configuration in numbers; changes have keys such as ``scales__range``."""
    config = copy.deepcopy(PAPER)
    for name, value in changes.items():
        *sections, key = name.split("__")
        section = config
        for step in sections:
            section = section[step]
        section[key] = value
    return model.numeric_configuration(config)


def files(scans=(1, 2), measured_surfaces=(), **changes):
    """Return the files of a study of these scans, with other values of some keys."""
    return Files(configuration(**changes), selection(scans, measured_surfaces), PATTERNS)
