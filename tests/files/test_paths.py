"""Each surface of a study has its spectrum, its scans, and the scans of its realizations."""

import pytest
from studies import study_files

from hardcontact.config.selected_surfaces import Selection

pytestmark = pytest.mark.usefixtures("project_folder")


def test_only_scans_of_the_sphere_have_its_shape():
    plan = study_files(scans=[1], measured_surfaces=["ruby", "uncd"]).plan
    assert plan.sphere_radius("ruby") == 250e3 and plan.sphere_radius("uncd") is None


@pytest.mark.parametrize(
    ("surface", "function", "scans"),
    [
        ("uncd", Selection.master_scan_in_turn, [2, 5, 2]),  # in turn; below, a scan for each
        ("uncd", Selection.separate_master_scan, [2, 5, 6, 7, 8]),
        ("mcd", Selection.separate_master_scan, [2, 5, 2]),
    ],
)
def test_a_master_takes_its_scan(surface, function, scans):
    selection = study_files(scans=[2, 5], measured_surfaces=["mcd"]).selection
    for master_number, scan in enumerate(scans, start=1):
        assert function(selection, surface, master_number) == scan


def test_masters_of_the_paper_have_a_scan_each_and_others_take_turns():
    plan = study_files(scans=[2, 5]).plan
    assert [plan.master_scan("uncd", number) for number in (1, 2, 3, 4)] == [2, 5, 6, 7]
    plan.study = plan.study | {"published": "none"}
    assert [plan.master_scan("uncd", number) for number in (1, 2, 3, 4)] == [2, 5, 2, 5]
