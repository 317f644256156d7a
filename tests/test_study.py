"""Bad configurations and tables: one line, the key or row, what was expected and found."""

from functools import reduce
from pathlib import Path

import numpy as np
import pytest
import yaml
from conftest import (
    PAPER,
    PUBLISHED,
    QUICK,
    ROOT,
    ROWS,
    SCHEMAS,
    assert_says,
    cut,
    heights,
    merged,
    refusal,
    run_snakemake,
    scan,
)

from hardcontact import study

MISSING = object()


def changed(*values):
    """The paper's configuration with other values: key, value, key, value, ..."""
    config = yaml.safe_load(yaml.safe_dump(PAPER))
    for key, value in zip(values[::2], values[1::2], strict=True):
        *path, last = key.split(".")
        place = reduce(dict.get, path, config)
        if value is MISSING:
            del place[last]
        else:
            place[last] = value
    return config


def numbers(*values):
    return study.configuration(changed(*values), SCHEMAS["config"])


def surfaces(text, folder):
    """Read a table of surfaces of this text, with paths relative to the repository's root."""
    path = folder / "surfaces.tsv"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return study.surface_table(path, SCHEMAS["surfaces"])


def selected(config, folder):
    return study.selected_scans(surfaces(ROWS, folder), config["scans"])


# Keys


@pytest.mark.parametrize(
    ("key", "value", "parts"),
    [
        ("studdy", "a", ["found studdy"]),
        ("scan.pixel", 5, ["config key scan:", "pixels", "found pixel"]),
        ("seed", MISSING, ["found no seed"]),
        ("scales.small.cutoffs", MISSING, ["config key scales.small:", "found no cutoffs"]),
        ("sphere.radius", "250 N", ["config key sphere.radius:", "nm", "'250 N'"]),
        ("contact.hardness", "25 GPa m", ["config key contact.hardness:", "Pa", "'25 GPa m'"]),
        ("contact.hardness", "25 foo", ["config key contact.hardness:", "'25 foo'"]),
        ("sphere.radius", "-250 um", ["config key sphere.radius:", "10 to 1e+09 nm", "-250 um"]),
        ("sphere.radius", "0 um", ["config key sphere.radius:", "10 to 1e+09 nm", "0 um"]),
        ("inference.force_floor", "0 nN", ["inference.force_floor:", "1e-12 to 1 N"]),
        (
            "contact.preload",
            1.0e-5,
            ["config key contact.preload:", "a number with a unit", "1e-05"],
        ),
        ("contact.preload", "10", ["config key contact.preload:", "unit", "'10'"]),
        ("contact.preload", "ten uN", ["config key contact.preload:", "'ten uN'"]),
        ("contact.preload", "nan uN", ["config key contact.preload:", "'nan uN'"]),
        ("contact.preload", "inf uN", ["config key contact.preload:", "'inf uN'"]),
        ("contact.preload", "9**9**9 uN", ["config key contact.preload:", "'9**9**9 uN'"]),
        ("contact.count", 0, ["config key contact.count:", "at least 1", "found 0"]),
        ("contact.count", "20", ["config key contact.count:", "a whole number", "found '20'"]),
        ("contact.count", 20.0, ["contact.count:", "a whole number", "found 20.0"]),
        ("contact.count", True, ["contact.count:", "a whole number", "found True"]),
        ("contact.count", 201, ["config key contact.count:", "at most 200", "found 201"]),
        ("scan.pixels", 10**9, ["config key scan.pixels:", "at most 8192", "found 1000000000"]),
        ("scales.small.pixels", 8191, ["scales.small.pixels:", "a multiple of 2", "found 8191"]),
        ("scales.small.cutoffs", ["1e300 nm"], ["cutoffs.0:", "0.01 to 1e+09 nm", "'1e300 nm'"]),
        ("store", "results/{scan}", ["config key store:", "letters", "'results/{scan}'"]),
        ("store", "results/../a", ["config key store:", "letters", "'results/../a'"]),
        ("study", "a\n", ["config key study:", "letters", "'a\\n'"]),
        ("inference.confidence", float("nan"), ["inference.confidence:", "a number", "nan"]),
        ("a\nb", 1, ["(top level)", "found 'a\\nb'"]),
        ("scales.sphere_roughness", "yes", ["true or false", "found 'yes'"]),
        (
            "scales.small.cutoffs",
            [5],
            ["config key scales.small.cutoffs.0:", "a number with a unit", "5"],
        ),
        ("scales.small.cutoffs", [], ["config key scales.small.cutoffs:", "at least 1 entries"]),
        ("scan.undefined_pixels", "fill", ["scan.undefined_pixels:", "harmonic", "'fill'"]),
        ("scans", "some", ["config key scans:", "expected all", "a list", "'some'"]),
        ("study", "../a", ["config key study:", "letters", "'../a'"]),
        ("inference.confidence", 95, ["inference.confidence:", "at most 0.999", "found 95"]),
        ("sphere", "ruby", ["config key sphere:", "a mapping", "found 'ruby'"]),
        ("adhesion.traced_contact.contact", [1], ["at least 2 entries", "found [1]"]),
        ("elastic.sphere.modulus", "4 GPa", ["5e+10 to 1e+13 Pa", "4 GPa"]),
        ("elastic.sphere.modulus", "365 N", ["config key elastic.sphere.modulus:", "Pa"]),
        ("elastic.substrate.modulus", MISSING, ["key elastic.substrate:", "found no modulus"]),
        ("elastic.sphere.poisson_ratio", 0.7, ["poisson_ratio:", "at most 0.5", "found 0.7"]),
        ("elastic.contacts", 0, ["config key elastic.contacts:", "at least 1", "found 0"]),
        ("indent.preloads", [], ["config key indent.preloads:", "at least 1 entries"]),
        ("asperities.share", 1.0, ["config key asperities.share:", "at most 0.999", "found 1.0"]),
        ("robustness.preloads", ["5 nm"], ["config key robustness.preloads.0:", "N", "'5 nm'"]),
        ("robustness.skewness", [2], ["robustness.skewness.0:", "at most 1", "found 2"]),
        ("robustness.skewness", [0, 0.0], ["robustness.skewness:", "each entry once"]),
    ],
)
def test_key_refused(key, value, parts):
    assert_says(refusal(numbers, key, value), "config key", "expected", *parts)


