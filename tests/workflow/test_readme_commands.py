"""Commands of README.md and config/README.md work as they are printed.

All `hardcontact` commands run, in one folder. `snakemake` commands run with `-n`, because they
would take minutes. .ci/run does the installation.
"""

import json
import os
import re
import shlex

import pytest
import yaml
from forked_runs import run_forked, run_programs
from own_studies import uncd_heights, write_spm
from paper_study import answer
from repository import ROOT, copy_repository, environment, snakemake_outputs
from scan_files import write_container, write_scan

from hardcontact.base.arrays import generator

pytestmark = pytest.mark.study

READMES = ("README.md", "config/README.md")
COMMAND = re.compile(r"(?:snakemake|hardcontact|python|python3|pip|conda|source|sh|rm)\b.*")
#: Words of the user, or a command that is only named.
NOT_TYPED = re.compile(r".*\b(FILE|NAME)\b.*|hardcontact (predict|new( --overwrite)?)")
#: Programs that need no environment.
SYSTEM_PROGRAMS = {"rm", "sh", "source"}


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
            cell_commands = [code for code in codes if " " in code and COMMAND.fullmatch(code)]
            typed += cell_commands
            if cell_commands and line.startswith("|"):  # Other targets of the same command.
                typed += [f"snakemake {code}" for code in codes if re.fullmatch(r"\w+", code)]
    return typed


def calls(text):
    """Yield the programs that a text calls, with their words.

    Expects programs of an environment to have its path, or to follow a line that activates it.
    """
    typed = commands(text)
    assert len(typed) > 5
    # A text without this line begins with the environment active.
    is_active = not any(line.startswith("source .venv/bin/activate") for line in typed)
    for line in typed:
        for command in line.split(" && "):
            program, *words = shlex.split(command, comments=True)
            is_active |= program == "source"
            in_environment = program.startswith(".venv/bin/")
            assert is_active or in_environment or program in SYSTEM_PROGRAMS, line
            yield program.removeprefix(".venv/bin/"), *words


def overlays(text):
    """Return the overlays by file name, which is in the first line or that of the study."""
    configurations = {}
    for content in (content for language, content in blocks(text) if language == "yaml"):
        name = (re.match(r"# (\S+)\.yaml", content) or re.match(r"study: (\S+)", content))[1]
        configurations[f"{name}.yaml"] = yaml.safe_load(content)
    return configurations


def write_files(folder):
    """Write the scans, tables and answers that the commands read."""
    scans = folder / "scans"
    scans.mkdir()
    for number, name in enumerate(("coating-10um.di", "bare-1.spm", "bare-2.spm", "coated-1.spm")):
        write_spm(scans / name, uncd_heights(generator(number), 128, 10_000.0), 10_000.0)
    write_spm(scans / "film.spm", uncd_heights(generator(4), 128, 1000.0, 3.0), 1000.0)
    write_scan(scans / "map.nc", uncd_heights(generator(6), 128).T, (2500.0, 2500.0))
    entry = {"name": "map", "datafile": {"original": "map.nc"}}
    write_container(scans / "coating.zip", [entry], {"map.nc": scans / "map.nc"})
    for study in ("quick", "harder"):
        (folder / "results" / study).mkdir(parents=True)
        (folder / "results" / study / "answer.json").write_text(json.dumps(answer()))


def run_python(folder, content):
    """Run a block of Python in a folder."""
    os.chdir(folder)
    exec(content, {})


def expanded(folder, words):
    """Yield words as a shell gives them to a program."""
    for word in words:
        paths = sorted(folder.glob(word)) if "*" in word else []
        yield from (str(path.relative_to(folder)) for path in paths) if paths else [word]


#: Options of dry runs, which all runs here are.
DRY = ["-n", "-q", "rules"]


def dry_runs(runs):
    """Return runs without jobs; those with the same options are planned as one run."""
    targets_by_options = {}
    for words in runs:
        end = next((n for n, word in enumerate(words) if word.startswith("-")), len(words))
        options = tuple(word for word in words[end:] if word not in DRY)
        targets_by_options.setdefault(options, {}).update(dict.fromkeys(words[:end]))
    return [[*targets, *options, *DRY] for options, targets in targets_by_options.items()]


def test_every_command_of_the_documentation_works(tmp_path):
    folder = copy_repository(tmp_path / "study")
    write_files(folder)
    texts = [(ROOT / readme).read_text("utf-8") for readme in READMES]
    configurations = {}
    for name, content in (pair for text in texts for pair in overlays(text).items()):
        assert configurations.setdefault(name, content) == content
        (folder / name).write_text(yaml.safe_dump(content))
    for language, content in (block for text in texts for block in blocks(text)):
        if language == "python":
            run_forked(run_python, folder, content)
        elif content.startswith("surface,mean"):
            (folder / "forces.csv").write_text(content)
    words_of = {}
    for program, *words in dict.fromkeys(call for text in texts for call in calls(text)):
        words_of.setdefault(program, []).append(words)
    assert words_of.keys() <= {"hardcontact", "pytest", "sh", "snakemake", "source"}
    assert all((ROOT / words[0]).exists() for words in words_of["sh"])
    study_words = [[*expanded(folder, words)] for words in words_of["hardcontact"]]
    program = "hardcontact.commands.command_line"
    for run in run_programs(folder, program, study_words, environment(folder)):
        assert run.returncode == 0, run.stdout
    # Overlays without a command: enough to see that they are accepted.
    run_words = {word for words in words_of["snakemake"] for word in words}
    unused = [["topography", "--configfile", name] for name in {*configurations} - run_words]
    snakemake_outputs(folder, dry_runs([*words_of["snakemake"], *unused]))
