"""Studies with contradictory keys, tables and scans are refused in one line."""

from collections import namedtuple
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from refusals import assert_says, refusal
from repository import ROOT
from scan_files import random_heights, write_scan
from studies import FILES_DIGEST, ROWS, check_configuration, paper_configuration, table_of_own_scans

from hardcontact.base.dataset import write_dataset
from hardcontact.config.configuration import reading_arguments
from hardcontact.contact.bearing_area import all_contact_pixels
from hardcontact.contact.contact import Contact
from hardcontact.contact.geometry import join_bodies
from hardcontact.files.paths import MEASUREMENT
from hardcontact.records import origin
from hardcontact.records.origin import Origin, canonical_json, file_digests, keep_records
from hardcontact.run.checks import load_or_read_scan, surface_extent
from hardcontact.surfaces.height_map import HeightMap
from hardcontact.surfaces.spectrum import WAVEVECTORS, Spectrum
from hardcontact.surfaces.substitute_spectra import spectrum_from_description
from hardcontact.surfaces.synthesis import random_surface

#: A key, another value, and parts of the message. Scans have 512 x 512 pixels on 2500 nm.
CONTRADICTIONS = [
    # Names
    ("effort", "quick", "the section quick has no keys", "config/quick.yaml"),
    ("store", "results/paper/store", "results/paper", "found results/paper/store"),
    ("store", "workflow/store", "in results or outside", "found workflow/store"),
    ("sphere.surface", "glass", "ruby", "found glass"),
    ("substitutes.featured_surface", "brass", "found brass"),
    ("scans", [1, 7], "[1, 2, 3, 4, 5]", "found [7]"),
    ("quick", {"study": "mine"}, "neither study nor store", "found study"),
    ("sets.pool_size", 4, "the 5 scans of polished_uncd", "found 4"),
    # Several values
    ("adhesion.ranges", ["1 nm", "0.001 um"], "ascending", "found 0.001 um after 1 nm"),
    # Wavelengths and pixels
    ("substitutes.size", "20 nm", "0.05 to 10000 nm", "found 0.0390625 nm"),
    ("band.short.cutoffs", ["1.2 nm"], "1.221 nm", "found 1.2"),
    ("band.short.cutoffs", ["6 um"], "5000 nm", "found 6000"),
    ("band.short.transition", "9 nm", "found 9 nm"),
    ("band.long.pixels", 512, "4096", "found 512"),
    ("sphere.radius", "2 um", "2500 nm", "found 2000 nm"),
    ("contact.window", "90 um", "16384", "found 18432"),
    # Loads
    ("contact.preload", "1 N", "25 % of", "at most 156 mN", "found 1 N"),
    ("indent.preloads", ["0.1 uN"], "at least 2 contact pixels", "found 1"),
    # Ranges of adhesion
    ("adhesion.ranges", ["0.04 nm", "1 nm"], "at least 0.05 nm on", "25 nm apart", "found 0.04 nm"),
]


#: Values of several keys, and parts of the message, which names one of the keys or another key.
CONTRADICTING_VALUES = [
    ({"quick": {"seed": 1}, "study": "my-quick"}, "config key study", "the end -quick", "my-quick"),
    ({"quick": {"seed": 1}, "store": "results/my-quick"}, "config key store", "the end -quick"),
    ({"substitutes.pixels": 64, "contact.contacts_per_row": 129},
     "contact.contacts_per_row", "128", "found 129"),
    ({"substitutes.pixels": 32, "sphere.radius": "2500 nm"},
     "adhesion.ranges", "at least 4.89 nm on", "two pixels", "found 0.05 nm"),
    ({"contact.window": "10 nm"}, "contact.preload", "4 pixels", "at most 596 nN", "10 µN"),
    ({"contact.contacts_per_row": 200, "contact.preload": "0.5 mN"},
     "contact.preload", "at most 160 µN", "found 500 µN"),
    ({"band.long.tiles": 8}, "sets.long.pixels", "8192", "found 4096"),
    ({"exponents.radii": ["30 nm", "250 um"], "adhesion.range": "1.4 nm"},
     "adhesion.range", "at least 1.59 nm on", "at R = 30 nm", "found 1.4 nm"),
]  # fmt: skip


