"""Range and work of adhesion and force statistics of every contact model."""

from hardcontact import published
from hardcontact.adhesion.bootstrap import Bootstrap
from hardcontact.adhesion.inference import infer
from hardcontact.records import dataset
from hardcontact.study.job import job

with job(snakemake) as this:
    given = this.parameters
    this.write(
        infer(
            dataset.read(this.input.adhesion),
            published.pull_off(this.input.published_pull_off),
            given["reference_surface"],
            given["error_threshold"],
            given["force_floor"],
            Bootstrap(given["seed"], given["bootstrap_samples"], given["confidence"]),
        ),
        title="range and work of adhesion and force statistics",
    )
