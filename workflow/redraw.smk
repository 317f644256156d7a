"""Figures and pages of a finished study, again, from its datasets alone: no scan, no store."""

import sys
from pathlib import Path

KEPT = f"results/{config.get('study', 'paper')}/configuration.yaml"
if not Path(KEPT).is_file():
    sys.exit(f"error: {KEPT}: expected the configuration of a finished study, found no such file")

configfile: KEPT

report: "report/workflow.rst"

container: "docker://python:3.11-slim"

include: "rules/common.smk"
include: "rules/figures.smk"
include: "rules/report.smk"


rule redraw:
    default_target: True
    input:
        rules.figures.input,
        rules.pages.input,
