"""Range and work of adhesion and force statistics of every contact model."""

from hardcontact.base import dataset, published
from hardcontact.base.job import job
from hardcontact.base.statistics import Sampling
from hardcontact.paper.inference import Pair, Published, infer

with job(snakemake) as this:
    given = this.parameters
    constants = published.constants(this.input.published_constants)["value"]
    this.write(
        infer(
            dataset.read(this.input.adhesion),
            Published(
                published.pull_off(this.input.published_pull_off),
                Pair(constants["range_of_adhesion"], constants["work_of_adhesion"]),
            ),
            given["reference_surface"],
            constants["error_threshold"],
            constants["force_floor"],
            Sampling(given["seed"], given["samples"], given["confidence"]),
        ),
        title="range and work of adhesion and force statistics",
    )
