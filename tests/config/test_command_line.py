"""Bad studies on the command line: one line before anything is made."""

import os
from pathlib import Path

import numpy as np
import pytest
from own_studies import rough
from refusals import assert_says
from repository import run_snakemake, snakemake
from scan_files import cut, heights, scan
from studies import own_scans

pytestmark = pytest.mark.study


def own_table(folder, path):
    """Write the paper's table with one measured scan; return its overlay."""
    Path(folder, "own.tsv").write_text(own_scans(path))
    return {"surfaces": "own.tsv"}


def truncated_scan(folder):
    return own_table(folder, cut(scan(Path(folder, "own.nc")), 0.5).name)


def scan_with_holes(folder):
    values = np.ma.masked_array(heights(), False)
    values[:7, 0] = np.ma.masked
    return own_table(folder, scan(Path(folder, "own.nc"), values).name)


def missing_scan(folder):
    return own_table(folder, "none.nc")


@pytest.mark.parametrize(
    ("arguments", "overlay", "parts"),
    [
        ([], {"studdy": 1}, ["studdy"]),
        ([], {"contact": {"preload": 10}}, ["config key contact.preload", "found 10"]),
        (["-n"], {"scales": {"small": {"cutoffs": ["1 nm"]}}}, ["scales.small.cutoffs"]),
        ([], {"quick": {"contact": {"count": 0}}}, ["effort quick", "contact.count", "found 0"]),
        ([], missing_scan, ["own.tsv", "none.nc", "no such file"]),
        ([], truncated_scan, ["own.nc", "expected a whole file"]),
        (["-n"], scan_with_holes, ["own.nc", "found 7", "scan.undefined_pixels"]),
    ],
)
def test_command_line_refuses_in_one_line(repository, arguments, overlay, parts):
    overlay = overlay(repository) if callable(overlay) else overlay
    run = run_snakemake(repository, *arguments, overlays=[overlay])
    assert run.returncode != 0
    errors = [line for line in run.stdout.splitlines() if line.startswith("error:")]
    assert errors, run.stdout
    for error in errors:  # one a surface, where it concerns all of them
        assert_says(error, "expected", "found", *parts)
    assert "Traceback" not in run.stdout and "rule " not in run.stdout
    assert not Path(repository, "results").exists()


@pytest.mark.parametrize(
    ("files", "part"),
    [
        ({"bad.yaml": "study: store"}, "config key store: expected a folder apart from"),
        ({"bad.yaml": "seed: 1\n'seed': 2"}, "bad.yaml: line 2: expected each key once"),
        ({"bad.yaml": "5: 6"}, "config key (top level): expected one of study"),
        ({"bad.yaml": "surfaces: bad.tsv", "bad.tsv": "\xff"}, "bad.tsv: expected a table of"),
        ({"bad.yaml": "study: !!python/object/apply:os.mkdir [made]"}, "bad.yaml: expected YAML"),
    ],
)
def test_bad_files_are_refused_before_anything_is_made(repository, files, part):
    for name, content in files.items():
        Path(repository, name).write_bytes(content.encode("latin-1"))
    before = sorted(os.listdir(repository))
    run = snakemake(repository, "-n", "--configfile", "bad.yaml")
    said = [line for line in run.stdout.splitlines() if part in line]
    assert run.returncode != 0 and len(said) == 1, run.stdout
    assert said[0].startswith("error: ")
    assert "Traceback" not in run.stdout and "rule " not in run.stdout
    for name in files:
        Path(repository, name).unlink()
    assert set(os.listdir(repository)) - set(before) <= {".snakemake"}


#: Odd pixels, cutoffs and transitions at their ends, one scan of one substrate, one contact.
ACCEPTED = {
    "study": "tiny",
    "store": "results/store-tiny",
    "surfaces": "tiny.tsv",
    "scans": "all",
    "scan": {"pixels": 21, "size": "210 nm"},
    "contact": {"count": 1, "window": "420 nm", "preload": "1 uN"},
    "adhesion": {"ranges": ["0.5 nm", "1 um"]},
    "scales": {
        "realizations": 1,
        "sphere_roughness": True,
        "small": {"pixels": 66, "transition": "20.001 nm", "cutoffs": ["20.001 nm"]},
        "large": {"pixels": 198, "tiles": 3, "transition": "1980 nm", "cutoffs": ["1980 nm"]},
    },
    "reference_surface": "uncd",
    "elastic": {"contacts": 1},
    "indent": {"surface": "uncd", "preloads": ["1 mN"]},
    "asperities": {"contacts": 1},
    "sets": {
        "count": 1,
        "small": {"pixels": 66, "cutoffs": ["20.001 nm"]},
        "large": {"pixels": 198, "cutoffs": ["1980 nm"]},
    },
    "insight": {
        "small": {"pixels": 66, "cutoffs": ["20.001 nm"]},
        "large": {"pixels": 198, "tiles": 3, "cutoffs": ["1980 nm"]},
        "scaling": {
            "small": {"cutoffs": ["20.001 nm"]},
            "large": {"pixels": 198, "tiles": 3, "cutoffs": ["1980 nm"]},
        },
    },
    "robustness": {
        "preloads": [],
        "hardnesses": [],
        "heights": {"surface": "uncd", "skewness": []},
        "tip_radii": [],
    },
}


def test_an_accepted_study_at_the_limits_runs(repository):
    surface = rough(np.random.default_rng(1), 33, 330.0)
    scan(repository / "own.nc", surface, (330.0, 330.0))
    (repository / "tiny.tsv").write_text(
        "surface\tlabel\tscan\tsource\tpath\tdataset\n"
        "uncd\tUNCD & <b>\t7\tmeasured\town.nc\t\n"
        "ruby\truby\t1\tsubstitute\tresources/spectra/ruby.csv\t\n"
    )
    for arguments in (["-n"], ["adhesion", "scales"]):
        run = run_snakemake(repository, *arguments, overlays=[ACCEPTED])
        assert run.returncode == 0, run.stdout[-3000:]
    assert {path.name for path in (repository / "results/tiny").glob("*.nc")} == {
        "adhesion.nc", "band.nc", "contact.nc", "scales.nc",
    }  # fmt: skip
