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


@pytest.mark.system
def test_the_package_installed_alone_predicts_as_the_library_here(tmp_path, monkeypatch):
    monkeypatch.delenv("PYTHONPATH", raising=False)
    source, programs = tmp_path / "source", tmp_path / "environment/bin"
    shutil.copytree(ROOT / "workflow", source / "workflow", ignore=CACHES)
    for name in ("pyproject.toml", "README.md", "LICENSE"):
        shutil.copyfile(ROOT / name, source / name)
    subprocess.run([sys.executable, "-m", "venv", programs.parent], check=True)
    subprocess.run([programs / "pip", "install", "-q", source], check=True)
    shutil.rmtree(source)  # so that only what was installed is used

    def output(program, *words):
        command = [programs / program, *words]
        return subprocess.run(
            command, cwd=tmp_path, check=True, stdout=subprocess.PIPE, text=True
        ).stdout

    expected_force = predict_json(str(SCAN))["closed_form_force"]["value"]
    written = json.loads(output("hardcontact", "predict", str(SCAN), "--json", "-"))
    by_command = written["closed_form_force"]["value"]
    by_program = float(output("python", "-c", PROGRAM, str(SCAN)))
    assert [by_command, by_program] == pytest.approx([expected_force] * 2, rel=1e-6)
