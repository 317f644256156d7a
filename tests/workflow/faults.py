"""Faults brought into a study, and the errors that a run names."""

from textwrap import indent

#: The script that the tests alter: of one quick job, from which only the crate follows.
ALTERED = "keep_configuration"
#: What differs from the results of the script as it was.
OF_ALTERED = ("quick/ro-crate-metadata.json",)
#: The line of every script below which its log is kept.
BEGIN = "with job(snakemake) as this:\n"


def errors(output):
    """Return the different lines in which a run names its errors; a job that is retried repeats."""
    assert "Traceback" not in output, output
    return sorted({line for line in output.splitlines() if line.startswith("error:")})


def alter(study, lines):
    """Put lines into the altered script, where its log has begun."""
    path = study / f"workflow/scripts/{ALTERED}.py"
    head, begin, rest = path.read_text().partition(BEGIN)
    assert begin
    path.write_text(f"{head}{begin}{indent(lines, '    ')}\n{rest}")


def others(lines, *expected):
    """Return the differences between results that do not begin with anything expected."""
    return [line for line in lines if not line.startswith(expected)]


def but_missing(lines):
    """Return the differences between results that are no missing files."""
    return [line for line in lines if not line.endswith(": missing")]
