"""A measured scan in nm, not levelled: the central square of a map, or a line scan."""

from hardcontact.records.job import run_job
from hardcontact.scans.reading import read_scan

with run_job(snakemake) as job:
    scan = read_scan(job.input.scan, **job.parameters)
    job.write(scan.to_dataset(), title="heights of a measured scan, as read")
