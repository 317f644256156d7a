"""The inventory of files has the roughness of their scans, and names unusable files."""

from dataclasses import replace

import numpy as np
import pytest
from refusals import assert_says
from scan_files import write_scan

from hardcontact.commands.inventory import read_inventory
from hardcontact.commands.new import surface_rows
from hardcontact.commands.request import ScanFile, file_faults, list_scan_files, new_arguments
from hardcontact.scans import reading
from hardcontact.scans.reading import ReadingOptions


def scan_file(path, **others):
    """Return a file of the surface a."""
    return ScanFile("a", "A", str(path), path.name, **others)


def only_scan(path, tip_radius=None, **others):
    """Return the only scan of a file."""
    ((scan,), unreadable, problems) = read_inventory(
        [scan_file(path, **others)], ReadingOptions(tip_radius)
    )
    assert not unreadable and not problems
    return scan


def wave(slope=0.05):
    """Heights (x, y) in nm of eight waves along x on a plane of 640 nm that is tilted along y."""
    x = (np.arange(64) + 0.5) / 64
    return 2 * np.cos(16 * np.pi * x)[:, None] + slope * 640 * x


def test_roughness_excludes_tilt_and_the_shape_of_the_sphere(tmp_path):
    scan = only_scan(write_scan(tmp_path / "wave.nc", wave(), (640.0, 640.0)))
    assert scan.rms_height == pytest.approx(np.sqrt(2), rel=1e-3)  # of a cosine of 2 nm
    assert scan.peak_to_valley == pytest.approx(4 * np.cos(np.pi / 8), rel=1e-3)  # beside crests
    assert scan.relief > 30  # with the tilt of 32 nm
    x = (np.arange(64) - 31.5) * 10.0
    ball = -(x[:, None] ** 2 + x**2) / 2000 + wave(slope=0)
    scan = only_scan(write_scan(tmp_path / "ball.nc", ball, (640.0, 640.0)), sphere_radius=1000.0)
    assert scan.rms_height == pytest.approx(np.sqrt(2), rel=1e-3)


def test_a_folder_stands_for_its_files_of_which_unreadable_ones_are_left_out(tmp_path):
    write_scan(tmp_path / "b.nc", wave(), (640.0, 640.0))
    (tmp_path / "a.txt").write_text("notes")
    (tmp_path / ".hidden").write_text("no scan")
    arguments = new_arguments(["new", "name", str(tmp_path)])
    scan_files = list_scan_files(arguments, radius=1e5)
    ((scan,), (line,), problems) = read_inventory(scan_files, ReadingOptions())
    assert scan.name == "b.nc" and not [*file_faults(arguments)] and not problems
    assert_says(line, "a.txt: expected")
    (tmp_path / "b.nc").unlink()
    scan_files = list_scan_files(arguments, radius=1e5)
    _, _, problems = read_inventory(scan_files, ReadingOptions())
    assert_says(problems[0], "a.txt: expected")


def test_all_faulty_scans_and_duplicates_are_reported_at_once(tmp_path):
    (tmp_path / "text.txt").write_text("no scan")
    paths = [
        tmp_path / "none.di",
        write_scan(tmp_path / "flat.nc", np.zeros((32, 32))),
        tmp_path / "text.txt",
        write_scan(tmp_path / "first.nc", wave(), (640.0, 640.0)),
        # In another unit, with the rounding of another format.
        write_scan(tmp_path / "again.nc", np.float32(wave() / 1e3), (0.64, 0.64), "um"),
        write_scan(tmp_path / "other.nc", 1.01 * wave(), (640.0, 640.0)),
    ]
    _, _, problems = read_inventory([scan_file(path) for path in paths], ReadingOptions())
    missing_fault, flat_fault, text_fault, copy_fault = problems
    assert_says(missing_fault, "none.di", "no such file")
    assert_says(flat_fault, "flat.nc", "expected a rough surface", "constant height")
    assert_says(text_fault, "text.txt", "expected")
    assert_says(copy_fault, "again.nc", "expected each scan once", "first.nc")


def test_an_area_counts_once(tmp_path):
    rng = np.random.default_rng(1)
    trace = rng.standard_normal((64, 64))
    retrace = np.roll(trace, 2, axis=0) + 0.1 * rng.standard_normal((64, 64))
    maps = {"trace": trace, "other": rng.standard_normal((64, 64)), "retrace": retrace}
    paths = [write_scan(tmp_path / f"{name}.nc", heights) for name, heights in maps.items()]
    scans, left_out, problems = read_inventory(
        [scan_file(path) for path in paths], ReadingOptions()
    )
    assert [scan.name for scan in scans] == ["trace.nc", "other.nc"] and not problems
    assert left_out == ["retrace.nc: it shows the same area as trace.nc, and an area counts once"]


@pytest.mark.parametrize(
    ("stated_radius", "used_radius", "table_radius"), [(None, 12.0, "12 nm"), (30.0, 30.0, "")]
)
def test_the_tip_option_serves_only_files_that_state_no_tip_radius(
    tmp_path, monkeypatch, stated_radius, used_radius, table_radius
):
    path = write_scan(tmp_path / "wave.nc", wave(), (640.0, 640.0))
    read_original = reading.read_scan
    monkeypatch.setattr(
        reading,
        "read_scan",
        lambda *arguments: replace(read_original(*arguments), tip_radius=stated_radius),
    )
    scan = only_scan(path, 12.0)
    assert scan.tip_radius == used_radius
    assert surface_rows([scan], [scan], "12 nm")[0]["tip_radius"] == table_radius
