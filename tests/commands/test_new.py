"""The command `hardcontact new` makes a valid study from files."""

import sys
from types import SimpleNamespace

import numpy as np
import pytest
import yaml
from measurements import self_affine_heights
from refusals import assert_says
from repository import PAPER, ROOT
from scan_files import write_container, write_nanoscope, write_scan

from hardcontact.base.arrays import generator
from hardcontact.commands import command_line, new, request
from hardcontact.config.configuration import apply_effort, merge_overlay, numeric_configuration
from hardcontact.config.selected_surfaces import surface_table
from hardcontact.run import checks

NAME = "a-test.of_new"


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """Make a top folder with the project's configuration, where studies are written."""
    for name in ("config", "workflow"):
        (tmp_path / name).mkdir()
    for file in ("config/config.yaml", "config/quick.yaml", "config/surfaces.tsv"):
        (tmp_path / file).write_bytes((ROOT / file).read_bytes())
    for name in ("resources", "workflow/schemas"):
        (tmp_path / name).symlink_to(ROOT / name)
    for module in (new, request):
        monkeypatch.setattr(module, "ROOT", tmp_path)
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def run(monkeypatch, capsys):
    """Run the command; return exit code, output and errors."""

    def run(*arguments):
        monkeypatch.setattr(sys, "argv", ["hardcontact", "new", *map(str, arguments)])
        code = command_line.main()
        output = capsys.readouterr()
        return SimpleNamespace(code=code, out=output.out, errors=output.err.splitlines())

    return run


def rough(pixels=64, rms=3.0, seed=1):
    """Heights (x, y) in nm of a rough surface that rolls off at a third of its size."""
    return self_affine_heights(generator(seed), pixels, 1.0, rms, rolloff=pixels / 3)


def own_scan(path, size=2500.0, **others):
    return write_scan(path, rough(**others), (size, size))


def accepted(folder, done, effort="full"):
    """Check a new study as its run does; return its configuration and table."""
    assert done.code == 0 and not done.errors, done.errors
    overlay = yaml.safe_load((folder / f"config/{NAME}.yaml").read_text("utf-8"))
    quick = overlay.pop("quick")
    config = merge_overlay(PAPER, overlay)
    if effort == "quick":
        config = apply_effort(config | {"effort": "quick", "quick": quick})
    config = numeric_configuration(config)
    table = surface_table(folder / f"config/{NAME}.tsv")
    checks.check_study(config, table)
    return config, table


def test_one_scan_makes_a_full_and_a_quick_study(folder, run):
    own_scan(folder / "one.nc")
    done = run(NAME, "one.nc")
    assert done.out.endswith(f"# a first answer\nsnakemake --configfile config/{NAME}.yaml\n")
    config, table = accepted(folder, done)
    assert config["published"] == "none" and config["sphere"]["surface"] == "smooth"
    assert table.path.tolist() == ["one.nc"] and table.surface.tolist() == ["a_test_of_new"]
    quick, _ = accepted(folder, done, "quick")
    # The quick study replaces nothing of the full one.
    assert quick["study"] != config["study"] and quick["store"] != config["store"]


def test_the_report_has_only_choices_that_the_paper_lacks(folder, run):
    own_scan(folder / "one.nc")
    lines = run(NAME, "one.nc", "--preload", "5uN", "--hardness", "25 GPa").out.splitlines()
    assert any(line.startswith("contact.preload: 5uN (preload: as given") for line in lines)
    assert not any(line.startswith("contact.hardness") for line in lines)
    assert "Not given, so as in the paper: --radius 250um --range 5.6nm --work 46.3mJ/m2" in lines


