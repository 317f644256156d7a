"""Statements of the paper with computed numbers, and verdicts if the inputs are the paper's."""

import math

from hardcontact.base import published
from hardcontact.base.dataset import read_dataset
from hardcontact.paper.changed_inputs import changed_inputs
from hardcontact.paper.claims.judgement import judge_claims
from hardcontact.paper.claims.statements import read_claims
from hardcontact.records.job import run_job

with run_job(snakemake) as job:
    params = job.parameters
    datasets = {name: read_dataset(job.input[name]) for name in params["datasets"]}
    constants = published.read_constants(job.input.published_constants)
    table1 = published.read_table1(job.input.published_table1)
    sets = read_dataset(job.input.sets)
    claims = read_claims(job.input.claims)
    judged_claims = judge_claims(claims, datasets, constants, params["confidence"], sets)
    substrates = datasets["edges"]["surface"].values.tolist()
    if changed_inputs(params["contact_inputs"], substrates, table1):
        judged_claims = judged_claims.assign(verdict="", agreeing_share=math.nan)
    job.write_text(judged_claims.to_csv(index=False, float_format="%.6g"), "claims")