@pytest.mark.parametrize(
    ("text", "key"),
    [
        ("scan: {size: 1 nm}\ncontact: {count: 1}\nscan: {pixels: 2}", "scan"),
        ("contact:\n  count: 1\n  count: 2", "contact.count"),
    ],
)
def test_a_key_given_twice(tmp_path, text, key):
    path = tmp_path / "a.yaml"
    path.write_text(text)
    assert refusal(study.refuse_repeated_keys, path) == (
        f"{path}: line 3: expected each key once, found {key} again"
    )


@pytest.mark.parametrize(
    "text",
    [
        "contact: {count: 1}\nrobustness: {count: 1}",
        "scan: &a {size: 1 nm, again: *a}\ncontact: *a",  # an alias that holds itself
        '{\n\t"seed": 1\n}',  # JSON with tabs
        "",
    ],
)
def test_a_key_given_once(tmp_path, text):
    path = tmp_path / "a.yaml"
    path.write_text(text)
    study.refuse_repeated_keys(path)


def test_quantities_become_numbers():
    config = numbers("sphere.radius", "0.25 mm", "contact.preload", "1.0e-5 N")
    assert config["sphere"]["radius"] == 250e3
    assert config["contact"]["preload"] == 1e-5
    assert config["scales"]["small"]["cutoffs"][0] == 5.0
    assert config["elastic"]["sphere"] == {"modulus": 365e9, "poisson_ratio": 0.29}
    assert config["robustness"]["hardnesses"] == [16e9, 47e9]


