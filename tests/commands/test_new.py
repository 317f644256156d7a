"""The command `hardcontact new`, from files to a study that its checks accept."""

import sys
from types import SimpleNamespace

import numpy as np
import pytest
import yaml
from refusals import assert_says
from repository import PAPER, ROOT, merged
from scan_files import container, nanoscope, scan

from hardcontact.commands import new, request
from hardcontact.config import checks
from hardcontact.config import selection as surface_table
from hardcontact.config.model import configuration

NAME = "a-test.of_new"


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """A top folder whose configuration is the project's, and where studies are written."""
    for part in ("config", "workflow"):
        (tmp_path / part).mkdir()
    for file in ("config/config.yaml", "config/quick.yaml", "config/surfaces.tsv"):
        (tmp_path / file).write_bytes((ROOT / file).read_bytes())
    for part in ("resources", "workflow/schemas"):
        (tmp_path / part).symlink_to(ROOT / part)
    for module in (new, request):
        monkeypatch.setattr(module, "ROOT", tmp_path)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def rough(pixels=64, rms=3.0, seed=1):
    """Heights (x, y) in nm of a rough surface without a preferred direction."""
    q = np.hypot(*np.meshgrid(*[np.fft.fftfreq(pixels)] * 2))
    q[0, 0] = 1
    white = np.fft.fft2(np.random.default_rng(seed).standard_normal((pixels, pixels)))
    heights = np.fft.ifft2(white * np.maximum(q, 3 / pixels) ** -1.8).real
    return rms * (heights - heights.mean()) / heights.std()


def own_scan(path, size=2500.0, **others):
    return scan(path, rough(**others), (size, size))


def run(monkeypatch, capsys, *arguments):
    """Run the command; return exit code, what it says and the errors it tells."""
    monkeypatch.setattr(sys, "argv", ["hardcontact", "new", *map(str, arguments)])
    code = new.main()
    said = capsys.readouterr()
    return SimpleNamespace(code=code, out=said.out, errors=said.err.splitlines())


def accepted(folder, name, effort="full"):
    """Check a study that was written as a run of it would; return its configuration and table."""
    overlay = yaml.safe_load((folder / f"config/{name}.yaml").read_text("utf-8"))
    quick = overlay.pop("quick")
    config = merged(PAPER, overlay)
    config = merged(config, quick) if effort == "quick" else config
    config = configuration(config)
    table = surface_table.surface_table(folder / f"config/{name}.tsv")
    checks.check(config, table, [])
    return config, table


def test_one_scan(folder, monkeypatch, capsys):
    own_scan(folder / "one.nc")
    done = run(monkeypatch, capsys, NAME, "one.nc")
    assert done.code == 0 and not done.errors
    assert_says(done.out, "one.nc", "height map", "64 x 64", "2.5 µm", "contact")
    assert f"snakemake --configfile config/{NAME}.yaml" in done.out.splitlines()
    assert f"In tables, own forces and paths: a_test_of_new is {NAME}" in done.out.splitlines()
    config, table = accepted(folder, NAME)
    assert config["published"] == "none" and config["sphere"]["surface"] == "smooth"
    assert table.path.tolist() == ["one.nc"] and table.surface.tolist() == ["a_test_of_new"]
    assert config["study"] == NAME and config["surfaces"] == f"config/{NAME}.tsv"
    quick, _ = accepted(folder, NAME, "quick")
    assert quick["study"] == f"{NAME}-quick" and quick["store"] == f"{config['store']}-quick"
    # Reading the written files again makes the same study.
    assert accepted(folder, NAME)[0] == config


def test_what_files_do_not_state_is_given_and_kept(folder, monkeypatch, capsys):
    scan(folder / "bare.nc", rough(), (2.5, 2.5), unit=None)
    done = run(monkeypatch, capsys, NAME, "bare.nc")
    assert done.code == 1 and len(done.errors) == 1 and "--unit" in done.errors[0]
    nanoscope(folder / "a.001", 10 * rough(), (2500.0, 2500.0), ["Height", "Sensor"])
    scan(folder / "bare.nc", 1e-3 * rough(seed=2), (2.5, 2.5), unit=None)
    options = ("--unit", "um", "--channel", "Sensor")
    done = run(monkeypatch, capsys, NAME, "bare.nc", "a.001", *options)
    assert done.code == 0, done.errors
    config, table = accepted(folder, NAME)
    assert config["scan"]["unit"] == "um" and set(table.dataset) == {"", "Sensor"}


def test_everything_that_is_found_is_used(folder, monkeypatch, capsys):
    own_scan(folder / "large.nc", 10000.0, pixels=256)
    small = own_scan(folder / "small.nc", 500.0)
    entry = {"name": "s", "datafile": {"original": "s.nc"}, "unit": "nm", "size": [500.0] * 2}
    container(folder / "twin.zip", [entry], {"s.nc": small})
    done = run(monkeypatch, capsys, NAME, "large.nc", "twin.zip", "--tip", "8 nm")
    assert done.code == 0, done.errors
    _, table = accepted(folder, NAME)
    assert table.use.tolist() == ["contact", "spectrum"]
    assert table.dataset.tolist() == ["", "s.nc"] and set(table.tip_radius) == {"8 nm"}


