"""A study has each file once, and different files for different swept values."""

import numpy as np
import pytest
import scan_files
from paper_numbers import SUBSTRATES, SURFACES
from studies import PATTERNS, files, numbers

from hardcontact.config.configuration import study_contact
from hardcontact.files.master_purposes import contact_grid
from hardcontact.surfaces.height_map import flatten
from hardcontact.surfaces.scans import read_scan

pytestmark = pytest.mark.usefixtures("project_folder")

# Scans and spectra


def test_each_scan_is_paired_with_one_scan_of_the_sphere():
    pairs = files(scans=[1, 2]).pairs_in_turn
    assert [(pair.scan, pair.sphere_scan) for pair in pairs] == [(1, 1), (2, 2)] * len(SUBSTRATES)


def test_measured_surfaces_have_measurements_and_their_spectrum():
    study = files(measured_surfaces=["mcd"])
    assert len(study.measurements("mcd")) == 2 and study.measurements("uncd") == []
    assert study.spectrum("mcd").endswith("mcd/0123abcd/measured-flat.nc")
    assert study.spectrum("uncd").endswith("uncd/0123abcd/calibrated.nc")


def test_the_shape_of_a_rough_sphere_is_subtracted(tmp_path):
    x = (np.arange(64) - 31.5) * 10.0
    ball = -(x[:, None] ** 2 + x**2) / (2 * 250e3)
    rough = np.random.default_rng(1).standard_normal((64, 64))
    path = scan_files.scan(tmp_path / "ball.nc", ball + rough, (640.0, 640.0))
    levelling = files(scans=[1], measured_surfaces=["ruby"]).levelling_settings("ruby")
    levelled = flatten(read_scan(path), **levelling)
    assert levelled.heights.std() == pytest.approx(rough.std(), rel=0.01)
    assert files(measured_surfaces=["uncd"]).levelling_settings("uncd")["sphere_radius"] is None


@pytest.mark.parametrize(
    ("surface", "has_own_scan", "scans"),
    [
        ("uncd", False, [2, 5, 2]),  # in turn
        ("uncd", True, [2, 5, 6, 7, 8]),  # a substitute has a scan for each
        ("mcd", True, [2, 5, 2]),
    ],
)
def test_a_realization_uses_its_scan(surface, has_own_scan, scans):
    study = files(scans=[2, 5], measured_surfaces=["mcd"])
    for realization, scan in enumerate(scans, start=1):
        stitched = study.stitched_of_realization(surface, realization, has_own_scan)
        assert stitched == study.stitched(surface, scan)


def test_scans_are_made_in_groups_that_share_their_conditioning():
    study = files("sets.realizations", 5, measured_surfaces=["mcd"], scans=[1, 3])
    substitutes = [surface for surface in SURFACES if surface != "mcd"]
    assert study.scan_groups == {(1, 3): substitutes, (4, 5): substitutes, (6, 7): substitutes}
    for group in study.scan_groups:
        for scan in group:
            assert study.conditioning("uncd", scan).endswith(
                f"uncd/0123abcd/scan-{group[0]}-flat.nc"
            )


# Masters and pools


def test_every_realization_of_the_study_is_filtered_from_its_own_masters():
    study = files("scales.realizations", 2)
    rows = study.filtered_masters()
    assert len(set(study.paths(PATTERNS.filtered, rows))) == 2 * len(SUBSTRATES)
    assert study.master_sources(rows[1])["short_masters"] == [
        "results/store/masters/digest/polished_uncd/0123abcd/realization-2/short.nc"
    ]


def test_masters_of_sets_are_filtered_in_chunks():
    study = files("sets.realizations", 12)
    rows = study.filtered_masters("sets")
    chunks = [(row.first, row.last) for row in rows]
    assert chunks == [(1, 5), (6, 10), (11, 12)] * len(SUBSTRATES)
    sources = study.master_sources(rows[0])
    assert len(sources["scans"]) == len(sources["spectra"]) == 5


def test_only_substitutes_have_pools_computed_in_chunks():
    study = files("sets.pool", 32, measured_surfaces=["mcd"])
    chunks = [(1, 15), (16, 30), (31, 32)]
    assert study.chunks == [(surface, *chunk) for surface in ("uncd", "ncd") for chunk in chunks]


def test_each_set_has_a_draw_of_the_surface_with_features():
    study = files("sets.replicates", 25)
    kinds = {"bumps": ((1, 10), (11, 13)), "pits": ((1, 10), (11, 13)), "gaussian": ((1, 10),)}
    assert study.draw_chunks == [
        ("polished_uncd", kind, *chunk) for kind, chunks in kinds.items() for chunk in chunks
    ]
    assert "polished_uncd" not in {chunk.surface for chunk in study.chunks}


def test_no_surface_may_have_features():
    assert files("scan.featured_surface", "none").draw_chunks == []
    assert files(measured_surfaces=["polished_uncd"]).draw_chunks == []


# Swept values

SWEPT = {
    "sphere.radius": "300 um",
    "contact.preload": "12 uN",
    "contact.hardness": "30 GPa",
    "scales.range": "3 nm",
    "scaling.radii": ["5 um", "7 um"],
}


def lists_of_files(*values):
    """Return the radii, loads and ranges that each file is computed at, by its path."""
    study = files(*values)
    filtered = [
        *study.filtered_masters(),
        *study.filtered_masters("scaling"),
        *study.filtered_masters("sets"),
        *study.filtered_masters("enhancement"),
    ]
    study_values = (study.contact.radius, study.contact.load, study.contact.rho)
    computed_at = {
        path: contact_grid(numbers(*values), row.purpose)
        for row, path in zip(filtered, study.paths(PATTERNS.filtered, filtered), strict=True)
    }
    for pattern, rows in (
        (PATTERNS.pull_off, study.substrate_scans),
        (PATTERNS.pool, study.chunks),
    ):
        computed_at |= dict.fromkeys(study.paths(pattern, rows), study_values)
    for pattern in (PATTERNS.elastic, PATTERNS.asperities):
        computed_at |= dict.fromkeys(study.paths(pattern, study.pairs_in_turn), study_values[:2])
    return computed_at


@pytest.mark.parametrize("key", SWEPT)
def test_two_values_of_a_swept_key_have_different_files(key):
    study_files, swept_files = lists_of_files(), lists_of_files(key, SWEPT[key])
    assert study_files != swept_files
    for path in study_files.keys() & swept_files.keys():
        assert study_files[path] == swept_files[path], path


def test_paths_do_not_depend_on_the_units_of_a_value():
    written_otherwise = [
        *("sphere.radius", "0.25 mm", "contact.preload", "0.01 mN"),
        *("contact.hardness", "25000 MPa", "scales.range", "0.0056 um"),
    ]
    assert lists_of_files(*written_otherwise) == lists_of_files()
    assert study_contact(numbers()).load == "H25GPa-F10uN"
