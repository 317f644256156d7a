"""Each surface of a study has its spectrum, its scans, and the scans of its realizations."""

import numpy as np
import pytest
import scan_files
from studies import study_files

from hardcontact.config.selected_surfaces import Selection
from hardcontact.scans.reading import read_scan
from hardcontact.surfaces.levelling import remove_form

pytestmark = pytest.mark.usefixtures("project_folder")


def test_the_shape_of_a_rough_sphere_is_subtracted(tmp_path):
    x = (np.arange(64) - 31.5) * 10.0
    ball = -(x[:, None] ** 2 + x**2) / (2 * 250e3)
    rough = np.random.default_rng(1).standard_normal((64, 64))
    path = scan_files.write_scan(tmp_path / "ball.nc", ball + rough, (640.0, 640.0))
    plan = study_files(scans=[1], measured_surfaces=["ruby", "uncd"]).plan
    levelled = remove_form(read_scan(path), plan.sphere_radius("ruby"), "plane")
    assert levelled.heights.std() == pytest.approx(rough.std(), rel=1e-3)
    assert plan.sphere_radius("uncd") is None


@pytest.mark.parametrize(
    ("surface", "function", "scans"),
    [
        ("uncd", Selection.master_scan, [2, 5, 2]),  # in turn; below, a scan for each
        ("uncd", Selection.separate_master_scan, [2, 5, 6, 7, 8]),
        ("mcd", Selection.separate_master_scan, [2, 5, 2]),
    ],
)
def test_a_master_takes_its_scan(surface, function, scans):
    selection = study_files(scans=[2, 5], measured_surfaces=["mcd"]).selection
    for master_number, scan in enumerate(scans, start=1):
        assert function(selection, surface, master_number) == scan
