"""Forces on whole substitute surfaces with a part of their roughness, by the limits of a band."""

from hardcontact.base import published
from hardcontact.base.dataset import read
from hardcontact.contact.contact import Contact
from hardcontact.contact.pull_off import make_force_function
from hardcontact.inference.band_forces import band_force_dataset
from hardcontact.inference.edges import mean_band
from hardcontact.records.job import run_job
from hardcontact.surfaces.featured_scans import summarize_whole_surfaces

with run_job(snakemake) as job:
    compute_forces = make_force_function(Contact(**job.parameters["contact"]))
    constants = published.read_constants(job.input.published_constants)["value"]
    bands = {
        "published": (constants["short_edge"], constants["long_edge"]),
        "found": mean_band(read(job.input.edges)),
    }
    job.write(
        summarize_whole_surfaces(
            job, lambda surface: band_force_dataset(surface, bands, compute_forces)
        ),
        title=f"pull-off forces of {job.parameters['surface']} with a part of the roughness",
    )
