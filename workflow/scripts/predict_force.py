"""The pull-off forces that a work and a range of adhesion predict."""

from hardcontact.base import dataset
from hardcontact.base.job import job
from hardcontact.contact.contact import Contact
from hardcontact.own.master_forces import Masters
from hardcontact.own.predicted_force import own_force

with job(snakemake) as job:
    params = job.parameters
    contact = Contact(
        radius=params["radius"], range=params["rho"], work=params["work"], **params["contact"]
    )
    job.write(
        own_force(
            dataset.read(job.input.adhesion),
            dataset.read(job.input.scales),
            dataset.read(job.input.topography),
            dataset.read(job.input.spectra),
            contact=contact,
            masters=Masters(params["scans"], params["tiles"]),
            tolerance=params["tolerance"],
            confidence=params["confidence"],
        ),
        title="predicted pull-off forces",
    )
