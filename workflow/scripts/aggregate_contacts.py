"""Asperities that carry the force, of all surfaces and scans."""

from hardcontact.base.dataset import read_all, stack
from hardcontact.contact.stacked_datasets import add_names
from hardcontact.records.job import run_job

with run_job(snakemake) as job:
    params = job.parameters
    scans = read_all(params["scan_keys"], job.input.scans)
    job.write(
        add_names(stack(scans, ["surface", "scan"]), params),
        title="asperities that carry the pull-off force of plastic contacts",
    )