@pytest.mark.parametrize(
    ("change", "parts"),
    [
        (("scales.small.cutoffs", ["1.2 nm"]), ["scales.small.cutoffs", "1.221 nm", "found 1.2"]),
        (("scales.small.cutoffs", ["6 um"]), ["scales.small.cutoffs", "5000 nm", "found 6000"]),
        (("scales.large.cutoffs", ["9 nm"]), ["scales.large.cutoffs", "9.766 nm", "found 9 nm"]),
        (("scales.large.cutoffs", ["21 um"]), ["scales.large.cutoffs", "20000 nm"]),
        (("scales.small.cutoffs", ["9 nm", "5 nm"]), ["ascending", "found 5 nm after 9 nm"]),
        (("adhesion.ranges", ["1 nm", "0.001 um"]), ["ascending", "found 1 nm after 1 nm"]),
        (("scales.small.transition", "9 nm"), ["scales.small.transition", "found 9 nm"]),
        (("scales.small.pixels", 512), ["scales.small.pixels", "1024", "found 512"]),
        (("scales.large.pixels", 512), ["scales.large.pixels", "4096", "found 512"]),
        (
            ("scan.pixels", 32, "elastic.window", "2500 nm", "sphere.radius", "2500 nm"),
            ["adhesion.ranges", "156.2", "found 50 nm"],
        ),
        (("contact.preload", "1 N"), ["contact.preload", "a quarter of", "262144", "1677722"]),
        (("contact.window", "10 nm"), ["contact.preload", "1, can carry", "needs 17"]),
        (
            ("scan.pixels", 64, "contact.count", 129, "elastic.window", "800 nm"),
            ["contact.count", "128", "found 129"],
        ),
        (("sphere.radius", "2 um"), ["sphere.radius", "2500 nm", "found 2000 nm"]),
        (("store", "results/paper/store"), ["store", "results/paper", "found results/paper/store"]),
        (("store", "results"), ["store", "apart from results/paper", "found results"]),
        (("scan.size", "20 nm"), ["scan.size", "0.05 to 10000 nm", "found 0.0390625 nm"]),
        (("contact.window", "90 um"), ["contact.window", "16384", "found 18432"]),
        (("indent.preloads", ["3 mN"]), ["indent.preloads", "4096", "found 5034"]),
        (
            ("contact.count", 200, "contact.preload", "0.5 mN"),
            ["contact.preload", "at most 268", "found 839"],
        ),
        (("robustness.skewness", [0.1234567]), ["robustness.skewness", "six digits", "0.1234567"]),
        (("sphere.surface", "glass"), ["sphere.surface", "ruby", "found glass"]),
        (("reference_surface", "glass"), ["reference_surface", "mcd", "found glass"]),
        (("reference_surface", "ruby"), ["reference_surface", "mcd", "found ruby"]),
        (("adhesion.traced_contact.surface", "ruby"), ["traced_contact.surface", "found ruby"]),
        (("adhesion.traced_contact.scan", 9), ["traced_contact.scan", "uncd [1, 2", "found 9"]),
        (("adhesion.traced_contact.sphere_scan", 9), ["traced_contact.sphere_scan", "found 9"]),
        (("adhesion.traced_contact.contact", [20, 0]), ["contact.count = 20", "found [20, 0]"]),
        (("scan.realization_pixels", 256), ["scan.realization_pixels", "512", "found 256"]),
        (("scans", [1, 7]), ["config key scans", "[1, 2, 3, 4, 5]", "found [7]"]),
        (("indent.surface", "glass"), ["indent.surface", "mcd", "found glass"]),
        (("indent.surface", "ruby"), ["indent.surface", "mcd", "found ruby"]),
        (("elastic.contacts", 401), ["elastic.contacts", "400", "found 401"]),
        (("asperities.contacts", 401), ["asperities.contacts", "400", "found 401"]),
        (("asperities.ranges", ["2 nm", "1 nm"]), ["asperities.ranges", "found 1 nm after 2 nm"]),
        (("indent.preloads", ["1 uN", "1 N"]), ["indent.preloads", "262144", "1677722"]),
        (("robustness.preloads", ["1 uN", "1 N"]), ["robustness.preloads", "1677722"]),
        (("robustness.hardnesses", ["0.1 MPa", "1 GPa"]), ["robustness.hardnesses", "4194304"]),
        (
            ("robustness.hardnesses", ["2 GPa", "1 GPa"]),
            ["found 1000000000 Pa after 2000000000 Pa"],
        ),
        (("robustness.preloads", ["5 uN", "0.005 mN"]), ["found 5e-06 N after 5e-06 N"]),
        (
            ("indent.preloads", ["20 uN", "10 uN"]),
            ["indent.preloads", "found 1e-05 N after 2e-05 N"],
        ),
        (
            (
                *("contact.preload", "20 mN", "contact.hardness", "1000 GPa"),
                *("elastic.sphere.modulus", "50 GPa", "elastic.substrate.modulus", "50 GPa"),
            ),
            ["contact.preload", "at most 0.00669 N", "5000 nm", "found 0.02 N"],
        ),
        (("elastic.window", "50 nm"), ["elastic.window", "16 pixels", "78.12 nm", "found 50 nm"]),
        (("robustness.large.pixels", 4094), ["robustness.large.pixels", "4096", "found 4094"]),
        (("robustness.small.cutoffs", ["2 nm"]), ["robustness.small.cutoffs", "2.441 nm"]),
        (("scales.large.tiles", 8), ["robustness.large.pixels", "8192", "found 4096"]),
    ],
)
def test_key_refused_for_what_other_keys_and_the_table_say(tmp_path, at_root, change, parts):
    def check():
        config = numbers(*change)
        study.check(config, selected(config, tmp_path), PUBLISHED)

    assert_says(refusal(check), "config key", "expected", "found", *parts)


def test_limits_of_other_keys_may_be_reached(tmp_path, at_root):
    config = numbers("elastic.contacts", 400, "asperities.contacts", 400, "indent.surface", "mcd")
    study.check(config, selected(config, tmp_path), PUBLISHED)


def test_the_study_of_the_paper_and_the_quick_one_pass(tmp_path, at_root):
    quick = yaml.safe_load((ROOT / QUICK).read_text())
    for overlay in ({}, quick):
        config = study.configuration(merged(PAPER, overlay), SCHEMAS["config"])
        study.check(config, selected(config, tmp_path), PUBLISHED)


