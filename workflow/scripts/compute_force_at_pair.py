"""The pull-off forces on the user's surfaces at one range and work of adhesion."""

from hardcontact.base.dataset import read
from hardcontact.contact.contact import Contact
from hardcontact.inference.mean_forces import MasterScans
from hardcontact.inference.scan_parts import fewest_touched_patches
from hardcontact.own.force_at_pair import force_dataset
from hardcontact.records.job import run_job

with run_job(snakemake) as job:
    params = job.parameters
    adhesion = read(job.input.adhesion)
    touched_patches = fewest_touched_patches(adhesion)
    job.write(
        force_dataset(
            adhesion,
            read(job.input.scales),
            read(job.input.topography),
            read(job.input.spectra),
            read(job.input.hindcast) if job.input.hindcast else None,
            contact=Contact(**params["contact"]),
            master_scans=MasterScans(params["scan_counts"], params["tiles"], touched_patches),
            tolerance=params["tolerance"],
            confidence=params["confidence"],
        ),
        title="pull-off forces at one range and work",
    )
