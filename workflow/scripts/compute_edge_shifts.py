"""Short edges of plastic and rigid contact at two ranges of adhesion: edge_shifts.nc."""

from hardcontact.base.dataset import add_labels_and_sources
from hardcontact.base.statistics import Sampling
from hardcontact.inference.forces_on_masters import read_master_forces
from hardcontact.paper.contact_dependence import compute_edge_shifts
from hardcontact.records.job import run_job

with run_job(snakemake) as job:
    params = job.parameters
    sampling = Sampling.from_parameters(params["sampling"])
    forces = read_master_forces(params["surfaces"], job.input.master_forces)
    edge_shifts = compute_edge_shifts(forces, params["tolerance"], sampling)
    title = "short edges of plastic and rigid contact at two ranges of adhesion"
    job.write(add_labels_and_sources(edge_shifts, params), title)