def in_other_order(tree):
    if not isinstance(tree, dict):
        return tree
    return {key: in_other_order(tree[key]) for key in reversed(tree)}


def test_keys_may_come_in_any_order(tmp_path, at_root):
    config = study.configuration(in_other_order(PAPER), SCHEMAS["config"])
    assert config == numbers()
    study.check(config, selected(config, tmp_path), PUBLISHED)


# The table of surfaces


FIRST = ROWS.splitlines()[1]


def with_description(name, count=-1):
    """The paper's table with another description of UNCD in the first rows."""
    return ROWS.replace("spectra/uncd.csv", f"spectra/{name}", count)


@pytest.mark.parametrize(
    ("text", "parts"),
    [
        (ROWS + FIRST + "\n", ["line 27", "once", "polished_uncd 1"]),
        (with_description("no.csv"), ["line 7", "spectra/no.csv", "no such file"]),
        (ROWS.replace("label", "name", 1), ["the columns", "label", "found surface, name"]),
        (
            ROWS.replace("\tdataset", "").replace("csv\t", "csv"),
            ["the columns", "path and 25 rows"],
        ),
        (ROWS.replace("2\tsubstitute", "2\tmeasured", 1), ["polished_uncd", "one source"]),
        (ROWS.replace("UNCD\t2", "U\t2", 1), ["polished_uncd", "one label", "polished U"]),
        (with_description("mcd.csv", 1), ["surface uncd", "one path", "mcd.csv"]),
        (ROWS.replace("UNCD\t1", "UNCD\tone", 1), ["line 2", "scan", "found 'one'"]),
        (ROWS.replace("substitute", "guess", 1), ["line 2", "source", "found 'guess'"]),
        (ROWS.replace("\t", ","), ["separated by tabs", "found surface,label"]),
        (ROWS.replace("\t", " "), ["separated by tabs", "found surface label"]),
        (ROWS.partition("\n")[2], ["the columns", "found "]),
        (ROWS.partition("\n")[0], ["a row a scan", "0 rows"]),
        (ROWS + "\t".join("abcdefgh") + "\n", ["line 27", "expected 6 cells", "found 8"]),
        ("", ["expected a table of surfaces"]),
        (b"\xff\xfe\x00garbage", ["expected a table of surfaces"]),
    ],
)
def test_table_refused(tmp_path, at_root, text, parts):
    assert_says(refusal(surfaces, text, tmp_path), "surfaces.tsv", "expected", *parts)


def test_no_table(tmp_path):
    message = refusal(study.surface_table, tmp_path / "none.tsv", SCHEMAS["surfaces"])
    assert_says(message, "none.tsv", "expected a table of surfaces", "found")


def own_scans(folder, *paths):
    """The paper's table with measured scans in place of UNCD's."""
    rows = [row for row in ROWS.splitlines() if not row.startswith("uncd\t")]
    rows += [f"uncd\tUNCD\t{k}\tmeasured\t{path}\t" for k, path in enumerate(paths, start=1)]
    return surfaces("\n".join(rows) + "\n", folder)


def test_one_file_twice(tmp_path, at_root):
    path = scan(tmp_path / "a.nc")
    message = refusal(own_scans, tmp_path, path, path)
    assert_says(message, "surfaces.tsv", "path and dataset once", "a.nc")


def test_scans_of_one_surface_that_differ(tmp_path, at_root):
    first = scan(tmp_path / "a.nc", heights(512, 512), (2500.0, 2500.0))
    others = {
        "found 256 of 9.766 nm": scan(tmp_path / "b.nc", heights(256, 256), (2500.0, 2500.0)),
        "found 512 of 9.766 nm": scan(tmp_path / "c.nc", heights(512, 512), (5000.0, 5000.0)),
    }
    for found, second in others.items():
        table = own_scans(tmp_path, first, second)
        message = refusal(study.check, numbers(), table, PUBLISHED)
        assert_says(message, second.name, "512 pixels of 4.883 nm", found)


def test_measured_scan_of_constant_height(tmp_path, at_root):
    table = own_scans(tmp_path, scan(tmp_path / "a.nc", np.ones((32, 32))))
    assert_says(
        refusal(study.check, numbers(), table, PUBLISHED), "a.nc", "rough", "constant height"
    )


# The command line


def own_table(folder, path):
    """Write the paper's table with one measured scan; returns its overlay."""
    rows = [row for row in ROWS.splitlines() if not row.startswith("uncd\t")]
    rows.append(f"uncd\tUNCD\t1\tmeasured\t{path}\t")
    Path(folder, "own.tsv").write_text("\n".join(rows) + "\n")
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
    assert len(errors) == 1, run.stdout
    assert_says(errors[0], "expected", "found", *parts)
    assert "Traceback" not in run.stdout and "rule " not in run.stdout
    assert not Path(repository, "results").exists()
