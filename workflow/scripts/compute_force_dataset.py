"""The pull-off forces on your surfaces at the work of adhesion of the study: force.nc."""

from hardcontact.base.dataset import read_dataset
from hardcontact.contact.contact import Contact
from hardcontact.inference.mean_forces import MasterScans
from hardcontact.inference.scan_parts import fewest_touched_patches
from hardcontact.own.force_dataset import ForceInputs, compute_force_dataset
from hardcontact.records.job import run_job

with run_job(snakemake) as job:
    params = job.parameters
    inputs = ForceInputs(
        adhesion=read_dataset(job.input.adhesion),
        filtered_forces=read_dataset(job.input.filtered_forces),
        topography=read_dataset(job.input.topography),
        spectra=read_dataset(job.input.spectra),
        hindcast=read_dataset(job.input.hindcast) if job.input.hindcast else None,
    )
    touched_patches = fewest_touched_patches(inputs.adhesion)
    dataset = compute_force_dataset(
        inputs,
        Contact(**params["contact"]),
        MasterScans(params["scan_counts"], params["tiles"], touched_patches),
        params["tolerance"],
        params["confidence"],
    )
    job.write(dataset, title="pull-off forces on the surfaces")
