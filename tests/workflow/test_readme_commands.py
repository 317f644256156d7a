"""Every command of README.md and config/README.md works as it is printed.

A shell without the environment on its PATH types them, where a program that was not activated is
not found. Programs there only note how they were called. Then `hardcontact` is called in this way,
and `snakemake` with `-n`, as its runs take minutes; installation is what .ci/run does.
"""

import importlib.util
import json
import os
import re
import subprocess
import sys

import numpy as np
import pytest
from forked_runs import run_forked, run_program
from own_studies import uncd_heights, write_spm
from paper_study import answer
from repository import ROOT, copy_repository, environment, snakemake_outputs
from scan_files import write_container, write_scan

from hardcontact.base.arrays import generator

pytestmark = pytest.mark.study

READMES = ("README.md", "config/README.md")
COMMAND = re.compile(r"(?:snakemake|hardcontact|python|python3|pip|conda|source|sh|rm)\b.*")
#: Words of the user, or a command that is only named.
NOT_TYPED = re.compile(r".*\b(FILE|NAME)\b.*|hardcontact new( --overwrite)?")
#: Notes how it was called, between separators, a line per call.
PROGRAM = """#!/bin/bash
{ printf '%s\\x1f' "${0##*/}" "$@"; echo; } >> "$CALLS"
"""
#: Makes the environment without packages: its programs take notes.
PYTHON3 = f"""{PROGRAM}
[ "$*" = "-m venv .venv" ] || exit 0
'{sys.executable}' -m venv --without-pip .venv
for name in pip snakemake hardcontact python pytest
do cp --remove-destination "$PROGRAM" .venv/bin/$name
done
"""


def blocks(text):
    """Return language and content of each fenced block."""
    return re.findall(r"^```(\w*)\n(.*?)^```$", text, re.M | re.S)


def commands(text):
    """Return the commands of fenced blocks, of prose and of tables, in their order."""
    typed = []
    for section in re.split(r"(^```\w*\n.*?^```$)", text, flags=re.M | re.S):
        if section.startswith("```"):
            (language, content), *_ = blocks(section)
            if not language:
                typed += filter(COMMAND.match, content.splitlines())
            continue
        for line in re.split(r"\n(?=\||\n|[-#] )", section):
            cell = line.split(" | ")[0] if line.startswith("|") else line
            codes = [" ".join(code.split()) for code in re.findall("`([^`]+)`", cell)]
            codes = [code for code in codes if not NOT_TYPED.fullmatch(code)]
            commands = [code for code in codes if " " in code and COMMAND.fullmatch(code)]
            typed += commands
            if commands and line.startswith("|"):  # Other targets of the same command.
                typed += [f"snakemake {code}" for code in codes if re.fullmatch(r"\w+", code)]
    return typed


def overlays(text):
    """Return the overlays by their files: named in the first line, or by the study."""
    return {
        (re.match(r"# (\S+\.yaml)", content) or re.match(r"study: (\S+)", content))[1]
        .removesuffix(".yaml") + ".yaml": content
        for language, content in blocks(text)
        if language == "yaml"
    }  # fmt: skip


def write_files(folder):
    """Write the scans, tables and answers that the commands read."""
    scans = folder / "scans"
    scans.mkdir()
    for number, name in enumerate(("coating-10um.di", "bare-1.spm", "bare-2.spm", "coated-1.spm")):
        write_spm(scans / name, uncd_heights(generator(number), 128, 10_000.0), 10_000.0)
    write_spm(scans / "film.spm", uncd_heights(generator(4), 128, 1000.0, 3.0), 1000.0)
    (folder / "resources/scans").mkdir(exist_ok=True)
    write_spm(
        folder / "resources/scans/my-scan.spm", uncd_heights(generator(5), 512, 2500.0), 2500.0
    )
    write_scan(scans / "map.nc", uncd_heights(generator(6), 128).T, (2500.0, 2500.0))
    entry = {"name": "map", "datafile": {"original": "map.nc"}}
    write_container(scans / "coating.zip", [entry], {"map.nc": scans / "map.nc"})
    waves = np.geomspace(10, 5000, 20)
    rows = [f"{wave},nm,{wave**4 / 1e3},nm4" for wave in waves]
    head = "wavelength,wavelength_unit,c_iso,c_iso_unit"
    (folder / "my-psd.csv").write_text("\n".join([head, *rows]))
    for study in ("quick", "store-quick", "paper", "harder"):
        (folder / "results" / study).mkdir(parents=True)
    for study in ("quick", "paper", "harder"):
        (folder / "results" / study / "answer.json").write_text(json.dumps(answer()))