def test_options_state_what_files_lack_and_are_kept(folder, run):
    write_nanoscope(folder / "a.001", 10 * rough(), (2500.0, 2500.0), ["Height", "Sensor"])
    write_scan(folder / "bare.nc", 1e-3 * rough(seed=2), (2.5, 2.5), unit=None)
    (error,) = run(NAME, "bare.nc", "a.001", "--unit", "um", "--channel", "Sensor").errors
    assert_says(error, "bare.nc: expected one of the channels", "found 'Sensor'")
    _, table = accepted(folder, run(NAME, "a.001", "--channel", "Sensor"))
    assert set(table.dataset) == {"Sensor"}
    config, _ = accepted(
        folder, run(NAME, "bare.nc", "--unit", "um", "--levelling", "quadratic", "--overwrite")
    )
    assert config["scan"]["unit"] == "um" and config["scan"]["levelling"] == "quadratic"


def test_scans_without_contacts_enter_the_spectrum(folder, run):
    own_scan(folder / "large.nc", 10000.0, pixels=256)
    small = own_scan(folder / "small.nc", 500.0)
    dataset = {"name": "s", "datafile": {"original": "s.nc"}, "unit": "nm", "size": [500.0] * 2}
    write_container(folder / "twin.zip", [dataset], {"s.nc": small})
    _, table = accepted(folder, run(NAME, "twin.zip", "large.nc", "--tip", "8 nm"))
    assert table.use.tolist() == ["contact", "spectrum"]
    assert table.dataset.tolist() == ["", "s.nc"] and set(table.tip_radius) == {"8.0"}


def test_several_surfaces_a_sphere_and_forces_make_a_study(folder, run):
    for name in ("bare", "coated", "ball"):
        own_scan(folder / f"{name}.nc", rms=1.0)
    (folder / "my: #1.csv").write_text("surface,value,unit\nsurface_3_nm,0.5,uN\ncoated_ii,3,nN\n")
    done = run(
        NAME, "--forces", "my: #1.csv", "--surface", "3 nm", "bare.nc", "--surface", "Coated (II)",
        "coated.nc", "--radius", "100um", "--sphere", "ball.nc", "--range", "4nm",
        "--work", "50 mJ/m^2",
    )  # fmt: skip
    config, table = accepted(folder, done)
    assert table.surface.tolist() == ["surface_3_nm", "coated_ii", "sphere"]
    assert table.label.tolist() == ["3 nm", "Coated (II)", "sphere"]
    assert "coated_ii for Coated (II)" in done.out
    assert config["sphere"] == {"surface": "sphere", "radius": 1e5}
    assert config["forces"] == "my: #1.csv" and config["adhesion"]["range"] == 4
    assert config["adhesion"]["work"] == 0.05


def test_paths_are_relative_to_the_top_folder(folder, run, monkeypatch, tmp_path_factory):
    (folder / "deep").mkdir()
    elsewhere = own_scan(tmp_path_factory.mktemp("elsewhere") / "there.nc")
    own_scan(folder / "here.nc", seed=2)
    own_scan(folder / "deep/it's (1) ü.nc", seed=3)
    monkeypatch.chdir(folder / "deep")
    done = run(NAME, "it's (1) ü.nc", folder / "here.nc", elsewhere)
    monkeypatch.chdir(folder)
    _, table = accepted(folder, done)
    assert table.path.tolist() == ["deep/it's (1) ü.nc", "here.nc", str(elsewhere)]


def test_a_study_is_replaced_only_with_overwrite(folder, run):
    own_scan(folder / "one.nc")
    (folder / f"config/{NAME}.yaml").write_text("mine")
    (folder / f"results/{NAME}").mkdir(parents=True)
    (error,) = run(NAME, "one.nc").errors
    assert_says(error, f"config/{NAME}.yaml, results/{NAME}: take another name", "--overwrite")
    assert (folder / f"config/{NAME}.yaml").read_text() == "mine"
    accepted(folder, run(NAME, "one.nc", "--overwrite"))


def assert_line_says(lines, *parts):
    """Expect all parts in one of the lines."""
    assert any(all(text in line for text in parts) for line in lines), (parts, lines)