@pytest.mark.parametrize(
    ("values", "message_parts"),
    [
        *(({key: value}, (key, *parts)) for key, value, *parts in CONTRADICTIONS),
        *((values, parts) for values, *parts in CONTRADICTING_VALUES),
    ],
)
def test_keys_that_contradict_each_other_or_the_table_are_refused(
    tmp_path, project_folder, values, message_parts
):
    message = refusal(lambda: check_configuration(paper_configuration(values), tmp_path))
    assert_says(message, "config key", "expected", "found", *message_parts)


def test_a_study_of_the_paper_needs_two_substrates(tmp_path, project_folder):
    header, *rows = ROWS.splitlines()
    text = "\n".join([header, *(row for row in rows if row.startswith(("uncd", "ruby")))])
    config = paper_configuration({"indent.surface": "uncd", "substitutes.featured_surface": "none"})
    message = refusal(check_configuration, config, tmp_path, text)
    assert_says(message, "config key surfaces", "two substrates", "found uncd")


def test_values_at_their_limits_are_accepted(tmp_path, project_folder):
    values = {
        "elastic.contacts": 401, "asperities.contacts": 401,  # all, if there are fewer
        "exponents.radii": ["50 nm"], "adhesion.range": "1 nm",
    }  # fmt: skip
    check_configuration(paper_configuration(values), tmp_path)


def test_a_substrate_without_a_published_force_is_refused_beside_the_paper(
    tmp_path, project_folder
):
    rows = ROWS.replace("mcd\tMCD", "waves\twaves")
    message = refusal(check_configuration, paper_configuration(), tmp_path, rows)
    assert_says(message, "config key surfaces", "published: none", "found waves")


# Measured scans


@pytest.mark.parametrize(
    ("pixels", "size", "message_part"),
    [(256, 2500.0, "found 256 of 9.766 nm"), (512, 5000.0, "found 512 of 9.766 nm")],
)
def test_scans_of_one_surface_need_equal_pixels(
    tmp_path, project_folder, pixels, size, message_part
):
    first_scan = write_scan(tmp_path / "a.nc", random_heights(512, 512), (2500.0, 2500.0))
    second_scan = write_scan(tmp_path / "b.nc", random_heights(pixels, pixels), (size, size))
    table = table_of_own_scans(first_scan, second_scan)
    message = refusal(check_configuration, paper_configuration(), tmp_path, table)
    assert_says(message, "b.nc", "512 pixels of 4.883 nm", message_part)


def test_unusable_scans_are_refused(tmp_path, project_folder):
    undefined = np.ma.masked_array(random_heights(), False)
    undefined[:7, 0] = np.ma.masked
    for values, *message_parts in (
        (np.ones((32, 32)), "rough", "constant height"),
        (undefined, "found 7", "scan.undefined_pixels"),
    ):
        text = table_of_own_scans(write_scan(tmp_path / "a.nc", values))
        message = refusal(check_configuration, paper_configuration(), tmp_path, text)
        assert_says(message, "a.nc", *message_parts)


def test_masters_under_a_rough_sphere_have_its_pixels(tmp_path, project_folder):
    """Long-edge masters, 20 µm wide, then have pixels of 400 nm / 512: 25600 per row."""
    ball = write_scan(tmp_path / "ball.nc", random_heights(512, 512), (400.0, 400.0))
    rows = ROWS.partition("ruby\t")[0] + f"ruby\truby\t1\tmeasured\t{ball}\t\n"
    check_configuration(paper_configuration(), tmp_path, rows)
    rough = paper_configuration({"band.sphere_roughness": True})
    message = refusal(check_configuration, rough, tmp_path, rows)
    assert_says(message, "found 25600")
    for surface in ("polished_uncd", "uncd", "ncd", "mcd"):
        assert_says(message, f"16384 pixels per row of the long-edge masters of {surface} and")


