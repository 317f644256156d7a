"""The lists of files: as long as what they are made of, and parallel to their keys."""

from itertools import product

import numpy as np
import pytest
import scan_files
from paper_numbers import SUBSTRATES, SURFACES
from small_study import PATTERNS, files, selection

from hardcontact.surfaces.scans import flattened, read_measurement

pytestmark = pytest.mark.usefixtures("at_root")


def test_scans_of_the_sphere_are_taken_in_turn():
    pairs = files(scans=[1, 2]).pairs_in_turn
    assert [(pair.scan, pair.sphere_scan) for pair in pairs] == [(1, 1), (2, 2)] * len(SUBSTRATES)
    assert files(scans=[1, 2]).paths(PATTERNS.elastic, pairs)[1] == (
        "results/store/elastic/R250um/H25GPa-F10uN/polished_uncd/study/scan-2/sphere-scan-2.nc"
    )


def test_swept_values_stand_in_paths():
    study = files(
        sphere__radius="0.3 mm",
        contact__preload="12000 nN",
        contact__hardness="0.03 TPa",
        scales__range="0.5 nm",
    )
    forces = study.paths(PATTERNS.pull_off, study.substrate_scans)
    forces += study.paths(PATTERNS.filtered, study.masters())
    assert all("/R300um/H30GPa-F12uN/rho0.5nm/" in path for path in forces)
    assert study.stitched("ruby", 1).endswith("ruby/study/scan-1-sphere-R300um.nc")
    assert study.stitched("uncd", 1).endswith("uncd/study/scan-1-flat.nc")


def test_measured_scans_are_read_once():
    study = files(measured=["mcd"])
    assert study.measurements("mcd") == [
        f"results/store/measurements/mcd/scan-{number}.nc" for number in (1, 2)
    ]
    assert study.measurements("uncd") == []
    assert study.spectrum("mcd") == "results/store/spectra/mcd/study/measured-flat.nc"
    assert study.spectrum("uncd") == "results/store/spectra/uncd/study/calibrated.nc"


def test_a_rough_sphere_is_measured_less_its_shape(tmp_path):
    x = (np.arange(64) - 31.5) * 10.0
    ball = -(x[:, None] ** 2 + x**2) / (2 * 250e3)
    rough = np.random.default_rng(1).standard_normal((64, 64))
    path = scan_files.scan(tmp_path / "ball.nc", ball + rough, (640.0, 640.0))
    levelling = files(scans=[1], measured=["ruby"]).levelling("ruby")
    measured = flattened(read_measurement(path), **levelling)
    assert levelling["sphere_radius"] == 250e3
    assert measured.heights.std() == pytest.approx(rough.std(), rel=0.01)
    assert files(measured=["uncd"]).levelling("uncd")["sphere_radius"] is None


def test_realizations_begin_again_when_the_scans_are_used_up():
    study = files(scans=[2, 5])
    numbers = [
        study.stitched_of_realization("uncd", realization, "study").split("/")[-1]
        for realization in (1, 2, 3)
    ]
    assert numbers == ["scan-2-flat.nc", "scan-5-flat.nc", "scan-2-flat.nc"]


def test_every_realization_of_the_sets_has_a_scan_of_its_own():
    study = files(scans=[2, 5], measured=["mcd"])

    def number(surface, realization):
        path = study.stitched_of_set_realization(surface, realization, "study")
        return int(path.split("scan-")[1].split("-")[0])

    assert [number("uncd", realization) for realization in (1, 2, 3, 4, 5)] == [2, 5, 6, 7, 8]
    assert [number("mcd", realization) for realization in (1, 2, 3)] == [2, 5, 2]


def test_scans_are_conditioned_in_groups_as_large_as_the_study():
    study, chosen = files(scans=[2, 5]), selection(scans=[2, 5])
    assert [chosen.scans_of_group("uncd", group) for group in (0, 1, 2)] == [[2, 5], [6, 7], [8, 9]]
    for group in (0, 1, 2):
        path = f"results/store/conditioning/uncd/study/group-{group}.nc"
        for scan in chosen.scans_of_group("uncd", group):
            assert study.conditioning("uncd", scan) == path


def test_every_realization_is_filtered():
    study = files(scales__realizations=2)
    forces = study.paths(PATTERNS.filtered, study.masters())
    assert len(set(forces)) == 2 * len(SUBSTRATES)
    assert forces[1] == (
        "results/store/filtered/scales/R250um/H25GPa-F10uN/rho5.6nm/polished_uncd/study/"
        "realizations-2-2-smooth-sphere.nc"
    )
    sources = study.master_sources(study.masters()[1])
    assert sources["small_masters"] == [
        "results/store/masters/polished_uncd/study/realization-2/small.nc"
    ]


def test_scans_are_made_in_the_groups_that_are_conditioned_together():
    study = files(measured=["mcd"], scans=[1, 3], sets__realizations=5)
    others = [surface for surface in SURFACES if surface != "mcd"]
    assert study.scan_groups == {(1, 3): others, (4, 5): others, (6, 7): others}


def test_indents_are_made_on_one_surface():
    assert files(scans=[1, 2], indent__surface="mcd").indent_pairs == list(product([1, 2], [1, 2]))


