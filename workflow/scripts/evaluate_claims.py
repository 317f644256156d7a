"""Statements of the paper, each with its computed number and its verdict."""

from hardcontact.base import published
from hardcontact.base.dataset import read
from hardcontact.base.job import job
from hardcontact.paper.evaluation import evaluate, read_statements

with job(snakemake) as job:
    params = job.parameters
    claims = evaluate(
        read_statements(job.input.claims),
        {name: read(job.input[name]) for name in params["datasets"]},
        published.constants(job.input.published_constants),
        params["confidence"],
        read(job.input.sets),
    )
    job.write_text(claims.to_csv(index=False, float_format="%.6g"), "claims")
