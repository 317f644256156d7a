"""Tables of surfaces: faulty ones are refused in one line; digests change with the files."""

import numpy as np
import pytest
from refusals import assert_says, refusal
from repository import ROWS
from scan_files import write_scan
from studies import read_surfaces, table_of_own_scans

from hardcontact.config.selected_surfaces import digest_surfaces, surface_table

FIRST_ROW = ROWS.splitlines()[1]
HEADER = ROWS.partition("\n")[0]


@pytest.mark.parametrize(
    ("text", "message_parts"),
    [
        (ROWS + FIRST_ROW + "\n", ["line 27", "once", "polished_uncd 1"]),
        (ROWS.replace("spectra/uncd", "spectra/no"), ["line 7", "spectra/no.csv", "no such file"]),
        (ROWS.replace("spectra/uncd", "spectra/mcd", 1), ["surface uncd", "one path", "mcd.csv"]),
        (ROWS.replace("2\tsubstitute", "2\tmeasured", 1), ["polished_uncd", "one source"]),
        (ROWS.replace("UNCD\t2", "U\t2", 1), ["polished_uncd", "one label", "polished U"]),
        (ROWS.replace("UNCD\t1", "UNCD\tone", 1), ["line 2", "scan", "found 'one'"]),
        (ROWS.replace("substitute", "guess", 1), ["line 2", "source", "found 'guess'"]),
        (ROWS + "\t".join("abcdefgh") + "\n", ["line 27", "expected 6 cells", "found 8"]),
        (ROWS.replace("label", "name", 1), ["the columns", "label", "found surface, name"]),
        (ROWS.replace("\t", ","), ["separated by tabs", "found surface,label"]),
        (HEADER, ["a row per scan", "0 rows"]),
        ("", ["expected a table of surfaces"]),
        (b"\xff\xfe\x00garbage", ["expected a table of surfaces"]),
    ],
)
def test_a_faulty_table_is_refused(tmp_path, project_folder, text, message_parts):
    assert_says(refusal(read_surfaces, text, tmp_path), "surfaces.tsv", "expected", *message_parts)


@pytest.mark.parametrize("path", ["none.tsv", "config", "/dev/zero"])
def test_a_path_without_a_table_is_refused(project_folder, path):
    message = refusal(surface_table, path)
    assert_says(message, path, "config key surfaces: expected a table of surfaces", "found")


def test_a_file_listed_twice_is_refused(tmp_path, project_folder):
    path = write_scan(tmp_path / "a.nc")
    message = refusal(read_surfaces, table_of_own_scans(path, path), tmp_path)
    assert_says(message, "surfaces.tsv", "path and dataset once", "a.nc")


def test_another_scan_of_the_same_name_has_another_folder_in_the_store(tmp_path, project_folder):
    """Paths of intermediates have the digest of the rows and files of their surface."""
    digests = []
    for pixels in (16, 17):
        path = write_scan(tmp_path / "a.nc", np.zeros((pixels, pixels)))
        digests.append(digest_surfaces(read_surfaces(table_of_own_scans(path), tmp_path)))
    first, second = digests
    assert {surface for surface in first if first[surface] != second[surface]} == {"uncd"}