def test_robustness_asks_for_each_variant_of_a_surface_once():
    study = files(
        robustness__heights={"surface": "mcd", "skewness": [-0.5]},
        robustness__tip_radii=["17 nm"],
        robustness__realizations=3,
    )
    made = list(product(SUBSTRATES, ["study"])) + list(product(SUBSTRATES, ["laplacian"]))
    made += [("mcd", "skewness-0.5"), ("uncd", "tip-17nm")]
    assert study.varied_surfaces == made
    files_of = {(row.surface, row.variant, row.probe) for row in study.robustness_masters}
    assert files_of == {(*one, "smooth") for one in made} | {
        (name, "study", "rough") for name in SUBSTRATES
    }
    forces = study.paths(PATTERNS.filtered, study.robustness_masters)
    assert len(set(forces)) == len(forces) == len(files_of)
    assert forces[0].endswith("polished_uncd/study/realizations-1-5-smooth-sphere.nc")


def test_masters_of_the_study_are_shared_by_sets_and_robustness():
    study = files(robustness__realizations=3, sets__realizations=12)
    chunks = [(row.first, row.last) for row in study.set_masters]
    assert chunks == [(1, 5), (6, 10), (11, 12)] * len(SUBSTRATES)
    shared = {
        row for row in study.robustness_masters if (row.variant, row.probe) == ("study", "smooth")
    }
    assert shared == {row for row in study.set_masters if row.first == 1}
    sources = study.master_sources(study.set_masters[0])
    assert len(sources["scans"]) == len(sources["spectra"]) == 5


def test_what_changes_no_spectrum_has_that_of_the_study():
    study = files()
    for variant in ("skewness+0.5", "tip-17nm"):
        assert study.spectrum("uncd", variant) == study.spectrum("uncd")
        assert study.conditioning("uncd", 1, variant) == study.conditioning("uncd", 1)
        assert study.stitched("uncd", 1, variant) != study.stitched("uncd", 1)
    assert study.spectrum("uncd", "laplacian") != study.spectrum("uncd")
    assert study.conditioning("uncd", 1, "laplacian") != study.conditioning("uncd", 1)


def test_the_other_sphere_bears_the_load_of_the_study_alone():
    study = files(robustness__preloads=["5 uN", "10 uN"], robustness__hardnesses=[])
    loads = [
        {"preload": 1e-5, "hardness": 25e9},
        {"preload": 5e-6, "hardness": 25e9},
    ]
    # The study's own preload is not listed again.
    assert study.contact_grid("sets", "smooth")["loads"] == loads
    assert study.contact_grid("sets", "rough")["loads"] == loads[:1]


def test_pools_are_computed_in_chunks_of_substitutes_alone():
    study = files(measured=["mcd"], sets__pool=32)
    assert [one.surface for one in study.chunks[::3]] == SUBSTRATES[:3]
    assert [(one.first, one.last) for one in study.chunks[:3]] == [(1, 15), (16, 30), (31, 32)]
    assert study.paths(PATTERNS.pool, study.chunks)[1] == (
        "results/store/pool/R250um/H25GPa-F10uN/rho5.6nm/polished_uncd/study/scans-16-30.nc"
    )


def test_realizations_of_insight_are_the_first_scans_of_each_substrate():
    study = files([1, 2, 4], insight__realizations=2)
    assert study.realized_scans == list(product(SUBSTRATES, [1, 2]))
    assert len(set(study.paths(PATTERNS.law_scan, study.realized_scans))) == 2 * len(SUBSTRATES)
    assert [row.surface for row in study.masters("scaling")] == SUBSTRATES
    assert study.repeated_pairs == [(1, 1), (2, 2)]


#: Other values of the keys that people sweep.
SWEPT = {
    "sphere__radius": "300 um",
    "contact__preload": "12 uN",
    "contact__hardness": "30 GPa",
    "scales__range": "3 nm",
    "robustness__preloads": ["7 uN"],
    "insight__scaling__radii": ["5 um", "7 um"],
    "insight__scaling__preloads": ["1.25 uN", "7 uN"],
    "insight__scaling__ranges": ["7 nm"],
}


def lists_of_files(study):
    """Return the files of each list with what they are computed at, by the file."""
    filtered = [
        *study.masters(), *study.masters("scaling"), *study.set_masters, *study.robustness_masters,
    ]  # fmt: skip
    at_study = (study.contact.radius, study.contact.load, study.contact.range)
    given = {
        path: study.contact_grid(row.purpose, row.probe)
        for row, path in zip(filtered, study.paths(PATTERNS.filtered, filtered), strict=True)
    }
    means = [*study.varied_forces, *study.smooth_forces]
    for row, path in zip(means, study.paths(PATTERNS.mean_forces, means), strict=True):
        given[path] = study.mean_loads(row.probe), at_study[0], at_study[2]
    for pattern, rows in (
        (PATTERNS.pull_off, study.substrate_scans),
        (PATTERNS.pool, study.chunks),
        (PATTERNS.law_scan, study.realized_scans),
    ):
        given |= dict.fromkeys(study.paths(pattern, rows), at_study)
    for pattern in (PATTERNS.elastic, PATTERNS.asperities):
        given |= dict.fromkeys(study.paths(pattern, study.pairs_in_turn), at_study[:2])
    return given


@pytest.mark.parametrize("key", SWEPT)
def test_files_of_two_values_of_a_swept_key_lie_side_by_side(key):
    first, second = lists_of_files(files()), lists_of_files(files(**{key: SWEPT[key]}))
    assert first != second
    for path in first.keys() & second.keys():
        assert first[path] == second[path], path