def calls(folder, typed):
    """Return the calls of programs, as lists of words, when the lines are typed in one shell."""
    system = folder / "system"
    system.mkdir(exist_ok=True)
    for name, text in (("program", PROGRAM), ("conda", PROGRAM), ("python3", PYTHON3)):
        (system / name).write_text(text)
        (system / name).chmod(0o755)
    notes = folder / "calls"
    notes.write_text("")
    path = f"{system}:/usr/bin:/bin"
    variables = {"PATH": path, "CALLS": str(notes), "PROGRAM": str(system / "program")}
    script = "\n".join(["set -e", *typed])
    run = subprocess.run(
        ["bash", "-c", script], cwd=folder, env=variables, capture_output=True, text=True
    )
    assert run.returncode == 0, run.stderr
    return [line.split("\x1f")[:-1] for line in notes.read_text().splitlines()]


def run_python(folder, content):
    """Run a block of Python in a folder."""
    os.chdir(folder)
    exec(content, {})


#: Options of dry runs, which all runs here are.
DRY = ["-n", "-q", "rules"]


def targets_by_options(runs):
    """Return the targets of runs that have the same options: they are planned as one run."""
    targets = {}
    for words in runs:
        end = next((n for n, word in enumerate(words) if word.startswith("-")), len(words))
        options = tuple(word for word in words[end:] if word not in DRY)
        targets.setdefault(options, []).extend(words[:end])
    return targets


def typed_in(folder, readme):
    """Type the commands of a README in a folder; return the runs of Snakemake among them."""
    text = (ROOT / readme).read_text("utf-8")
    for name, content in overlays(text).items():
        (folder / name).write_text(content)
    for language, content in blocks(text):
        if language == "python":
            run_forked(run_python, folder, content)
        elif content.startswith("surface,mean"):
            (folder / "forces.csv").write_text(content)
    typed = commands(text)
    assert len(typed) > 10
    if not any(line.startswith("source .venv/bin/activate") for line in typed):
        typed = ["python3 -m venv .venv", "source .venv/bin/activate", *typed]
    runs = []
    for program, *words in calls(folder, typed):
        if program == "hardcontact" and "--help" not in words:
            run = run_program(
                folder, "hardcontact.commands.command_line", words, environment(folder)
            )
            assert run.returncode == 0, (words, run.stdout)
        elif program == "snakemake":
            runs.append(words)
        elif program == "python":
            assert importlib.util.find_spec(words[1]), words
        elif program == "pip":
            assert (ROOT / words[-1]).exists(), words
    # Overlays without a command: enough to see that they are accepted.
    run_words = {word for words in runs for word in words}
    unused_overlays = [name for name in overlays(text) if name not in run_words]
    return [*runs, *(["topography", "--configfile", name] for name in unused_overlays)]


def test_every_command_of_the_documentation_works(tmp_path):
    planned = set()
    for readme in READMES:
        folder = copy_repository(tmp_path / readme.replace("/", "-"))
        write_files(folder)
        runs = {
            (*dict.fromkeys(targets), *options, *DRY)
            for options, targets in targets_by_options(typed_in(folder, readme)).items()
        }
        snakemake_outputs(folder, sorted(runs - planned))
        planned |= runs
