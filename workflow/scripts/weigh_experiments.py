"""What the closed form says of published experiments, and a verdict on each."""

from hardcontact.claims.weighed_experiments import DRAWS, weighed
from hardcontact.config.configuration import read_yaml
from hardcontact.config.experiments import experiments
from hardcontact.records.job import job

with job(snakemake) as this:
    given, schema = this.parameters, read_yaml(this.input.schema)
    table = experiments(this.input.experiments, this.input.priors, schema)
    this.write(
        weighed(table, DRAWS, given["seed"], given["confidence"]),
        title="published experiments beside the closed form of the pull-off force",
    )