def test_each_surface_has_one_line_for_a_load_that_it_cannot_carry(tmp_path, project_folder):
    """At 5 kPa the preload needs more pixels than windows and masters have."""
    soft = paper_configuration({"contact.hardness": "5 kPa"})
    message = refusal(check_configuration, soft, tmp_path, ROWS)
    lines = [line for line in message.splitlines() if "contact.preload: " in line]
    assert_says(message, "at a hardness of 5 kPa")
    for surface in ("polished_uncd", "uncd", "ncd", "mcd"):
        assert sum(f"of {surface} " in line for line in lines) == 1


# Scans that the study has stored


Row = namedtuple("Row", "surface scan path dataset")


def store(row, arguments, heights):
    """Store heights as the scan of a row, as if the rule read_scan had read its file so."""
    path = Path(
        "results/store/measurements/0123abcd",
        MEASUREMENT.format(**row._asdict(), digest=FILES_DIGEST),
    )
    path.parent.mkdir(parents=True)
    write_dataset(HeightMap(heights, 10.0).to_dataset(), path)
    keep_records([path], Origin(canonical_json(arguments), file_digests([row.path]), []))
    return path


@pytest.mark.parametrize("change", ["none", "file", "keys", "stored file", "source", "versions"])
def test_a_stored_file_is_read_again_if_anything_has_changed(tmp_path, monkeypatch, change):
    monkeypatch.chdir(tmp_path)
    paths = {name: str(write_scan(tmp_path / f"{name}.nc")) for name in "ab"}
    row = Row("glass", 1, paths["a"], "")
    config = paper_configuration()
    stored_path = store(row, reading_arguments(config) | {"dataset": ""}, np.zeros((16, 16)))
    if change == "file":
        write_scan(tmp_path / "a.nc", 2 * random_heights())
    elif change == "keys":
        config["scan"]["undefined_pixels"] = "harmonic"
    elif change == "stored file":
        write_dataset(HeightMap(np.ones((16, 16)), 10.0).to_dataset(), stored_path)
    elif change == "source":
        row = row._replace(path=paths["b"])
    elif change == "versions":
        monkeypatch.setattr(origin, "versions", lambda: {"SurfaceTopography": "0.1"})
    is_stored = not load_or_read_scan(config, row).heights.any()
    assert is_stored == (change == "none")


def test_a_missing_file_is_refused_though_it_was_stored(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    path = write_scan(tmp_path / "a.nc")
    row = Row("glass", 1, str(path), "")
    store(row, reading_arguments(paper_configuration()) | {"dataset": ""}, np.zeros((16, 16)))
    path.unlink()
    message = refusal(load_or_read_scan, paper_configuration(), row)
    assert_says(message, "a.nc: expected a scan, found no such file")


# How far contacts on substitutes can lie apart in height

CONFIG = {"substitutes": {"pixels": 512, "size": 5000.0}, "band": {"long": {"tiles": 2}}}


def substitute_row(name):
    path = ROOT / f"resources/spectra/{name}.csv"
    return pd.DataFrame({"source": ["substitute"], "path": [str(path)]})


@pytest.mark.parametrize("name", ["crn_rougher", "crn_smoother_upper"])
def test_contacts_on_a_described_surface_lie_within_its_relief(name):
    table = substitute_row(name)
    relief = surface_extent(CONFIG, name, table).relief
    density = Spectrum(WAVEVECTORS, spectrum_from_description(table.path[0], None, None)[0])
    contact = Contact(radius=250e3, preload=1e-5, hardness=25e9, window=12.5e3, contacts_per_row=8)
    for seed in range(2):
        surface = random_surface(np.random.default_rng(seed), 256, 20e3 / 256, density)
        lowest = all_contact_pixels(join_bodies(surface, None, contact), 1).reference_gaps
        height_difference = float(surface.heights.max() + lowest.max())
        assert 0.2 * relief < height_difference < relief  # The bound is not much too large.
