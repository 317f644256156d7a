"""Exponents of the pull-off force and of the edges of the band: exponents.nc."""

from hardcontact.base.dataset import add_labels_and_sources
from hardcontact.inference.forces_on_masters import read_master_forces
from hardcontact.paper.contact_dependence import fit_exponents
from hardcontact.records.job import run_job

with run_job(snakemake) as job:
    params = job.parameters
    forces = read_master_forces(params["surfaces"], job.input.master_forces)
    exponents = fit_exponents(
        forces, params["contact_area"], params["tolerance"], params["confidence"]
    )
    exponents = add_labels_and_sources(exponents, params)
    job.write(exponents, title="exponents of the pull-off force and of the edges of the band")
