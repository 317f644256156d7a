"""Effective work of adhesion and classical models of rough adhesion, beside the pull-off forces."""

from hardcontact.inference.classical_comparison import apply_classical_models
from hardcontact.numbers.statistics import Sampling
from hardcontact.records import published
from hardcontact.records.dataset import read
from hardcontact.records.job import job

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
