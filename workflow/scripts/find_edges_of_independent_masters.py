"""The edges of the band of the paper's study: edges.nc."""

from hardcontact.base.dataset import read_dataset
from hardcontact.base.statistics import Sampling
from hardcontact.inference.edges import edges_of_independent_masters, labelled_edges
from hardcontact.records.job import run_job

with run_job(snakemake) as job:
    tolerance = job.parameters["tolerance"]
    sampling = Sampling.from_parameters(job.parameters["sampling"])
    filtered_forces = read_dataset(job.input.filtered_forces)
    edges, _ = edges_of_independent_masters(filtered_forces, tolerance, sampling)
    edges = labelled_edges(edges, filtered_forces, tolerance, sampling.confidence)
    job.write(edges, title="pull-off force against cutoff wavelength, and the edges of the band")