def test_all_problems_are_reported_at_once_and_nothing_is_written(folder, run):
    own_scan(folder / "good.nc")
    own_scan(folder / "odd{1}.nc", seed=2)
    (folder / "my.csv").write_text("surface,value,unit\na_test_of_new,1,\nb,2,uN\n")
    files_before = sorted(folder.rglob("*"))
    quantities = ["--radius", "5 N", "--preload", "10", "--tip", "3 s", "--work", "1e9 J/m2"]
    files = ["good.nc", "odd{1}.nc", "none.di"]
    done = run("a/b", *files, *quantities, "--forces", "my.csv")
    assert done.code == 1 and not done.out
    messages = [
        ["NAME", "letters", "'a/b'"], ["--radius", "nm", "5 N"], ["--preload", "N", "10"],
        ["--tip", "nm", "3 s"], ["--work", "100 J/m²", "1e9 J/m2"], ["none.di", "no such file"],
        ["odd{1}.nc", "without {, }"], ["my.csv: line 2", "unit"], ["my.csv: line 3", "b"],
    ]  # fmt: skip
    for message_parts in messages:
        assert_line_says(done.errors, *message_parts)
    assert all(line.startswith("error: ") for line in done.errors)
    assert sorted(folder.rglob("*")) == files_before


@pytest.mark.parametrize(("unit", "size", "message"), [
    ("nm", "5", "error: --size: expected a length with a unit, such as 5.6nm or 250um, found '5'"),
    ("nn", "5um", "error: --unit: expected none, m, mm, um, nm, angstrom or pm, or two of these, "
     "such as mm,nm, found 'nn'"),
])  # fmt: skip
def test_a_faulty_size_or_unit_makes_no_fault_of_the_file(folder, run, unit, size, message):
    np.savetxt(folder / "bare.txt", rough())
    assert run(NAME, "bare.txt", "--unit", unit, "--size", size).errors == [message]


#: Arguments that are refused, and parts of the message.
REFUSED = [
    ([NAME], ["expected files"]),
    (["my coat", "one.nc"], ["NAME: expected a name of up to 94 letters", "'my coat'"]),
    (["lock.txt", "one.nc"], ["NAME: expected a name", "without .txt at the end"]),
    ([f"{NAME}-quick", "one.nc"], ["NAME: expected a name without the end -quick"]),
    (["store", "one.nc", "--overwrite"], ["found store"]),
    (["kept", "one.nc"], ["NAME: expected a new name, found results/kept-quick: take another"]),
    ([NAME, "one.nc", "./one.nc"], ["one.nc", "once", "2 times"]),
    (
        [NAME, "--surface", "A", "one.nc", "--surface", "a", "two.nc"],
        ["A and a:", "found a for both"],
    ),
    ([NAME, "--surface", "$x$", "one.nc", "two.nc"], ["--surface", "label", "without $"]),
    ([NAME, "a\n\033[31m.nc"], ["'a\\n\\x1b[31m.nc'", "printable"]),
    ([NAME, "bare.nc"], ["bare.nc", "--unit"]),
    ([NAME, "bare.nc", "--unit", "mm,s"], ["--unit: expected none, m, mm", "found 'mm,s'"]),
    ([NAME, "one.nc", "--sphere", "two.nc", "--radius", "1 um"], ["sphere.radius", "2500 nm"]),
    # A quarter of the mirrored scan of 5 um at 25 GPa.
    ([NAME, "one.nc", "--preload", "1 N"], ["preload: expected at most 156 mN", "found 1 N"]),
    ([NAME, "one.nc", "--hardness", "25 kPa"], ["--hardness 25 kPa: is the unit", "25 GPa?"]),
    ([NAME, "one.nc", "--tip", "100 um"], ["at least 3 bins", "found 0", "one.nc", "the tip at"]),
]


def test_faulty_arguments_are_refused_in_one_line_and_nothing_is_written(folder, run):
    own_scan(folder / "one.nc")
    own_scan(folder / "two.nc", seed=2)
    write_scan(folder / "bare.nc", rough(), (2.5, 2.5), unit=None)
    (folder / "results/kept-quick").mkdir(parents=True)
    files_before = sorted(folder.rglob("*"))
    for arguments, message_parts in REFUSED:
        done = run(*arguments)
        assert done.code == 1
        assert_line_says(done.errors, *message_parts)
        assert sorted(folder.rglob("*")) == files_before
