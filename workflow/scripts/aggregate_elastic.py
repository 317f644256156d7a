"""Elastic contacts of all surfaces and scans."""

from hardcontact.base.dataset import read_all
from hardcontact.contact.stacked_datasets import stack_elastic_contacts
from hardcontact.records.job import run_job

with run_job(snakemake) as job:
    params = job.parameters
    scans = read_all(params["scan_keys"], job.input.scans)
    job.write(
        stack_elastic_contacts(scans, params),
        title="elastic contacts: pressure at the preload, and pull-off beside that of rigid bodies",
    )