def test_several_surfaces_a_sphere_and_forces(folder, monkeypatch, capsys):
    for name in ("bare", "coated", "ball"):
        own_scan(folder / f"{name}.nc", rms=1.0)
    (folder / "my.csv").write_text("surface,value,unit\nbare,0.5,uN\ncoated_ii,300,nN\n")
    arguments = [
        "--forces", "my.csv", "--surface", "bare", "bare.nc", "--surface", "Coated (II)",
        "coated.nc", "--radius", "100um", "--sphere", "ball.nc", "--range", "4nm",
        "--work", "50 mJ/m^2",
    ]  # fmt: skip
    done = run(monkeypatch, capsys, NAME, *arguments)
    assert done.code == 0, done.errors
    config, table = accepted(folder, NAME)
    assert table.surface.tolist() == ["bare", "coated_ii", "sphere"]
    assert table.label.tolist() == ["bare", "Coated (II)", "sphere"]
    spelled = "In tables, own forces and paths: coated_ii is Coated (II)"
    assert spelled in done.out.splitlines()
    assert config["sphere"] == {"surface": "sphere", "radius": 1e5}
    assert config["forces"] == "my.csv" and config["scales"]["range"] == 4
    assert config["adhesion"]["work"] == 0.05


def test_a_name_that_is_no_name_is_told_once(folder, monkeypatch, capsys):
    own_scan(folder / "good.nc")
    done = run(monkeypatch, capsys, "my coat", "good.nc")
    assert done.code == 1
    (line,) = done.errors
    assert_says(line, "NAME: expected a name of up to 94 letters", "no blanks", "'my coat'")
    done = run(monkeypatch, capsys, f"{NAME}-quick", "good.nc")
    assert_says(done.errors[0], "NAME: expected another end than -quick")


def test_paths_are_those_from_the_top_folder(folder, monkeypatch, capsys, tmp_path_factory):
    (folder / "deep").mkdir()
    elsewhere = own_scan(tmp_path_factory.mktemp("elsewhere") / "there.nc")
    own_scan(folder / "here.nc", seed=2)
    own_scan(folder / "deep/it's (1) ü.nc", seed=3)
    monkeypatch.chdir(folder / "deep")
    done = run(monkeypatch, capsys, NAME, "it's (1) ü.nc", folder / "here.nc", elsewhere)
    assert done.code == 0, done.errors
    monkeypatch.chdir(folder)
    _, table = accepted(folder, NAME)
    assert table.path.tolist() == ["deep/it's (1) ü.nc", "here.nc", str(elsewhere)]


def test_a_study_is_not_written_into_another_clone(folder, monkeypatch, capsys, tmp_path_factory):
    other = tmp_path_factory.mktemp("other")
    (other / "workflow/hardcontact").mkdir(parents=True)
    monkeypatch.chdir(other)
    ended = run(monkeypatch, capsys, NAME, own_scan(folder / "a.001"))
    (error,) = ended.errors
    assert ended.code == 1 and str(other) in error and str(folder) in error
    assert not (folder / f"config/{NAME}.yaml").exists()


def test_all_problems_are_told_at_once_and_nothing_is_left(folder, monkeypatch, capsys):
    own_scan(folder / "good.nc")
    for odd in ("odd{1}.nc", "odd<1>.nc"):
        own_scan(folder / odd)
    (folder / "my.csv").write_text("surface,value,unit\na_test_of_new,1,\nb,2,uN\n")
    before = sorted(folder.rglob("*"))
    files = ["good.nc", "odd{1}.nc", "odd<1>.nc", "none.di"]
    quantities = ["--radius", "5 N", "--preload", "10", "--tip", "3 s", "--work", "1e9 J/m2"]
    done = run(monkeypatch, capsys, "a/b", *files, *quantities, "--forces", "my.csv")
    assert done.code == 1 and not done.out
    expected = [
        ["NAME", "letters", "'a/b'"], ["--radius", "nm", "'5 N'"], ["--preload", "N", "'10'"],
        ["--tip", "nm", "'3 s'"], ["--work", "100 J/m2", "1e9 J/m2"], ["none.di", "no such file"],
        ["odd{1}.nc", "without {, }"], ["odd<1>.nc", "without {, }"],
        ["my.csv: line 2", "unit"], ["my.csv: line 3", "'b'"],
    ]  # fmt: skip
    for parts in expected:
        assert any(all(part.strip("'") in line for part in parts) for line in done.errors), parts
    assert all(line.startswith("error: ") for line in done.errors)
    assert sorted(folder.rglob("*")) == before


