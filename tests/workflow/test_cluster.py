"""The line of a job that a cluster refused or ended, from messages of SLURM 22.05."""

from types import SimpleNamespace

import pytest
from refusals import assert_says

from snakemake_logger_plugin_stages.cluster import failure

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
    reported = failure(job, message, [str(path)])
    assert reported.startswith(f"SLURM job my_rule: {line}") and reported.endswith(f", see {path}")
    assert_says(failure(job, message, []), "SLURM job my_rule: ")
