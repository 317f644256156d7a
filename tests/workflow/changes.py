"""The table of changes to a study: what is done to its files, and which rules are to run again."""

import shutil
from pathlib import Path

import pandas as pd
import yaml
from key_changes import CLOSED, KEYS, KEYS_OF_VARIANTS, SCALED
from repository import PARTS, QUICK, ROOT
from rule_graph import (
    AGGREGATED,
    APART,
    BEYOND,
    DRAWN,
    FROM_SCANS,
    KEPT,
    MASTERS,
    OF_MEASURED,
    OF_SPECTRA,
    POOLED,
    SPECTRA,
    all_following,
    drawn_from,
    following,
)
from scan_files import heights, scan

from hardcontact.config.patterns import PUBLISHED

#: What is made of one substitute surface, and with it; traced is uncd, indents are made on ncd.
SUBSTITUTE = SPECTRA | FROM_SCANS | OF_SPECTRA
OF_MCD = SUBSTITUTE - {"trace_contact", "measure_indents"}

#: Another text of a column of the rows of mcd (of its second scan), and the rules it concerns.
COLUMNS = {
    "surface": ("xcd", OF_MCD - POOLED),  # of which Table 1 has no rms height
    "label": ("fine diamond", AGGREGATED - {"aggregate_robustness"} | BEYOND),
    "scan": ("6", OF_MCD - {"calibrate_spectrum", "compute_pool", *OF_SPECTRA}),
    "source": (
        "measured",
        OF_MCD - {*SPECTRA, *POOLED, "synthesize_scan"} | {"measure_spectrum"},
    ),
    "path": ("resources/spectra/ncd-published.csv", OF_MCD),
    # Of measured scans alone: tests/workflow/test_job_counts.py changes both of them.
    "use": ("contact", set()),
    "tip_radius": ("10 nm", set()),
}


SCRIPTS = sorted(path.name for path in (ROOT / "workflow/scripts").glob("*.py"))


def rules_of(script):
    """Return the rules that a script belongs to."""
    return DRAWN if script == "draw_figure.py" else {Path(script).stem}


#: Rules that the quick study has no job for.
IDLE = OF_MEASURED | APART | {"verify"}
ALL = set().union(*map(rules_of, SCRIPTS)) - IDLE


def published(table, *rules):
    """Return the path of a published table, and what follows by rules and figures that read it."""
    return {PUBLISHED[table]: all_following({*rules, *drawn_from(table)})}


#: What compares computed forces with the published ones.
JUDGED_BY_FORCES = {"infer", "apply_classical_models", "aggregate_robustness", "judge_sets"}

#: Files beside the code, and what is to be made after a change of their text.
FILES = {
    "environment.txt": ALL,
    "workflow/constraints.txt": ALL,
    "README.md": set(),
    **{
        f"workflow/report/{chapter}.md": following({"describe_study"})
        for chapter in ("methods", "performance", "cluster", "faults")
    },
    "workflow/report/departures.md": following({"describe_study", "answer_paper"}),
    "workflow/report/fig1.rst": following({"answer_paper"}),
    "workflow/report/fig_laws.rst": following({"answer_insight"}),
    "CITATION.cff": {"describe_crate"},
    "config/surfaces.tsv": following({"keep_configuration"}),
    **published("published_table1", *SPECTRA, CLOSED, "compute_pool", "apply_classical_models"),
    **published("published_pull_off", *JUDGED_BY_FORCES, "compare_laws"),
    **published(
        "published_constants",
        *SPECTRA,
        CLOSED,
        "compute_pool",
        *JUDGED_BY_FORCES,
        "compare_laws",
        "repeat_contact",
        "estimate_elastic_limit",
        "answer_paper",
        "answer_insight",
    ),
    "resources/paper/claims.csv": following({"judge_sets", "evaluate_claims"}),
    "resources/spectra/polished_uncd.csv": following(OF_MCD),
    "resources/spectra/uncd.csv": following(SUBSTITUTE - {"measure_indents"}),
    "resources/spectra/ncd.csv": following(SUBSTITUTE - {"trace_contact"}),
    "resources/spectra/mcd.csv": following(OF_MCD),
    "resources/spectra/ruby.csv": following(
        SUBSTITUTE
        - MASTERS
        - POOLED
        - OF_SPECTRA
        - {"compute_filtered_pull_off", "map_forces", SCALED}
    ),
    "resources/spectra/height_distribution.csv": set(),  # its values are parameters of the rules
}


