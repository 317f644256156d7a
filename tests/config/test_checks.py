"""Studies whose keys, tables and scans contradict each other: one line that says so."""

import numpy as np
import pytest
from refusals import assert_says, refusal
from scan_files import heights, scan
from studies import check, numbers, own_scans

from hardcontact.config.grids import Grid
from hardcontact.config.limits import check_grids


@pytest.mark.parametrize(
    ("change", "parts"),
    [
        (("scales.small.cutoffs", ["1.2 nm"]), ["scales.small.cutoffs", "1.221 nm", "found 1.2"]),
        (("scales.small.cutoffs", ["6 um"]), ["scales.small.cutoffs", "5000 nm", "found 6000"]),
        (("scales.large.cutoffs", ["21 um"]), ["scales.large.cutoffs", "20000 nm"]),
        (("adhesion.ranges", ["1 nm", "0.001 um"]), ["ascending", "found 0.001 um after 1 nm"]),
        (("scales.small.transition", "9 nm"), ["scales.small.transition", "found 9 nm"]),
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
        (("reference_surface", "ruby"), ["reference_surface", "mcd", "found ruby"]),
        (("scans", [1, 7]), ["config key scans", "[1, 2, 3, 4, 5]", "found [7]"]),
        (("indent.surface", "glass"), ["indent.surface", "mcd", "found glass"]),
        (("elastic.contacts", 401), ["elastic.contacts", "400", "found 401"]),
        (("asperities.contacts", 401), ["asperities.contacts", "400", "found 401"]),
        (("robustness.preloads", ["1 uN", "1 N"]), ["robustness.preloads", "found 1 N"]),
        (("robustness.hardnesses", ["0.1 MPa", "1 GPa"]), ["at least 0.0016 GPa"]),
        (("robustness.heights.surface", "brass"), ["robustness.heights.surface", "found brass"]),
        (
            (
                *("contact.preload", "20 mN", "contact.hardness", "1000 GPa"),
                *("elastic.sphere.modulus", "50 GPa", "elastic.substrate.modulus", "50 GPa"),
            ),
            ["contact.preload", "at most 6.69 mN", "5000 nm", "found 20 mN"],
        ),
        (("sets.large.pixels", 4094), ["sets.large.pixels", "4096", "found 4094"]),
        (("scales.large.tiles", 8), ["sets.large.pixels", "8192", "found 4096"]),
        (
            ("insight.scaling.small.cutoffs", ["2 nm"]),
            ["insight.scaling.small.cutoffs", "4.883 nm", "found 2 nm"],
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


def test_keys_of_insight_do_not_matter_to_a_study_without_the_chapter(at_root):
    grids = {"glass": Grid(512, 4.883, 2500.0, 500.0)}
    for key, value in (("insight.ranges", "0.04 nm"), ("insight.scaling.preloads", "1 N")):
        config = numbers(key, [value])
        assert_says(refusal(check_grids, config, grids), f"config key {key}: expected")
        check_grids(config | {"published": "none"}, grids)


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
