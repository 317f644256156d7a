"""The edges of the band of substitutes: edges.nc."""

from hardcontact.base.dataset import read_dataset
from hardcontact.base.statistics import Sampling
from hardcontact.inference.edges import edges_of_masters, labelled_edges
from hardcontact.records.job import run_job

with run_job(snakemake) as job:
    params = job.parameters
    filtered_forces = read_dataset(job.input.filtered_forces)
    sampling = Sampling.from_parameters(params["sampling"])
    edges, _ = edges_of_masters(filtered_forces, params["tolerance"], sampling)
    job.write(
        labelled_edges(edges, filtered_forces, params["tolerance"], sampling.confidence),
        title="pull-off force against cutoff wavelength, and the edges of the band",
    )
