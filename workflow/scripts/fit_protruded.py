"""Range and work of adhesion of all sets if one coating or the sphere had rare protrusions."""

from hardcontact.base import published
from hardcontact.base.dataset import read
from hardcontact.base.job import job
from hardcontact.contact.contact import PLASTIC
from hardcontact.inference.published_fit import Pair, PublishedFit
from hardcontact.paper.protruded_sets import empty_protruded_forces, fit_protruded_sets

with job(snakemake) as job:
    constants = published.constants(job.input.published_constants)["value"]
    pull_off = published.pull_off(job.input.published_pull_off)
    sets = read(job.input.sets)
    plastic_sets = sets.sel(contact_model=PLASTIC)
    pair = Pair(constants["range_of_adhesion"], constants["work_of_adhesion"])
    coating = job.parameters["surface"]
    for output, body in (("protruded", "one coating"), ("protruded_sphere", "the sphere")):
        draw_datasets = [read(path) for path in job.input[output]]
        # Without substitutes there are no draws.
        draw_datasets = draw_datasets or [
            empty_protruded_forces(coating, plastic_sets["rho"].values)
        ]
        protruded_fits = fit_protruded_sets(
            draw_datasets, coating, plastic_sets, PublishedFit(pull_off, pair)
        )
        job.write(
            protruded_fits.assign_attrs(job.parameters),
            title=f"range and work of adhesion if {body} had protrusions",
            output=output,
        )
