"""Studies that differ from the paper's study: their numbers, checks, tables, scans and files."""

import pandas as pd
import yaml
from repository import PAPER, ROOT, ROWS, TINY

from hardcontact.base.published import surfaces_of_table1
from hardcontact.config import selected_surfaces
from hardcontact.config.configuration import merge_overlay, numeric_configuration, set_keys
from hardcontact.config.study_plan import StudyPlan
from hardcontact.files.paths import SurfaceFiles
from hardcontact.run import checks

#: Stands for the digest of the files of a surface.
FILES_DIGEST = "0123abcd"


def paper_configuration(values=None):
    """Return the paper's configuration in numbers, with other values of some keys."""
    return numeric_configuration(set_keys(PAPER, values or {}))


def read_surfaces(text, folder):
    """Read a table of surfaces of this text, with paths relative to the repository's root."""
    path = folder / "surfaces.tsv"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return selected_surfaces.surface_table(path)


def check_configuration(config, folder, text=ROWS):
    """Check a configuration in numbers with a table of surfaces of this text."""
    table = selected_surfaces.selected_scans(read_surfaces(text, folder), config["scans"])
    checks.check_study(config, table)


def table_of_own_scans(*paths):
    """Return the text of the paper's table with measured scans in place of UNCD's."""
    rows = [row for row in ROWS.splitlines() if not row.startswith("uncd\t")]
    rows += [f"uncd\tUNCD\t{scan}\tmeasured\t{path}\t" for scan, path in enumerate(paths, start=1)]
    return "\n".join(rows) + "\n"


def configured_files(config):
    """Return the files of a configured study, as the rules have them."""
    study = numeric_configuration(config)
    table = selected_surfaces.surface_table(study["surfaces"])
    rows = selected_surfaces.selected_scans(table, study["scans"])
    digests = selected_surfaces.digest_surfaces(rows)
    selection = selected_surfaces.Selection(
        rows, study["sphere"]["surface"], digests, surfaces_of_table1()
    )
    return SurfaceFiles(StudyPlan(study, selection))


def tiny_files():
    """Return the files of the tiny study."""
    return configured_files(merge_overlay(PAPER, yaml.safe_load((ROOT / TINY).read_text())))


def study_files(values=None, scans=(1, 2), measured_surfaces=()):
    """Return the files of a study of these scan numbers, with other values of some keys."""
    table = pd.read_csv(ROOT / "config/surfaces.tsv", sep="\t", keep_default_na=False)
    table = table.assign(use=selected_surfaces.CONTACT_USE, tip_radius="")
    rows = table[table.scan.isin(scans)].copy()
    is_measured = rows.surface.isin(measured_surfaces)
    rows.loc[is_measured, "source"] = "measured"
    rows.loc[is_measured, "path"] = [
        f"{row.surface}-{row.scan}.nc" for row in rows[is_measured].itertuples()
    ]
    digests = dict.fromkeys(rows.surface, FILES_DIGEST)
    selection = selected_surfaces.Selection(rows, "ruby", digests, surfaces_of_table1())
    return SurfaceFiles(StudyPlan(paper_configuration(values), selection))
