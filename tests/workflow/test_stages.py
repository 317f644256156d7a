"""The lines of a run in the terminal: stages and messages only, one for a failed SLURM job."""

import logging
import re
import sys
from types import SimpleNamespace
from unittest.mock import MagicMock

import pytest
from refusals import assert_says
from repository import ROOT
from snakemake.logging import DefaultFormatter
from snakemake_interface_logger_plugins.common import LogEvent

from snakemake_logger_plugin_stages import LogHandler
from snakemake_logger_plugin_stages.cluster import failure_line, study_logger
from snakemake_logger_plugin_stages.costs import Stage, read_stages

#: Rules of jobs; `my_rule` is not in the table of stages.
JOBS = ["prepare_scan", "prepare_scan", "my_rule"]


def show(capsys, records, **settings):
    """Return the lines that a handler shows of records: level, logger, message and attributes."""
    common = dict.fromkeys(("dryrun", "verbose", "quiet", "stdout"), False) | settings
    handler = LogHandler(SimpleNamespace(**common), None)
    handler.setFormatter(DefaultFormatter(quiet=None, show_failed_logs=False))
    for level, name, message, fields in records:
        record = logging.LogRecord(name, level, "", 0, message, (), None)
        vars(record).update(fields)
        handler.emit(record)
    handler.close()
    lines = capsys.readouterr().err.splitlines()
    if not any(settings.values()):
        assert lines.pop(0) == "Planning the run ..."
    return lines


def info(message, event=None, **fields):
    return logging.INFO, "snakemake.logging", message, {"event": event, **fields}


def run_records(finished):
    """Yield Snakemake's records of a run of JOBS with a number of finished jobs."""
    yield info("long list", LogEvent.RUN_INFO, stats={"prepare_scan": 2, "my_rule": 1, "total": 3})
    for number, rule in enumerate(JOBS):
        yield info(f"Rule: {rule}", LogEvent.JOB_INFO, jobid=number, rule_name=rule, rule_msg=None)
    for number in range(finished):
        yield info("Finished", LogEvent.JOB_FINISHED, job_id=number)


@pytest.mark.parametrize("finished", range(4))
def test_a_stage_has_a_line_once_all_of_its_jobs_are_done(capsys, finished):
    plan, *lines = show(capsys, run_records(finished))
    assert plan.startswith("3 jobs, about ")
    done = [
        name
        for name, last_job in (("levelled scans", 2), ("my rule", 3))  # as in JOBS, from 1
        if last_job <= finished
    ]
    assert [line[:40].strip() for line in lines] == done
    if finished == 3:
        assert "3 of 3" in lines[-1] and "about 0:00:00 left" in lines[-1]


@pytest.fixture(autouse=True)
def idle_machine(monkeypatch):
    monkeypatch.setattr("os.getloadavg", lambda: (0.0, 0.0, 0.0))


def test_other_processes_lengthen_the_planned_time(capsys, monkeypatch):
    """Six processes of others beside two cores in use: the run has a quarter of both cores."""
    monkeypatch.setattr("os.cpu_count", lambda: 2)
    stages = {"prepare_scan": Stage(80.0, "levelled scans"), "my_rule": Stage(80.0, "my rule")}
    monkeypatch.setattr("snakemake_logger_plugin_stages.read_stages", lambda column: stages)
    for load, minutes in ((0.0, 2), (6.0, 8)):
        monkeypatch.setattr("os.getloadavg", lambda load=load: (load, 0.0, 0.0))
        assert show(capsys, run_records(0))[0] == f"3 jobs, about {minutes} minutes"


def test_time_left_counts_what_jobs_cost(capsys, monkeypatch):
    stages = {"prepare_scan": Stage(1.0, "levelled scans"), "my_rule": Stage(8.0, "my rule")}
    monkeypatch.setattr("snakemake_logger_plugin_stages.read_stages", lambda column: stages)
    monkeypatch.setattr("snakemake_logger_plugin_stages.threading.Thread", MagicMock())
    clock = SimpleNamespace(monotonic=lambda: 10.0)
    monkeypatch.setattr("snakemake_logger_plugin_stages.time", clock)

    def twenty_seconds():
        yield info("Provided cores: 1", LogEvent.RESOURCES_INFO, cores=1)
        *records, last_record = run_records(2)
        yield from records
        clock.monotonic = lambda: 30.0
        yield last_record

    line = show(capsys, twenty_seconds())[-1]
    assert line.startswith("levelled scans")
    # 10 s were planned, and the table weighs as much as 2 s: 8 s at (20 + 2) / (2 + 2) of the cost.
    assert "2 of 3 jobs done, about 0:00:44 left" in line


@pytest.mark.parametrize("has_log", [True, False])
def test_a_job_that_fails_has_one_line_that_names_its_log(capsys, tmp_path, has_log):
    log = tmp_path / "my_rule.log"
    if has_log:
        log.touch()
    failed = {"event": LogEvent.JOB_ERROR, "rule_name": "my_rule", "log": [str(log)]}
    failed |= {"rule_msg": None, "indent": False}
    repeated_error = {"event": LogEvent.ERROR, "exception": "CalledProcessError"}
    errors = [
        (logging.ERROR, "snakemake.logging", "Error", failed),
        (logging.ERROR, "snakemake.logging", "Command ['python'] died", repeated_error),
        (
            logging.ERROR,
            "snakemake.logging",
            "WorkflowError:\nAt least one job did not complete successfully.",
            {"event": LogEvent.ERROR, "exception": "WorkflowError"},
        ),
    ]
    _, line = show(capsys, [*run_records(0), *errors])
    assert line == "Error in rule my_rule" + f": see {log}" * has_log


