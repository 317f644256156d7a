"""The wavelengths whose removal changes the pull-off force, with their intervals."""

from hardcontact.base import dataset
from hardcontact.base.statistics import Sampling
from hardcontact.inference.edges import edges_with_samples, labelled_edges
from hardcontact.records.job import run_job

with run_job(snakemake) as job:
    params = job.parameters
    scales = dataset.read(job.input.scales)
    sampling = Sampling.from_parameters(params["sampling"])
    edges, _ = edges_with_samples(scales, params["tolerance"], sampling)
    job.write(
        labelled_edges(edges, scales, params["tolerance"], sampling.confidence),
        title="pull-off force against cutoff wavelength, and the edges of the band",
    )
