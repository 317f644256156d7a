"""`pip install .` alone gives a command and an API that work, without the pins of the study."""

import json
import shutil
import subprocess
import sys

import pytest
from prediction_command import predict_json
from repository import CACHES, ROOT

SCAN = ROOT / "resources/examples/demo.txt"
PROGRAM = """
import hardcontact, sys
spectrum = hardcontact.read_spectrum(sys.argv[1])
numbers = hardcontact.predict(
    spectrum, radius=250e3, preload=10e-6, hardness=25e9, rho=5.6, work=0.0463
)
print(numbers["closed_form_force"].value)
"""


@pytest.fixture
def programs(tmp_path):
    """Install the package into an empty environment; return the folder of its programs."""
    source = tmp_path / "source"
    shutil.copytree(ROOT / "workflow", source / "workflow", ignore=CACHES)
    for name in ("pyproject.toml", "README.md", "LICENSE"):
        shutil.copyfile(ROOT / name, source / name)
    subprocess.run([sys.executable, "-m", "venv", tmp_path / "environment"], check=True)
    programs = tmp_path / "environment/bin"
    subprocess.run([programs / "pip", "install", "-q", source], check=True)
    shutil.rmtree(source)  # so that only what was installed is used
    return programs


@pytest.mark.system
def test_the_installed_package_predicts_as_the_library_here(programs, tmp_path, monkeypatch):
    monkeypatch.delenv("PYTHONPATH", raising=False)

    def output(program, *words):
        command = [programs / program, *words]
        return subprocess.run(
            command, cwd=tmp_path, check=True, stdout=subprocess.PIPE, text=True
        ).stdout

    words = ["predict", str(SCAN), "--json", "-"]
    expected_force = predict_json(str(SCAN))["closed_form_force"]["value"]
    by_command = json.loads(output("hardcontact", *words))["closed_form_force"]["value"]
    by_program = float(output("python", "-c", PROGRAM, str(SCAN)))
    assert [by_command, by_program] == pytest.approx([expected_force] * 2, rel=1e-6)
