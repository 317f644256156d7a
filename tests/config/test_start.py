"""Where a study may run, and what it says at its end."""

import shutil
import subprocess
import sys

import pytest
from refusals import assert_says
from repository import ROOT, environment, snakemake

# Where a study runs


def said(run):
    """Return the one line with which a run is refused."""
    assert run.returncode == 1 and "Traceback" not in run.stdout, run.stdout
    (line,) = [line for line in run.stdout.splitlines() if line.startswith("error: ")]
    return line


@pytest.mark.study
def test_another_working_directory_is_refused(repository, tmp_path):
    snakefile = str(repository / "Snakefile")
    line = said(snakemake(repository, "-n", "--directory", str(tmp_path)))
    assert_says(line, "working directory", str(tmp_path), "relative to that folder")
    (tmp_path / "workflow").symlink_to(repository / "workflow")  # the library it runs with
    assert said(snakemake(tmp_path, "-n", "--snakefile", snakefile)) == line


@pytest.mark.study
def test_use_as_a_module_is_refused(repository, tmp_path):
    text = f'module study:\n    snakefile: "{repository / "Snakefile"}"\n\nuse rule * from study\n'
    (tmp_path / "Snakefile").write_text(text)
    (tmp_path / "workflow").symlink_to(repository / "workflow")
    assert_says(said(snakemake(tmp_path, "-n")), "used as a module", str(tmp_path))


def test_the_library_of_another_copy_is_refused(repository, tmp_path):
    shutil.copy2(repository / "Snakefile", tmp_path)
    (tmp_path / "workflow").symlink_to(repository / "workflow")
    line = said(snakemake(tmp_path, "-n"))
    assert_says(line, f"expected the library of {tmp_path}", f"found that of {repository}")


ANSWER = """
from hardcontact.config import start
rule answer:
    output: "results/answer.html"
    shell: "touch {output}"
rule other:
    output: "results/other.nc"
    shell: "touch {output}"
onsuccess:
    start.say_answer(workflow, "results/answer.html")
"""


@pytest.mark.study
@pytest.mark.parametrize(("target", "said"), [("answer", True), ("other", False)])
def test_the_page_that_a_run_makes_is_named_at_its_end(tmp_path, target, said):
    (tmp_path / "Snakefile").write_text(ANSWER)
    run = subprocess.run(
        [sys.executable, "-m", "snakemake", target, "--cores", "1"],
        cwd=tmp_path, env=environment(ROOT), text=True, capture_output=True,
    )  # fmt: skip
    assert run.returncode == 0, run.stderr
    assert ("open results/answer.html" in run.stdout + run.stderr) == said
