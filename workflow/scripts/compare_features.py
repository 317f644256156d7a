"""Forces, at the published range and work, of surfaces with features: features.nc."""

from hardcontact.base.dataset import read_by_key, read_dataset
from hardcontact.inference.published_fit import PublishedForces
from hardcontact.paper.featured_candidates import compare_features
from hardcontact.records.job import run_job

with run_job(snakemake) as job:
    comparison = compare_features(
        read_by_key(job.parameters["candidate_chunks"], job.input.candidates),
        read_dataset(job.input.sets)["sphere_factor"],
        PublishedForces.read(job.input.published_pull_off, job.input.published_constants),
        job.parameters["labels"],
    )
    title = "forces on surfaces with features at the published range and work of adhesion"
    job.write(comparison, title)
