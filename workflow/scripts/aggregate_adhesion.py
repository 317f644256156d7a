"""Pull-off forces on all substrate scans, by contact model and range of adhesion: adhesion.nc."""

from hardcontact.base.dataset import add_labels_and_sources, read_by_key
from hardcontact.contact.pull_off import stack_pull_off_forces
from hardcontact.records.job import run_job

with run_job(snakemake) as job:
    params = job.parameters
    forces = stack_pull_off_forces(read_by_key(params["scan_ids"], job.input.scans))
    forces = add_labels_and_sources(forces, params)
    forces.attrs |= {name: params[name] for name in ("rho", "sphere_radius")}
    job.write(forces, title="pull-off forces at a work of adhesion of 1 J/m2")
