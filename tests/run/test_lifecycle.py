"""A run refuses faults before its first job, and obeys Ctrl-C until its end."""

import json
import logging
import os
import signal
import subprocess
import sys
import time
from copy import deepcopy
from types import SimpleNamespace

import pytest
from refusals import assert_says
from repository import PAPER, ROOT, TINY, copy_repository, environment
from snakemake.cli import parse_config
from snakemake.settings.types import ExecMode
from snakemake.utils import update_config
from studies import tiny_files

from hardcontact.config.configuration import apply_effort
from hardcontact.run import lifecycle, study_inputs


def refusal_line(call, *arguments, parts=("expected", "found")):
    """Return the line of the refusal of a run, which has all parts."""
    with pytest.raises(SystemExit) as caught:
        call(*arguments)
    (line,) = str(caught.value).splitlines()
    assert_says(line, "error: ", *parts)
    return line


def planned_workflow(*configfiles):
    """Return an object like Snakemake's workflow of a planned run."""
    return SimpleNamespace(
        exec_mode=ExecMode.DEFAULT,
        configfiles=configfiles,
        config_settings=SimpleNamespace(config={}),
    )


def configured(*words):
    """Return a workflow and the configuration of the paper with words of `--config`."""
    workflow = planned_workflow()
    workflow.config_settings.config = parse_config(words)
    config = deepcopy(PAPER)
    update_config(config, workflow.config_settings.config)
    return workflow, config


@pytest.mark.parametrize(
    ("rules_folder", "main", "working"),
    [
        ("other", "other/Snakefile", ROOT),
        (ROOT, "Snakefile", ROOT),
        (ROOT, ROOT / "Snakefile", "."),
    ],
)
def test_a_run_in_another_folder_is_refused(tmp_path, monkeypatch, rules_folder, main, working):
    monkeypatch.chdir(tmp_path / working)
    monkeypatch.setattr(logging, "raiseExceptions", True)
    folder = SimpleNamespace(get_path_or_uri=lambda secret_free: tmp_path / rules_folder)
    workflow = SimpleNamespace(current_basedir=folder, main_snakefile=tmp_path / main)
    assert_says(refusal_line(lifecycle.prepare, workflow), str(tmp_path), str(ROOT))


def test_the_grids_of_the_paper_are_refused_for_own_surfaces():
    quick = ROOT / "config/quick.yaml"
    for configfiles in ((quick, ROOT / TINY), (ROOT / TINY, quick)):
        study = planned_workflow(*configfiles)
        line = refusal_line(
            study_inputs.checked_configuration, study, PAPER | {"published": "none"}
        )
        assert_says(line, "config/quick.yaml", "--config effort=quick")


def test_keys_of_the_quick_study_are_checked_in_a_full_run():
    overlay = {"quick": {"contact": {"contacts_per_row": 0}}}
    line = refusal_line(study_inputs.checked_configuration, planned_workflow(), PAPER | overlay)
    assert_says(line, "effort quick", "contact.contacts_per_row", "found 0")


def test_a_study_of_the_project_has_other_values_only_if_asked():
    study_inputs.checked_configuration(*configured("contact={hardness: 25GPa}"))  # the same
    harder = "contact={hardness: 30 GPa}"
    line = refusal_line(study_inputs.checked_configuration, *configured(harder))
    assert_says(
        line, "study paper", "contact.hardness: '30 GPa' in place of '25 GPa'", "overwrite=true"
    )
    for words in ((harder, "overwrite=true"), (harder, "study=harder")):
        study_inputs.checked_configuration(*configured(*words))


def test_a_quick_study_has_its_own_folders():
    own_configuration = PAPER | {"study": "own", "store": "results/own-store", "effort": "quick"}
    harder = {"study": "harder", "contact": PAPER["contact"] | {"hardness": "30 GPa"}}
    quick = {"quick": {"contact": {"contacts_per_row": 6}}}
    for overlays, study in (({}, "own-quick"), (harder, "harder-quick")):
        configured = apply_effort(own_configuration | quick | overlays)
        assert (configured["study"], configured["store"]) == (study, "results/own-store-quick")
        assert apply_effort(configured) == configured
        assert configured["contact"]["contacts_per_row"] == 6


