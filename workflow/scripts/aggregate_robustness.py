"""Range and work of adhesion and the critical band under every variant of the study's choices."""

from hardcontact.base import dataset, published
from hardcontact.base.job import job
from hardcontact.base.statistics import Sampling
from hardcontact.paper.robustness import Choices, robustness

SETTINGS = "sphere_radius", "range", "contacts_per_side", "pixels_small", "pixels_large"


with job(snakemake) as job:
    params = job.parameters
    constants = published.constants(job.input.published_constants)["value"]
    choices = Choices(
        params["substrates"],
        params["basis"],
        params["reference_surface"],
        params["probe"],
        constants["error_threshold"],
        params["tolerance"],
        params["realizations"],
        Sampling(
            params["seed"], params["samples"], params["confidence"], ("sampling", "robustness")
        ),
    )
    masters = zip(params["masters"], job.input.scales, strict=True)
    results = robustness(
        dataset.read_all(params["surfaces"], job.input.adhesion),
        [(key, dataset.read(path)) for key, path in masters],
        params["variants"],
        published.pull_off(job.input.published_pull_off),
        choices,
    )
    job.write(
        results.assign_attrs({name: params[name] for name in SETTINGS}),
        title="range and work of adhesion and critical band under other choices",
    )
