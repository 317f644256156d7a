"""Pull-off forces on all masters, filtered and unfiltered, and their ratios: filtered_forces.nc."""

from hardcontact.base.dataset import add_labels_and_sources
from hardcontact.base.units import NM
from hardcontact.inference.forces_on_masters import add_spectrum_shifts, read_master_forces
from hardcontact.records.job import run_job

with run_job(snakemake) as job:
    params = job.parameters
    loading = params["loading"]
    forces = read_master_forces(params["surfaces"], job.input.master_forces, loading)
    if job.input.sampled_master_forces:  # Only spectra of measured surfaces are sampled.
        sampled_forces = read_master_forces(
            params["sampled_surfaces"], job.input.sampled_master_forces, loading
        )
        forces = add_spectrum_shifts(forces, sampled_forces)
    forces = add_labels_and_sources(forces, params)
    transitions = [params["transitions"][side] for side in forces["side"].values]
    forces = forces.assign(transition=("side", transitions, NM))
    forces.attrs |= {name: params[name] for name in ("rho", "sphere_radius")}
    job.write(forces, title="plastic pull-off forces of filtered masters")
