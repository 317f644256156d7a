"""Studies whose keys, tables and scans contradict each other: one line that says so."""

import numpy as np
import pytest
import yaml
from paper_numbers import SUBSTRATES
from refusals import assert_says, refusal
from repository import PAPER, QUICK, ROOT, merged
from scan_files import heights, scan
from studies import check, numbers, own_scans

from hardcontact.config.grids import Grid
from hardcontact.config.limits import check_grids
from hardcontact.config.model import configuration


@pytest.mark.parametrize(
    ("change", "parts"),
    [
        (("scales.small.cutoffs", ["1.2 nm"]), ["scales.small.cutoffs", "1.221 nm", "found 1.2"]),
        (("scales.small.cutoffs", ["6 um"]), ["scales.small.cutoffs", "5000 nm", "found 6000"]),
        (("scales.large.cutoffs", ["9 nm"]), ["scales.large.cutoffs", "9.766 nm", "found 9 nm"]),
        (("scales.large.cutoffs", ["21 um"]), ["scales.large.cutoffs", "20000 nm"]),
        (("scales.small.cutoffs", ["9 nm", "5 nm"]), ["ascending", "found 5 nm after 9 nm"]),
        (("adhesion.ranges", ["1 nm", "0.001 um"]), ["ascending", "found 0.001 um after 1 nm"]),
        (("scales.small.transition", "9 nm"), ["scales.small.transition", "found 9 nm"]),
        (("scales.small.pixels", 512), ["scales.small.pixels", "1024", "found 512"]),
        (("scales.large.pixels", 512), ["scales.large.pixels", "4096", "found 512"]),
        (
            ("scan.pixels", 32, "sphere.radius", "2500 nm"),
            ["adhesion.ranges", "at least 4.89 nm on", "two pixels", "found 0.05 nm"],
        ),
        (
            ("contact.preload", "1 N"),
            ["contact.preload", "a quarter of", "at most 156 mN", "found 1 N"],
        ),
        (("contact.window", "10 nm"), ["contact.preload", "4 pixels", "at most 596 nN", "10 µN"]),
        (
            ("scan.pixels", 64, "contact.count", 129),
            ["contact.count", "128", "found 129"],
        ),
        (("sphere.radius", "2 um"), ["sphere.radius", "2500 nm", "found 2000 nm"]),
        (("store", "results/paper/store"), ["store", "results/paper", "found results/paper/store"]),
        (("store", "workflow/store"), ["store", "in results or outside", "found workflow/store"]),
        (("store", "results"), ["store", "apart from results/paper", "found results"]),
        (("effort", "quick"), ["effort", "no keys stand under quick", "config/quick.yaml"]),
        (("scan.size", "20 nm"), ["scan.size", "0.05 to 10000 nm", "found 0.0390625 nm"]),
        (("contact.window", "90 um"), ["contact.window", "16384", "found 18432"]),
        (("indent.preloads", ["3 mN"]), ["indent.preloads", "4096", "found 5034"]),
        (
            ("contact.count", 200, "contact.preload", "0.5 mN"),
            ["contact.preload", "at most 160 µN", "found 500 µN"],
        ),
        (
            ("robustness.heights.skewness", [0.1234567]),
            ["robustness.heights.skewness", "six digits", "0.1234567"],
        ),
        (("sets.pool", 4), ["sets.pool", "the 5 scans of polished_uncd", "found 4"]),
        (("sphere.surface", "glass"), ["sphere.surface", "ruby", "found glass"]),
        (("reference_surface", "glass"), ["reference_surface", "mcd", "found glass"]),
        (("reference_surface", "ruby"), ["reference_surface", "mcd", "found ruby"]),
        (("scans", [1, 7]), ["config key scans", "[1, 2, 3, 4, 5]", "found [7]"]),
        (("indent.surface", "glass"), ["indent.surface", "mcd", "found glass"]),
        (("indent.surface", "ruby"), ["indent.surface", "mcd", "found ruby"]),
        (("elastic.contacts", 401), ["elastic.contacts", "400", "found 401"]),
        (("asperities.contacts", 401), ["asperities.contacts", "400", "found 401"]),
        (("asperities.ranges", ["2 nm", "1 nm"]), ["asperities.ranges", "found 1 nm after 2 nm"]),
        (("indent.preloads", ["1 uN", "1 N"]), ["indent.preloads", "at most 156 mN", "found 1 N"]),
        (("robustness.preloads", ["1 uN", "1 N"]), ["robustness.preloads", "found 1 N"]),
        (("robustness.hardnesses", ["0.1 MPa", "1 GPa"]), ["at least 0.0016 GPa"]),
        (
            ("robustness.hardnesses", ["2 GPa", "1 GPa"]),
            ["found 1 GPa after 2 GPa"],
        ),
        (("robustness.tip_radii", ["17 nm", "10 nm"]), ["robustness.tip_radii", "ascending"]),
        (("robustness.heights.surface", "brass"), ["robustness.heights.surface", "found brass"]),
        (("robustness.preloads", ["5 uN", "0.005 mN"]), ["found 0.005 mN after 5 uN"]),
        (
            ("indent.preloads", ["20 uN", "10 uN"]),
            ["indent.preloads", "found 10 uN after 20 uN"],
        ),
        (
            (
                *("contact.preload", "20 mN", "contact.hardness", "1000 GPa"),
                *("elastic.sphere.modulus", "50 GPa", "elastic.substrate.modulus", "50 GPa"),
            ),
            ["contact.preload", "at most 6.69 mN", "5000 nm", "found 20 mN"],
        ),
        (("sets.large.pixels", 4094), ["sets.large.pixels", "4096", "found 4094"]),
        (("sets.small.cutoffs", ["2 nm"]), ["sets.small.cutoffs", "2.441 nm"]),
        (("scales.large.tiles", 8), ["sets.large.pixels", "8192", "found 4096"]),
        (
            ("insight.scaling.large.pixels", 4094),
            ["insight.scaling.large.pixels", "4096", "found 4094"],
        ),
        (
            ("insight.scaling.small.cutoffs", ["2 nm"]),
            ["insight.scaling.small.cutoffs", "4.883 nm", "found 2 nm"],
        ),
        (
            ("insight.scaling.preloads", ["80 uN", "10 uN"]),
            ["insight.scaling.preloads", "found 10 uN after 80 uN"],
        ),
        (
            ("insight.scaling.preloads", ["10 uN", "1 N"]),
            ["insight.scaling.preloads", "a quarter of", "at most 156 mN", "found 1 N"],
        ),
        (
            ("insight.scaling.preloads", ["10 uN", "50 mN"], "insight.count", 200),
            [
                *("insight.scaling.preloads", "2.441 nm", "insight.count = 200"),
                *("at most 250 µN", "found 50 mN"),
            ],
        ),
        (
            ("insight.scaling.ranges", ["0.9 nm", "5.6 nm"]),
            ["insight.scaling.ranges", "at least 1 nm on", "500 nm apart", "found 0.9 nm"],
        ),
        (
            ("insight.scaling.radii", ["30 nm", "250 um"]),
            ["insight.scaling.ranges", "at least 1.59 nm on", "at R = 30 nm", "found 1.4 nm"],
        ),
        (
            ("insight.ranges", ["0.04 nm", "1 nm"]),
            ["insight.ranges", "at least 0.05 nm on", "25 nm apart", "found 0.04 nm"],
        ),
    ],
)
def test_key_refused_for_what_other_keys_and_the_table_say(tmp_path, at_root, change, parts):
    assert_says(
        refusal(lambda: check(numbers(*change), tmp_path)),
        "config key",
        "expected",
        "found",
        *parts,
    )


