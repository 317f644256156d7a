"""Copies of the repository to run Snakemake in, one of them with a finished quick study."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
import yaml

ROOT = Path(__file__).parents[1]
PARTS = ["Snakefile", "environment.txt", "workflow", "config", "resources", "profiles"]
QUICK = "config/quick.yaml"


def copy_repository(target):
    """What a study needs, without results; returns `target`."""
    target.mkdir()
    for part in PARTS:
        copy = shutil.copytree if (ROOT / part).is_dir() else shutil.copy2
        copy(ROOT / part, target / part)
    return target


def run_snakemake(folder, *arguments, overlays=()):
    """Run the quick study with further overlays (dicts) in `folder`; output as one text."""
    files = [QUICK]
    for number, overlay in enumerate(overlays):
        files.append(f"overlay-{number}.yaml")
        Path(folder, files[-1]).write_text(yaml.safe_dump(overlay))
    return subprocess.run(
        [sys.executable, "-m", "snakemake", *arguments, "--configfile", *files],
        cwd=folder,
        env=os.environ | {"PATH": f"{Path(sys.executable).parent}:{os.environ['PATH']}"},
        text=True,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
    )


@pytest.fixture(scope="session")
def finished(tmp_path_factory):
    """A copy of the repository in which the quick study has run; not to be changed."""
    folder = copy_repository(tmp_path_factory.mktemp("finished") / "study")
    run = run_snakemake(folder)
    assert run.returncode == 0, run.stdout[-3000:]
    return folder


@pytest.fixture
def finished_copy(finished, tmp_path):
    """A finished quick study to change; its some 80 MB are removed again."""
    yield shutil.copytree(finished, tmp_path / "copy")
    shutil.rmtree(tmp_path / "copy")