def overlay(key, value):
    """Return the overlay that gives this value to a key with dots."""
    for part in reversed(key.split(".")):
        value = {part: value}
    return value


def with_line(path):
    """Return a change that adds a line without meaning: a comment, or an empty row."""

    def change(folder):
        with open(folder / path, "a") as file:
            file.write("\n" if path.endswith((".csv", ".tsv")) else "\n# another line\n")

    return change


def with_column(column, text):
    """Return a change of one column in the rows of mcd, and of what has to go with it.

    A column that the table lacks is empty in the other rows.
    """

    def change(folder):
        path = folder / "config/surfaces.tsv"
        table = pd.read_csv(path, sep="\t", dtype=str, keep_default_na=False)
        rows = table.surface == "mcd"
        if column == "scan":
            rows &= table.scan == "2"
        table.loc[rows, column] = text
        if column == "surface":  # of which Table 1 has no row to calibrate it to
            table.loc[rows, "path"] = "resources/spectra/ruby.csv"
        if column == "source":
            table.loc[rows, "path"] = [f"{number}.nc" for number in table.scan[rows]]
            for name in table.path[rows]:
                scan(folder / name, heights(128, 128), (2500.0, 2500.0))
        table.to_csv(path, sep="\t", index=False)

    return change


def same_table(folder):
    """Copy the table of surfaces, for the key that names it."""
    shutil.copy2(folder / "config/surfaces.tsv", folder / "config/same.tsv")


def text_says_the_same(folder):
    """Write the configuration with its keys in another order and with other comments."""
    for name in ("config/config.yaml", QUICK):
        content = yaml.safe_load((folder / name).read_text())
        reordered = yaml.safe_dump(dict(reversed(content.items())), sort_keys=False)
        (folder / name).write_text(f"# the same\n{reordered}")


def checked_out(folder):
    """Write all files again with the same content, as a checkout does."""
    for part in PARTS:
        for path in [folder / part, *(folder / part).rglob("*")]:
            if path.is_file():
                content = path.read_bytes()
                path.unlink()
                path.write_bytes(content)


#: Name -> configuration laid over the quick study, what is done to its files, what is to be made.
CHANGES = (
    {
        key: (overlay(key, value), same_table, following(rules | KEPT))
        for key, (value, rules) in KEYS.items()
    }
    | {
        key: (overlay(key, value), same_table, rules | following({"aggregate_robustness"} | KEPT))
        for key, (value, rules) in KEYS_OF_VARIANTS.items()
    }
    | {
        f"column {name}": (
            {"scans": [1, 2, 6]} if name == "scan" else {},
            with_column(name, text),
            following(rules | {"keep_configuration"}),
        )
        for name, (text, rules) in COLUMNS.items()
    }
    | {path: ({}, with_line(path), rules) for path, rules in FILES.items()}
    | {
        f"workflow/scripts/{name}": (
            {}, with_line(f"workflow/scripts/{name}"), all_following(rules_of(name) - IDLE)
        )
        for name in SCRIPTS
    }
    | {"effort": ({"effort": "quick", "quick": {"seed": 1}}, lambda folder: None,
                  following(KEYS["seed"][1] | KEPT))}
    | {"nothing": ({}, lambda folder: None, set())}
    | {"touch and checkout": ({}, checked_out, set())}
    | {"comments and order of keys": ({}, text_says_the_same, set())}
)  # fmt: skip
