"""Effective work of adhesion and classical models of rough adhesion, beside the pull-off forces."""

from hardcontact.base import published
from hardcontact.base.dataset import read
from hardcontact.base.job import job
from hardcontact.base.statistics import Sampling
from hardcontact.paper.classical_comparison import apply_classical_models

with job(snakemake) as this:
    given = this.parameters
    this.write(
        apply_classical_models(
            read(this.input.inference),
            published.constants(this.input.published_constants),
            published.table1(this.input.published_table1),
            published.printed_pull_off(this.input.published_pull_off),
            Sampling(given["seed"], given["samples"], given["confidence"], ("classical",)),
        ),
        title="effective work of adhesion, and classical models of rough adhesion",
    )
