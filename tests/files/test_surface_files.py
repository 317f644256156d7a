"""Each surface of a study has its spectrum, its scans, and the scans of its realizations."""

import numpy as np
import pytest
import scan_files
from paper_numbers import SUBSTRATES, SURFACES
from studies import files

from hardcontact.files.surface_files import SurfaceFiles
from hardcontact.scans.reading import read_scan
from hardcontact.surfaces.height_map import remove_form

pytestmark = pytest.mark.usefixtures("project_folder")


def test_each_scan_is_paired_with_one_scan_of_the_sphere():
    pairs = files(scans=[1, 2]).pairs_in_turn
    assert [(pair.scan, pair.sphere_scan) for pair in pairs] == [(1, 1), (2, 2)] * len(SUBSTRATES)


def test_measured_surfaces_have_measurements_and_their_spectrum():
    study = files(measured_surfaces=["mcd"])
    assert len(study.measurement_paths("mcd")) == 2 and study.measurement_paths("uncd") == []
    assert study.spectrum_path("mcd").endswith("mcd/0123abcd/measured-flat.nc")
    assert study.spectrum_path("uncd").endswith("uncd/0123abcd/calibrated.nc")


def test_the_shape_of_a_rough_sphere_is_subtracted(tmp_path):
    x = (np.arange(64) - 31.5) * 10.0
    ball = -(x[:, None] ** 2 + x**2) / (2 * 250e3)
    rough = np.random.default_rng(1).standard_normal((64, 64))
    path = scan_files.scan(tmp_path / "ball.nc", ball + rough, (640.0, 640.0))
    levelling = files(scans=[1], measured_surfaces=["ruby"]).levelling_settings("ruby")
    levelled = remove_form(read_scan(path), **levelling)
    assert levelled.heights.std() == pytest.approx(rough.std(), rel=0.01)
    assert files(measured_surfaces=["uncd"]).levelling_settings("uncd")["sphere_radius"] is None


@pytest.mark.parametrize(
    ("surface", "function", "scans"),
    [
        (
            "uncd",
            SurfaceFiles.realization_scan_path,
            [2, 5, 2],
        ),  # in turn; below, a scan for each
        ("uncd", SurfaceFiles.separate_scan_path, [2, 5, 6, 7, 8]),
        ("mcd", SurfaceFiles.separate_scan_path, [2, 5, 2]),
    ],
)
def test_a_realization_uses_its_scan(surface, function, scans):
    study = files(scans=[2, 5], measured_surfaces=["mcd"])
    for realization, scan in enumerate(scans, start=1):
        assert function(study, surface, realization) == study.stitched_path(surface, scan)


def test_scans_are_made_in_groups_that_share_their_conditioning():
    study = files("sets.realizations", 5, measured_surfaces=["mcd"], scans=[1, 3])
    substitutes = [surface for surface in SURFACES if surface != "mcd"]
    assert study.scan_groups == {(1, 3): substitutes, (4, 5): substitutes, (6, 7): substitutes}
    for group in study.scan_groups:
        for scan in group:
            assert study.conditioning_path("uncd", scan).endswith(
                f"uncd/0123abcd/scan-{group[0]}-flat.nc"
            )
