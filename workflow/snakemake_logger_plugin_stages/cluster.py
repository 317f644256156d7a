"""Why a cluster refused or ended a job: a line with SLURM's reason and the key that mends it.

Snakemake drops the reason for jobs that hold several rules.
"""

import logging
import re
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from snakemake_interface_executor_plugins.executors.remote import RemoteExecutor

#: The logger of the study's own messages.
study_logger = logging.getLogger("snakemake.logging.study")
PROFILE = "profiles/slurm/profile.yaml"
#: Words of SLURM's reason, and the key of a job's resources that mends it: the first that fits.
KEYS = {
    r"account": "slurm_account",
    r"partition": "slurm_partition",
    r"time ?(limit|out)": "runtime",
    r"memory|oom.kill|node configuration": "mem_mb",
}
#: What the executor reports: the message of sbatch, or that of an exception, or the state of a job.
REPORTS = (
    r"The error message was '(.*?)'\.\n",
    r"Job submission failed with exception: (.*)",
    r"SLURM status is: '(\w+)'",
)
#: What SLURM adds to the output of a job that it ends.
ADDITION = re.compile(r"^slurmstepd\S*: error: (.*)$", re.M)


#: What the executor does with a job that failed.
_print_job_error = RemoteExecutor.print_job_error
#: The lines of jobs that were logged.
_logged = set[str]()


def log_reasons() -> None:
    """Log why a cluster refused or ended a job, each reason once."""
    RemoteExecutor.print_job_error = _log_reason


def _log_reason(executor: Any, job_info: Any, msg: str | None = None, **fields: Any) -> None:
    line = failure(job_info.job, msg or "", fields.get("aux_logs", []))
    if line not in _logged:
        study_logger.error(line)
    _logged.add(line)
    _print_job_error(executor, job_info, msg, **fields)


def failure(job: Any, message: str, logs: Iterable[str]) -> str:
    """Return the line of a job that failed, from the message of the executor and SLURM's logs."""
    files = [Path(log) for log in logs if log and Path(log).is_file()]
    texts = [file.read_text("utf-8", "replace") for file in files]
    additions = [addition for text in texts for addition in ADDITION.findall(text)]
    reason = ": ".join([_reason(message), *additions[:1]])
    key = next((KEYS[words] for words in KEYS if re.search(words, reason, re.I)), "")
    remedy = f": change {key} (now {job.resources.get(key)}) in {PROFILE}" if key else ""
    see = f", see {files[0]}" if files else ""
    return f"SLURM job {job.name}: {reason}{remedy}{see}"


def _reason(message: str) -> str:
    """Return the reason in a message of the executor, on one line."""
    matches = [match[1] for report in REPORTS if (match := re.search(report, message, re.S))]
    text = re.sub(r"sbatch: error: |Batch job submission failed: ", "", (matches or [message])[0])
    return "; ".join(map(str.strip, text.splitlines()))
