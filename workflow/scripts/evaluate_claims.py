"""Statements of the paper, each beside what was computed, with its verdict."""

from hardcontact.base import published
from hardcontact.base.dataset import read
from hardcontact.base.job import job
from hardcontact.paper.evaluation import evaluate, read_statements

with job(snakemake) as this:
    params = this.parameters
    evaluated = evaluate(
        read_statements(this.input.claims),
        {name: read(this.input[name]) for name in params["datasets"]},
        published.constants(this.input.published_constants),
        params["confidence"],
        read(this.input.sets),
        params["seed"],
    )
    this.write_text(evaluated.to_csv(index=False, float_format="%.6g"), "claims")
