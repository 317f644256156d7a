"""Draw the figures and pages of a finished study again, from its datasets: no scan, no store."""

from hardcontact.study import start

start.prepare(workflow)


configfile: start.kept_configuration(config)


report: "report/workflow.rst"


include: "rules/common.smk"
include: "rules/figures.smk"
include: "rules/report.smk"


onstart:
    start.hold_folders(PATTERNS.results)
    start.lift_rate_limit(workflow)


rule redraw:
    """Draw all figures and write all pages of a finished study again."""
    default_target: True
    input:
        rules.figures.input,
        rules.pages.input,
