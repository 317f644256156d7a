"""Repeated contact on all surfaces: force and indents against the number of contacts."""

from hardcontact.adhesion.repeated_contact import repeated_contact
from hardcontact.records.dataset import read_all
from hardcontact.study.job import job

with job(snakemake) as this:
    given = this.parameters
    this.write(
        repeated_contact(read_all(given["pairs"], this.input.pairs), given, given["confidence"]),
        title="force and indents of repeated contact against the number of contacts",
    )
