"""Range and work of adhesion and the critical band under every variant of the study's choices."""

from hardcontact.base import dataset, published
from hardcontact.base.job import job
from hardcontact.base.statistics import Sampling
from hardcontact.paper.robustness import Choices, robustness

SETTINGS = "sphere_radius", "range", "count", "pixels_small", "pixels_large"


with job(snakemake) as this:
    given = this.parameters
    constants = published.constants(this.input.published_constants)["value"]
    choices = Choices(
        given["substrates"],
        given["basis"],
        given["reference_surface"],
        given["probe"],
        constants["error_threshold"],
        given["tolerance"],
        given["realizations"],
        Sampling(given["seed"], given["samples"], given["confidence"], ("sampling", "robustness")),
    )
    masters = zip(given["masters"], this.input.scales, strict=True)
    varied = robustness(
        dataset.read_all(given["surfaces"], this.input.adhesion),
        [(key, dataset.read(path)) for key, path in masters],
        given["variants"],
        published.pull_off(this.input.published_pull_off),
        choices,
    )
    this.write(
        varied.assign_attrs({name: given[name] for name in SETTINGS}),
        title="range and work of adhesion and critical band under other choices",
    )
