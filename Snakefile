"""Which scales of roughness matter for the adhesion of hard contacts: the study, end to end."""

import logging

# On a full disk Snakemake's own log cannot be written: what it prints is enough, no tracebacks.
logging.raiseExceptions = False

configfile: "config/config.yaml"

report: "workflow/report/workflow.rst"

container: "docker://python:3.11-slim"

include: "workflow/rules/common.smk"
include: "workflow/rules/surfaces.smk"
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
include: "workflow/rules/provenance.smk"


rule all:
    default_target: True
    input:
        rules.describe_crate.input,  # all that is described, should some of it be missing
        rules.crate.input,