def test_limits_of_other_keys_may_be_reached(tmp_path, at_root):
    config = numbers("elastic.contacts", 400, "asperities.contacts", 400, "indent.surface", "mcd")
    check(config, tmp_path)
    insight = numbers(
        *("insight.ranges", ["0.05 nm"], "insight.scaling.preloads", ["50 mN"]),
        *("insight.scaling.ranges", ["1 nm"], "insight.scaling.radii", ["50 nm"]),
    )
    check(insight, tmp_path)


def test_limits_of_insight_are_told_one_line_a_surface(tmp_path, at_root):
    changes = [("insight.ranges", ["0.04 nm", "1 nm"]), ("insight.scaling.ranges", ["0.9 nm"])]
    for key, values in changes:
        lines = refusal(check, numbers(key, values), tmp_path).splitlines()
        assert len(lines) == len(SUBSTRATES)
        for surface, line in zip(SUBSTRATES, lines, strict=True):
            start = f"config key {key}: expected at least"
            assert line.startswith(start) and f" on {surface}, " in line


def test_keys_of_insight_do_not_matter_to_a_study_without_the_chapter(at_root):
    grids = {"glass": Grid(512, 4.883, 2500.0, 500.0)}
    for key, value in (("insight.ranges", "0.04 nm"), ("insight.scaling.preloads", "1 N")):
        config = numbers(key, [value])
        assert_says(refusal(check_grids, config, grids), f"config key {key}: expected")
        check_grids(config | {"published": "none"}, grids)


def test_the_study_of_the_paper_and_the_quick_one_pass(tmp_path, at_root):
    quick = yaml.safe_load((ROOT / QUICK).read_text())
    for overlay in ({}, quick):
        config = configuration(merged(PAPER, overlay))
        check(config, tmp_path)


def in_other_order(tree):
    if not isinstance(tree, dict):
        return tree
    return {key: in_other_order(tree[key]) for key in reversed(tree)}


def test_keys_may_come_in_any_order(tmp_path, at_root):
    config = configuration(in_other_order(PAPER))
    assert config == numbers()
    check(config, tmp_path)


# Measured scans


def test_scans_of_one_surface_that_differ(tmp_path, at_root):
    first = scan(tmp_path / "a.nc", heights(512, 512), (2500.0, 2500.0))
    others = {
        "found 256 of 9.766 nm": scan(tmp_path / "b.nc", heights(256, 256), (2500.0, 2500.0)),
        "found 512 of 9.766 nm": scan(tmp_path / "c.nc", heights(512, 512), (5000.0, 5000.0)),
    }
    for found, second in others.items():
        message = refusal(check, numbers(), tmp_path, own_scans(first, second))
        assert_says(message, second.name, "512 pixels of 4.883 nm", found)


def test_measured_scan_of_constant_height(tmp_path, at_root):
    text = own_scans(scan(tmp_path / "a.nc", np.ones((32, 32))))
    message = refusal(check, numbers(), tmp_path, text)
    assert_says(message, "a.nc", "rough", "constant height")
