"""Paths of forces name the values that people vary, in units of their own."""

import pytest
from studies import paper_configuration, study_files

from hardcontact.config.configuration import study_contact
from hardcontact.files.chunks import Chunks

pytestmark = pytest.mark.usefixtures("project_folder")

#: Another value of a key, and how paths name it.
SWEPT = {
    "sphere.radius": ("300 um", "R300um"),
    "contact.preload": ("12 uN", "F12uN"),
    "contact.hardness": ("30 GPa", "H30GPa"),
    "adhesion.range": ("3 nm", "rho3nm"),
}


def force_paths(values=None):
    """Return the paths of forces on scans, pools, whole surfaces and masters."""
    files = study_files(values)
    chunks = Chunks(files)
    patterns = files.patterns
    return [
        *files.paths(patterns.pull_off, files.plan.substrate_scan_ids),
        *files.paths(patterns.pool, chunks.pools),
        *files.paths(patterns.whole_surfaces, chunks.whole_surfaces),
        *files.paths(patterns.master_forces, chunks.master_forces("band")),
        *files.paths(patterns.master_forces, chunks.master_forces("edge_shifts")),
    ]


@pytest.mark.parametrize("key", SWEPT)
def test_paths_of_forces_name_swept_values(key):
    value, name = SWEPT[key]
    assert all(name in path for path in force_paths({key: value}))
    assert not any(name in path for path in force_paths())


def test_paths_do_not_depend_on_the_units_of_a_value():
    written_otherwise = {
        "sphere.radius": "0.25 mm", "contact.preload": "0.01 mN",
        "contact.hardness": "25000 MPa", "adhesion.range": "0.0056 um",
    }  # fmt: skip
    assert force_paths(written_otherwise) == force_paths()
    assert study_contact(paper_configuration()).loading_name == "H25GPa-F10uN"
