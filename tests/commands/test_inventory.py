"""What files hold: heights, sizes and reliable wavelengths of scans whose truth is known."""

from dataclasses import replace

import numpy as np
import pytest
from refusals import assert_says
from scan_files import container, scan

from hardcontact.commands import inventory as module
from hardcontact.commands.inventory import inventory, printed_table
from hardcontact.commands.request import Source


def source(path, **others):
    """A file of the surface `a`."""
    return Source("a", "A", str(path), path.name, **others)


def wave(pixels=64, size=640.0, height=2.0, slope=0.05):
    """Heights (x, y) in nm of eight waves along x on a tilted plane."""
    x = (np.arange(pixels) + 0.5) / pixels
    return height * np.cos(16 * np.pi * x)[:, None] + slope * size * np.ones((pixels, 1)) * x


def test_a_map(tmp_path):
    path = scan(tmp_path / "wave.nc", wave(), (640.0, 640.0))
    ((entry,), unreadable, problems) = inventory([source(path)], None)
    assert not unreadable and not problems
    assert (entry.kind, entry.pixels, entry.file_unit) == ("map", 64, "nm")
    assert entry.size == pytest.approx(640)
    assert entry.rms_height == pytest.approx(np.sqrt(2), rel=1e-3)  # of a cosine of 2 nm
    assert entry.peak_to_valley == pytest.approx(4 * np.cos(np.pi / 8), rel=1e-3)
    assert entry.relief > 30  # with the tilt, as the study sees it
    assert entry.tip_radius is None


def test_a_tip_radius_that_is_given_cuts_short_wavelengths(tmp_path):
    rough = np.random.default_rng(1).standard_normal((64, 64)).cumsum(0).cumsum(1) / 8
    path = scan(tmp_path / "rough.nc", rough, (640.0, 640.0))
    bands = [inventory([source(path)], tip).entries[0].band for tip in (None, 100.0)]
    assert bands[1].shortest >= bands[0].shortest
    assert inventory([source(path)], 100.0).entries[0].tip_radius == 100


def test_the_shape_of_the_sphere_is_no_roughness(tmp_path):
    x = (np.arange(64) - 31.5) * 10.0
    ball = -(x[:, None] ** 2 + x**2) / 2000 + wave(slope=0)
    path = scan(tmp_path / "ball.nc", ball, (640.0, 640.0))
    heights = [
        inventory([source(path, sphere_radius=radius)], None).entries[0].rms_height
        for radius in (None, 1000.0)
    ]
    assert heights[1] == pytest.approx(np.sqrt(2), rel=1e-3)
    assert heights[0] > 10 * heights[1]


def test_a_member_of_a_container_that_cannot_be_read_stops_nothing(tmp_path):
    good = scan(tmp_path / "good.nc")
    (tmp_path / "bad.txt").write_text("nothing")
    entries = [
        {"name": name, "datafile": {"original": name}, "unit": "nm", "size": [320.0, 320.0]}
        for name in ("good.nc", "bad.txt")
    ]
    files = {"good.nc": good, "bad.txt": tmp_path / "bad.txt"}
    twin = container(tmp_path / "twin.zip", entries, files)
    found = inventory([source(twin)], None)
    assert [entry.dataset for entry in found.entries] == ["good.nc"]
    assert not found.problems
    (line,) = found.unreadable
    assert_says(line, "twin.zip: bad.txt: expected")
    # Alone, it is a problem.
    twin = container(tmp_path / "bad.zip", entries[1:], files)
    found = inventory([source(twin)], None)
    assert not found.entries and not found.unreadable and len(found.problems) == 1


def test_all_problems_at_once(tmp_path):
    flat = scan(tmp_path / "flat.nc", np.zeros((32, 32)))
    (tmp_path / "text.txt").write_text("no scan")
    paths = [tmp_path / "none.di", flat, tmp_path / "text.txt"]
    problems = inventory([source(path) for path in paths], None).problems
    assert len(problems) == 3
    assert_says(problems[0], "none.di", "no such file")
    assert_says(problems[1], "flat.nc", "expected a rough surface", "constant height")
    assert_says(problems[2], "text.txt", "expected")


def test_a_scan_that_is_given_twice_is_a_problem(tmp_path):
    first = scan(tmp_path / "first.nc", wave(), (640.0, 640.0))
    # In another unit, with the rounding of another format.
    again = scan(tmp_path / "again.nc", np.float32(wave() / 1e3), (0.64, 0.64), "um")
    other = scan(tmp_path / "other.nc", 1.01 * wave(), (640.0, 640.0))
    found = inventory([source(path) for path in (first, again, other)], None)
    (line,) = found.problems
    assert_says(line, "again.nc", "expected each scan once", "first.nc")


def test_the_table_says_what_was_found(tmp_path):
    heights = np.ma.masked_array(wave(), np.zeros((64, 64), bool))
    heights.mask[3, 4] = True
    paths = [
        scan(tmp_path / "wave.nc", wave() / 1e3, (0.64, 0.64), "um"),
        scan(tmp_path / "gap.nc", heights, (640.0, 640.0)),
    ]
    found = inventory([source(path) for path in paths], 12.0)
    assert [entry.undefined for entry in found.entries] == [0, 1]
    head, first, second, *notes = printed_table(found.entries, ["contact", "spectrum"]).splitlines()
    assert_says(head, "file", "channel", "kind", "peak to valley", "tip radius", "used for")
    assert_says(second, "A", "gap.nc", "height map", "640 nm", "64 x 64", "1.41 nm", "12 nm")
    assert first.endswith("contact") and second.endswith("spectrum")
    assert "2: 1 undefined pixels of 4096 filled" in notes


def test_what_a_file_states_of_its_tip_counts_before_what_is_given(tmp_path, monkeypatch):
    path = scan(tmp_path / "wave.nc", wave(), (640.0, 640.0))
    read = module.read_measurement
    monkeypatch.setattr(
        module, "read_measurement", lambda *choices: replace(read(*choices), tip_radius=30.0)
    )
    ((stated,), _, _) = inventory([source(path)], 12.0)
    assert (stated.tip_radius, stated.tip_given) == (30.0, False)
    monkeypatch.undo()
    ((given,), _, _) = inventory([source(path)], 12.0)
    assert (given.tip_radius, given.tip_given) == (12.0, True)
    ((unknown,), _, _) = inventory([source(path)], None)
    assert (unknown.tip_radius, unknown.tip_given) == (None, False)
