"""Elastic contacts of all surfaces and scans."""

from hardcontact.base.dataset import read_all
from hardcontact.base.job import job
from hardcontact.contact.all_surfaces import stacked_elastic_contacts

with job(snakemake) as job:
    job.write(
        stacked_elastic_contacts(
            read_all(job.parameters["scans"], job.input.scans), job.parameters
        ),
        title="elastic contacts: pressure at the preload, and pull-off beside that of rigid bodies",
    )
