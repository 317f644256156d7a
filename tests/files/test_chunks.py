"""Jobs compute their files in chunks, and different files for different swept values."""

import pytest
from studies import PATTERNS, paper_configuration, study_files

from hardcontact.config.configuration import study_contact
from hardcontact.files.chunks import Chunks
from hardcontact.files.master_purposes import contact_sweep

pytestmark = pytest.mark.usefixtures("project_folder")


# Swept values

SWEPT = {
    "sphere.radius": "300 um",
    "contact.preload": "12 uN",
    "contact.hardness": "30 GPa",
    "adhesion.range": "3 nm",
    "exponents.radii": ["5 um", "7 um"],
}


def lists_of_files(*values):
    """Return the radii, loadings and ranges that each file is computed at, by its path."""
    study = study_files(*values)
    chunks = Chunks(study)
    filtered = [
        *chunks.filtered_masters("scales"),
        *chunks.filtered_masters("exponents"),
        *chunks.filtered_masters("sets"),
        *chunks.filtered_masters("edge_shifts"),
    ]
    contact = study.plan.contact
    study_values = (contact.radius, contact.loading_name, contact.rho)
    computed_at = {
        path: contact_sweep(paper_configuration(*values), row.purpose)
        for row, path in zip(
            filtered, study.paths(PATTERNS.filtered_master_forces, filtered), strict=True
        )
    }
    for pattern, rows in (
        (PATTERNS.pull_off, study.plan.substrate_scan_ids),
        (PATTERNS.pool_forces, chunks.pools),
    ):
        computed_at |= dict.fromkeys(study.paths(pattern, rows), study_values)
    for pattern in (PATTERNS.elastic_contacts, PATTERNS.asperities):
        paths = [study.path(pattern, surface) for surface in study.selection.substrates]
        computed_at |= dict.fromkeys(paths, study_values[:2])
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
        *("contact.hardness", "25000 MPa", "adhesion.range", "0.0056 um"),
    ]
    assert lists_of_files(*written_otherwise) == lists_of_files()
    assert study_contact(paper_configuration()).loading_name == "H25GPa-F10uN"
