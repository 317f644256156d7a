"""Pull-off forces on every filtered master, relative to the unfiltered one: filtered_forces.nc."""

from hardcontact.base.dataset import add_surface_names
from hardcontact.base.units import NM
from hardcontact.inference.forces_on_masters import add_spectrum_shifts, read_master_forces
from hardcontact.records.job import run_job

with run_job(snakemake) as job:
    params = job.parameters
    loading = params["loading"]
    forces = read_master_forces(params["surfaces"], job.input.master_forces, loading)
    # On masters of spectra sampled within their errors: only measured surfaces have such errors.
    if job.input.sampled_master_forces:
        sampled_forces = read_master_forces(
            params["sampled_surfaces"], job.input.sampled_master_forces, loading
        )
        forces = add_spectrum_shifts(forces, sampled_forces)
    transitions = [params["transitions"][side] for side in forces["side"].values]
    job.write(
        add_surface_names(forces, params)
        .assign(transition=("side", transitions, NM))
        .assign_attrs({name: params[name] for name in ("rho", "sphere_radius")}),
        title="plastic pull-off forces of filtered masters",
    )
