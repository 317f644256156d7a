"""For which share of contacts the bearing area holds, and the force of those for which not."""

from hardcontact.insight.elastic_limit import elastic_limit
from hardcontact.records.dataset import read, read_all
from hardcontact.records.job import job

with job(snakemake) as this:
    given = this.parameters
    this.write(
        elastic_limit(
            read_all(given["scans"], this.input.scans),
            read(this.input.elastic),
            given,
            given["confidence"],
        ),
        title="contacts for which the bearing area holds, and forces of the others",
    )