def test_what_the_scans_do_not_permit_is_told_in_the_units_of_the_user(folder, monkeypatch, capsys):
    own_scan(folder / "one.nc", rms=6.0)
    options = ["--range", "0.01 nm", "--preload", "1 N"]
    done = run(monkeypatch, capsys, "paper", "one.nc", *options)
    assert done.code == 1 and len(done.errors) == 3
    assert_says(done.errors[0], "NAME", "found paper")
    assert_says(done.errors[1], "--range: expected at least", "nm", "found 0.01 nm")
    # A quarter of the stitched scan of 5 um at 25 GPa.
    assert_says(done.errors[2], "--preload: expected at most 156 mN", "found 1 N")


def test_a_scan_without_reliable_wavelengths_is_refused_beforehand(folder, monkeypatch, capsys):
    own_scan(folder / "blunt.nc")
    done = run(monkeypatch, capsys, NAME, "blunt.nc", "--tip", "100 um")
    assert done.code == 1 and len(done.errors) == 1
    assert_says(done.errors[0], "at least 3 bins", "found 0", "blunt.nc from", "(the tip)")


def test_a_study_is_replaced_only_when_told(folder, monkeypatch, capsys):
    own_scan(folder / "one.nc")
    (folder / f"config/{NAME}.yaml").write_text("mine")
    done = run(monkeypatch, capsys, NAME, "one.nc")
    assert done.code == 1 and len(done.errors) == 1
    assert_says(done.errors[0], f"config/{NAME}.yaml", "--overwrite")
    assert (folder / f"config/{NAME}.yaml").read_text() == "mine"
    assert run(monkeypatch, capsys, NAME, "one.nc", "--overwrite").code == 0
    accepted(folder, NAME)
    (folder / "results/kept-quick").mkdir(parents=True)
    done = run(monkeypatch, capsys, "kept", "one.nc")
    assert len(done.errors) == 1 and "results/kept-quick: expected none" in done.errors[0]
    done = run(monkeypatch, capsys, "config", "one.nc", "--overwrite")
    assert done.code == 1 and "the project's" in done.errors[0]


@pytest.mark.parametrize(
    ("arguments", "parts"),
    [
        ((NAME,), ["expected files"]),
        ((NAME, "one.nc", "./one.nc"), ["one.nc", "once", "2 times"]),
        ((NAME, "--surface", "A"), ["--surface A", "expected files"]),
        ((NAME, "--surface", "A", "one.nc", "--surface", "a", "two.nc"), ["of its own", "also a"]),
        ((NAME, "--surface", "sphere", "one.nc", "--sphere", "two.nc"), ["label of its own"]),
        (
            (NAME, "--surface", "smooth", "one.nc"),
            ["surface", "neither pooled nor smooth", "found 'smooth'"],
        ),
        ((NAME, "--surface", "$x$", "one.nc"), ["label", "without $"]),
        ((NAME, "--surface", "$x$", "one.nc", "two.nc"), ["--surface", "label", "without $"]),
        ((NAME, "a\n\033[31m.nc"), ["'a\\n\\x1b[31m.nc'", "printable"]),
        ((NAME, "a\udcff.nc"), ["'a\\udcff.nc'", "printable"]),
        ((NAME, "."), [".: expected a scan", "found a folder"]),
        ((NAME, "one.nc", "--forces", "none.csv"), ["--forces", "none.csv"]),
        ((NAME, "one.nc", "--sphere", "two.nc", "--radius", "1 um"), ["sphere.radius", "2500 nm"]),
    ],
)
def test_refused(folder, monkeypatch, capsys, arguments, parts):
    own_scan(folder / "one.nc")
    own_scan(folder / "two.nc", seed=2)
    done = run(monkeypatch, capsys, *arguments)
    assert done.code == 1
    assert any(all(part in line for part in parts) for line in done.errors), done.errors
    assert not (folder / f"config/{NAME}.yaml").exists()


def test_a_colloidal_probe(folder, monkeypatch, capsys):
    own_scan(folder / "one.nc", 1000.0, rms=2.0)
    options = ["--radius=5um", "--hardness=5GPa", "--preload=100nN", "--range=2nm"]
    done = run(monkeypatch, capsys, NAME, *options, "one.nc")
    assert done.code == 0, done.errors
    for effort in ("full", "quick"):
        config, _ = accepted(folder, NAME, effort)
        assert config["sphere"]["radius"] == 5000 and config["scales"]["range"] == 2
        assert config["contact"]["preload"] == 1e-7 and config["contact"]["hardness"] == 5e9


@pytest.mark.parametrize(
    ("label", "surface"),
    [("UNCD", "uncd"), ("Coated (II)", "coated_ii"), ("3 nm", "surface_3_nm"), ("ü", "surface"),
     ("a" * 39 + "-b", "a" * 39)],
)  # fmt: skip
def test_ids_of_surfaces(label, surface):
    assert request.surface_id(label) == surface


def test_ctrl_c_is_one_line(monkeypatch, capsys):
    def interrupted(arguments):
        raise KeyboardInterrupt

    monkeypatch.setattr(new, "parsed", interrupted)
    monkeypatch.setattr(sys, "argv", ["hardcontact", "new", "mine", "a.nc"])
    assert new.main() == 130
    assert len(capsys.readouterr().err.splitlines()) == 1
