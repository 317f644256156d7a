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
#: Patterns of SLURM's reasons, each with the job resource that mends it; the first match decides.
REMEDIES = {
    r"account": "slurm_account",
    r"partition": "slurm_partition",
    r"time ?(limit|out)": "runtime",
    r"memory|oom.kill|node configuration": "mem_mb",
}
#: Where messages of the executor have the reason: from sbatch, an exception, or the job's state.
REASON_PATTERNS = (
    r"The error message was '(.*?)'\.\n",
    r"Job submission failed with exception: (.*)",
    r"SLURM status is: '(\w+)'",
)
#: The line that SLURM adds to the output of a job that it ends.
SLURM_LINE = re.compile(r"^slurmstepd\S*: error: (.*)$", re.M)


#: What Snakemake does at the failure of a job.
_print_job_error = RemoteExecutor.print_job_error
#: The lines of jobs that were logged.
_logged = set[str]()


def log_reasons() -> None:
    """Log why a cluster refused or ended a job, each reason once."""
    RemoteExecutor.print_job_error = _log_reason


def _log_reason(executor: Any, job_info: Any, msg: str | None = None, **fields: Any) -> None:
    line = failure_line(job_info.job, msg or "", fields.get("aux_logs", []))
    if line not in _logged:
        study_logger.error(line)
    _logged.add(line)
    _print_job_error(executor, job_info, msg, **fields)


def failure_line(job: Any, message: str, logs: Iterable[str]) -> str:
    """Return the line of a job that failed, from the message of the executor and SLURM's logs."""
    files = [Path(log) for log in logs if log and Path(log).is_file()]
    texts = [file.read_text("utf-8", "replace") for file in files]
    slurm_lines = [line for text in texts for line in SLURM_LINE.findall(text)]
    reason = ": ".join([_reason(message), *slurm_lines[:1]])
    key = next((key for pattern, key in REMEDIES.items() if re.search(pattern, reason, re.I)), "")
    remedy = f": change {key} (now {job.resources.get(key)}) in {PROFILE}" if key else ""
    see = f", see {files[0]}" if files else ""
    return f"SLURM job {job.name}: {reason}{remedy}{see}"


def _reason(message: str) -> str:
    """Return the reason in a message of the executor, on one line."""
    matches = (re.search(pattern, message, re.S) for pattern in REASON_PATTERNS)
    reason = next((match[1] for match in matches if match), message)
    text = re.sub(r"sbatch: error: |Batch job submission failed: ", "", reason)
    return "; ".join(map(str.strip, text.splitlines()))