@pytest.mark.parametrize("text", ["2026-13-45", "'a: b: c'", "four", "2.5"])
def test_a_faulty_value_of_the_command_line_is_refused_with_its_key(text):
    study = configured(f"asperities={{contacts: {text}}}")
    line = refusal_line(study_inputs.checked_configuration, *study)
    assert_says(line, "config key asperities.contacts", "a whole number", text.strip("'"))


# The end of a run


@pytest.mark.parametrize("made_now", ["answer.html", "claims.csv"])
def test_the_answer_is_logged_only_by_a_run_that_makes_it(tmp_path, caplog, made_now):
    answer = {"headline": ["Waves matter."], "verdicts": [], "notes": []}
    (tmp_path / "answer.json").write_text(json.dumps(answer))
    page = str(tmp_path / "answer.html")
    jobs = {
        name: SimpleNamespace(output=[tmp_path / name]) for name in ("answer.html", "claims.csv")
    }
    dag = SimpleNamespace(jobs=[*jobs.values()], finished_jobs=[jobs[made_now]])
    with caplog.at_level(logging.INFO, lifecycle.logger.name):
        lifecycle.log_answer(SimpleNamespace(dag=dag), page)
    lines = ["Waves matter.", f"The answer is made: open {page}"]
    assert caplog.messages == (lines if made_now == "answer.html" else [])


@pytest.mark.parametrize("page_is_made", [True, False])
def test_a_failed_run_is_resumed_only_if_files_are_missing(caplog, page_is_made):
    check, page = SimpleNamespace(output=[]), SimpleNamespace(output=["answer.html"])
    unfinished = [check] if page_is_made else [check, page]
    dag = SimpleNamespace(jobs=[check, page], needrun_jobs=lambda: unfinished)
    lifecycle.log_how_to_resume(SimpleNamespace(dag=dag))
    assert caplog.messages == ([] if page_is_made else [lifecycle.RESUME])


def listen_to_ctrl_c():
    """Obey Ctrl-C again, which shells make programs in the background ignore."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


@pytest.mark.study
def test_a_stopped_run_reports_that_the_same_command_continues_it(tmp_path, project_folder):
    study = copy_repository(tmp_path / "study")
    # Three jobs, one after the other: the first ends before the others begin.
    files = tiny_files()
    master = files.path(files.patterns.masters, "uncd", realization=1, side="short")
    with subprocess.Popen(
        [sys.executable, "-m", "snakemake", master, "--configfile", TINY],
        cwd=study, env=environment(study), text=True, start_new_session=True,
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, preexec_fn=listen_to_ctrl_c,
    ) as run:  # fmt: skip
        messages = []
        for line in run.stdout:
            if "jobs done" in line:
                begin = time.monotonic()
                for _ in range(2):
                    os.killpg(run.pid, signal.SIGINT)  # Ctrl-C reaches all processes of a terminal.
            messages.append(line.rstrip())
    assert run.returncode == 130 and time.monotonic() - begin < 5
    assert messages[-1] == lifecycle.RESUME and "jobs done" in messages[-2]
    assert not [*study.glob(".snakemake/locks/*")]


#: A run on a cluster: Snakemake cancels its jobs at the first Ctrl-C.
CLUSTER_RUN = """
import time
from types import SimpleNamespace
from hardcontact.run import lifecycle

lifecycle.kill_jobs_at_interrupt(SimpleNamespace(local_exec=False, persistence=None))
for state in ("running", "cancelling"):
    try:
        print(state, flush=True)
        time.sleep(60)
    except KeyboardInterrupt:
        pass
"""


def test_a_second_ctrl_c_ends_a_run_on_a_cluster_without_a_traceback():
    with subprocess.Popen(
        [sys.executable, "-c", CLUSTER_RUN],
        env=environment(ROOT), text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
        preexec_fn=listen_to_ctrl_c,
    ) as run:  # fmt: skip
        for state in ("running", "cancelling"):
            assert run.stdout.readline() == f"{state}\n"
            run.send_signal(signal.SIGINT)
        begin = time.monotonic()
        assert run.stdout.read() == f"{lifecycle.RESUME}\n"
    assert run.returncode == 130 and time.monotonic() - begin < 5
