"""Pull-off forces on masters of one surface, unfiltered and filtered at every cutoff."""

from hardcontact.inference.forces_on_masters import compute_master_forces
from hardcontact.records.job import run_job
from hardcontact.surfaces.height_map import load_height_map

with run_job(snakemake) as job:
    params = job.parameters
    sphere = load_height_map(job.input.sphere) if job.input.sphere else None
    job.write(
        compute_master_forces(params, job.input, sphere),
        title=f"pull-off of filtered masters of {params['surface']}",
    )
