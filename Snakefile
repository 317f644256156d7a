"""Which scales of roughness matter for the adhesion of hard contacts: the study, end to end."""

import os
import sys
from pathlib import Path

import yaml

# The library is found here and, through the environment, by every job.
sys.path.insert(0, str(Path(workflow.basedir, "workflow")))
os.environ["PYTHONPATH"] = os.pathsep.join(
    filter(None, [sys.path[0], os.environ.get("PYTHONPATH")])
)

configfile: "config/config.yaml"

report: "workflow/report/workflow.rst"

container: "docker://python:3.11-slim"

include: "workflow/rules/common.smk"
include: "workflow/rules/scans.smk"
include: "workflow/rules/topography.smk"
include: "workflow/rules/adhesion.smk"
include: "workflow/rules/elastic.smk"
include: "workflow/rules/plasticity.smk"
include: "workflow/rules/asperities.smk"
include: "workflow/rules/scales.smk"
include: "workflow/rules/inference.smk"
include: "workflow/rules/classical.smk"
include: "workflow/rules/robustness.smk"
include: "workflow/rules/claims.smk"
include: "workflow/rules/figures.smk"
include: "workflow/rules/report.smk"


rule all:
    default_target: True
    input:
        rules.topography.input,
        rules.adhesion.input,
        rules.elastic.input,
        rules.plasticity.input,
        rules.asperities.input,
        rules.scales.input,
        rules.classical.input,
        rules.robustness.input,
        rules.claims.input,
        rules.figures.input,
        rules.pages.input,
