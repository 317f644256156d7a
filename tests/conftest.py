"""Refusals and small scans; copies of the repository, one of them with a finished quick study."""

import os
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path
from types import SimpleNamespace

import matplotlib as mpl
import numpy as np
import pytest
import yaml
from SurfaceTopography import Topography

from hardcontact.figures import style

ROOT = Path(__file__).parents[1]
PARTS = [
    "Snakefile", "environment.txt", "README.md", "CITATION.cff", "workflow", "config", "resources",
    "profiles",
]  # fmt: skip
QUICK = "config/quick.yaml"
SCHEMAS = {
    name: yaml.safe_load((ROOT / f"workflow/schemas/{name}.schema.yaml").read_text())
    for name in ("config", "surfaces")
}
PAPER = yaml.safe_load((ROOT / "config/config.yaml").read_text())
ROWS = (ROOT / "config/surfaces.tsv").read_text()
PUBLISHED = ["polished_uncd", "uncd", "ncd", "mcd"]
#: What robustness makes otherwise in the quick study: heights of uncd alone are skewed, and ncd
#: has no number that is read from the curvature of Table 1.
OTHERWISE = ["polished_uncd.laplacian", "uncd.laplacian", "mcd.laplacian", "uncd.skewness-0"]


def refusal(call, *arguments):
    """The one line with which a call refuses its input."""
    with pytest.raises(ValueError) as caught:
        call(*arguments)
    message = str(caught.value)
    assert len(message.splitlines()) == 1, message
    return message


def assert_says(message, *parts):
    for part in parts:
        assert part in message, message


def assert_leaves_alone(module, datasets):
    """A figure's module changes neither the datasets it draws nor the style of others."""
    before = [data.copy(deep=True) for data in datasets]
    style_before = dict(mpl.rcParams)
    module.draw(*datasets)
    module.table(*datasets)
    assert dict(mpl.rcParams) == style_before
    for old, new in zip(before, datasets, strict=True):
        assert getattr(old, "identical", old.equals)(new)  # a table has no attributes to compare


def save_figure(module, datasets, folder):
    """Save a figure and its table in `folder`; the bytes of its files by their names."""
    folder.mkdir(exist_ok=True)
    kinds = {kind: str(folder / f"figure.{kind}") for kind in ("pdf", "png", "csv")}
    style.save(
        module.draw(*datasets),
        module.table(*datasets),
        SimpleNamespace(**kinds, record=str(folder / "figure.json")),
        title="a figure",
        parameters="{}",
        inputs=[],
        code=[],
    )
    return {kind: Path(path).read_bytes() for kind, path in kinds.items()}


def heights(*shape):
    return np.random.default_rng(1).standard_normal(shape or (32, 32))


def scan(path, values=None, sizes=(320.0, 320.0), unit="nm"):
    """Write a scan of 10 nm a pixel, or of other sizes; first axis x."""
    Topography(heights() if values is None else values, sizes, unit=unit).to_netcdf(str(path))
    return path


def container(path, entries, files):
    """A container with these entries of meta.yml and these files: name -> path."""
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("meta.yml", yaml.safe_dump({"surfaces": [{"topographies": entries}]}))
        for name, file in files.items():
            archive.write(file, name)
    return path


def cut(path, share):
    """Keep the first share of a file's bytes."""
    content = path.read_bytes()
    path.write_bytes(content[: int(share * len(content))])
    return path


def leaves(tree, path=()):
    """Paths of the leaves of nested dicts."""
    for key, value in tree.items():
        if isinstance(value, dict):
            yield from leaves(value, (*path, key))
        else:
            yield ".".join((*path, key))


def merged(base, overlay):
    """Deeply, as Snakemake merges configuration files."""
    return base | {
        key: merged(base[key], value) if isinstance(value, dict) else value
        for key, value in overlay.items()
    }


def copy_repository(target):
    """What a study needs, without results; returns `target`."""
    target.mkdir()
    for part in PARTS:
        copy = shutil.copytree if (ROOT / part).is_dir() else shutil.copy2
        copy(ROOT / part, target / part)
    return target


def snakemake(folder, *arguments):
    """Run snakemake in `folder`; output as one text."""
    return subprocess.run(
        [sys.executable, "-m", "snakemake", *arguments],
        cwd=folder,
        env=os.environ | {"PATH": f"{Path(sys.executable).parent}:{os.environ['PATH']}"},
        text=True,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
    )


def run_snakemake(folder, *arguments, overlays=()):
    """Run the quick study with further overlays (dicts) in `folder`; output as one text."""
    files = [QUICK]
    for number, overlay in enumerate(overlays):
        files.append(f"overlay-{number}.yaml")
        Path(folder, files[-1]).write_text(yaml.safe_dump(overlay))
    return snakemake(folder, *arguments, "--configfile", *files)


@pytest.fixture
def at_root(monkeypatch):
    monkeypatch.chdir(ROOT)


@pytest.fixture(scope="module")
def repository(tmp_path_factory):
    return copy_repository(tmp_path_factory.mktemp("repository") / "study")


@pytest.fixture(scope="session")
def finished(tmp_path_factory):
    """A copy of the repository in which the quick study has run; not to be changed."""
    folder = copy_repository(tmp_path_factory.mktemp("finished") / "study")
    run = run_snakemake(folder)
    assert run.returncode == 0, run.stdout[-3000:]
    return folder


@pytest.fixture
def finished_copy(finished, tmp_path):
    """A finished quick study to change; its some 90 MB are removed again."""
    yield shutil.copytree(finished, tmp_path / "copy")
    shutil.rmtree(tmp_path / "copy")