@pytest.mark.parametrize(
    ("name", "words", "remedy"),
    [
        ("plot", [], "one of topography, adhesion, "),
        ("claim", [], "found claim (did you mean claims?)"),
        ("fig66", [], "found fig66 (did you mean fig6?)"),
        ("fig6", ["--configfile", "config/crn.yaml"], "one of answer, topography"),
        ("claims", ["--configfile", "config/crn.yaml"], "one of answer, topography"),
    ],
)
def test_a_target_that_no_rule_makes_is_refused_in_one_line(
    capsys, monkeypatch, project_folder, name, words, remedy
):
    monkeypatch.setattr(sys, "argv", ["snakemake", name, *words])
    message = f"No rule to produce {name} (if you use input functions ...)."
    error = {"event": LogEvent.ERROR, "exception": "MissingRuleException"}
    (line,) = show(capsys, [(logging.ERROR, "snakemake.logging", message, error)])
    assert line.startswith("error: expected ") and f"found {name}" in line and remedy in line


def test_a_job_that_a_cluster_ends_is_shown_by_the_study_alone(capsys):
    """Snakemake reports each rule of the job, and its plugin what sacct did not answer."""
    plan = info("long list", LogEvent.RUN_INFO, stats={"my_rule": 1, "total": 1})
    failed = {"event": LogEvent.JOB_ERROR, "rule_name": "my_rule", "log": [], "indent": False}
    records = [
        (logging.ERROR, study_logger.name, "SLURM job my_rule: TIMEOUT", {}),
        (logging.ERROR, "snakemake.logging", "", failed | {"rule_msg": "SLURM-job '1' failed"}),
        (logging.ERROR, "snakemake.logging", "", {"event": LogEvent.GROUP_ERROR}),
        (logging.ERROR, "snakemake.logging", "", failed | {"rule_msg": None, "indent": True}),
        (logging.WARNING, "snakemake.logging", "No account was given, not able via sacct", {}),
    ]
    assert show(capsys, [plan, *records])[1:] == ["SLURM job my_rule: TIMEOUT"]


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--configfile", "config/quick.yaml", "figures"],
         "figures: expected a YAML file, found none (targets stand before --configfile)"),
        (["--config", "seed=1", "contact.hardness=30 GPa", "-n"],
         "--config: expected 'contact={hardness: 30 GPa}', found contact.hardness=30 GPa"),
        (["--config", "band.short.pixels=8"],
         "--config: expected 'band={short: {pixels: 8}}', found band.short.pixels=8"),
        (["--config", "seed=1", "figures"],
         "--config: expected KEY=VALUE, found figures (targets stand before --config)"),
    ],
)  # fmt: skip
def test_misplaced_arguments_are_refused_with_a_remedy(
    capsys, monkeypatch, project_folder, words, message
):
    monkeypatch.setattr(sys, "argv", ["snakemake", *words])
    with pytest.raises(SystemExit) as caught:
        show(capsys, [])
    assert str(caught.value) == f"error: {message}"


# Jobs that a cluster refused or ended

#: A message of SLURM 22.05.
STATE = "SLURM-job '7' failed, SLURM status is: '{}'. Detailed failure reason unavailable."


@pytest.mark.parametrize(
    ("message", "log", "line"),
    [
        (
            "SLURM sbatch failed. The error message was 'sbatch: error: invalid partition "
            "specified: a\nsbatch: error: Batch job submission failed: Invalid partition name "
            "specified'.\n    sbatch call:\n        sbatch --mem 20",
            "",
            "invalid partition specified: a; Invalid partition name specified: change "
            "slurm_partition (now 3)",
        ),
        (
            "Job submission failed with exception: The given account a appears to be invalid. "
            "Available accounts:\nb",
            "",
            "The given account a appears to be invalid. Available accounts:; b: change "
            "slurm_account (now 3)",
        ),
        (
            STATE.format("TIMEOUT"),
            "slurmstepd-n1: error: *** JOB 7 ON n1 CANCELLED AT 2026-11-28 DUE TO TIME LIMIT ***",
            "TIMEOUT: *** JOB 7 ON n1 CANCELLED AT 2026-11-28 DUE TO TIME LIMIT ***: change "
            "runtime (now 3)",
        ),
        (STATE.format("OUT_OF_MEMORY"), "", "OUT_OF_MEMORY: change mem_mb (now 3)"),
        (STATE.format("NODE_FAIL"), "", "NODE_FAIL"),
    ],
)
def test_a_failure_has_the_reason_of_slurm_and_the_key_that_mends_it(tmp_path, message, log, line):
    path = tmp_path / "7.log"
    path.write_text(f"some output\n{log}\n")
    keys = ("slurm_account", "slurm_partition", "runtime", "mem_mb")
    job = SimpleNamespace(name="my_rule", resources=dict.fromkeys(keys, 3))
    reported = failure_line(job, message, [str(path)])
    assert reported.startswith(f"SLURM job my_rule: {line}") and reported.endswith(f", see {path}")
    assert_says(failure_line(job, message, []), "SLURM job my_rule: ")


def test_every_rule_that_makes_files_has_a_name_for_the_terminal():
    rules = {
        name
        for path in (ROOT / "workflow/rules").glob("*.smk")
        for name in re.findall(r"^ *rule (\w+):", path.read_text("utf-8"), re.M)
    }
    assert rules - {"verify"} == rules & read_stages("full").keys()  # `verify` makes no file.
