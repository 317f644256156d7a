"""Single contacts on all surfaces: elastic contacts, or asperities that carry plastic contacts."""

from hardcontact.base.dataset import add_labels_and_sources, read_by_key, stack
from hardcontact.records.job import run_job

with run_job(snakemake) as job:
    params = job.parameters
    contacts = read_by_key(((surface,) for surface in params["surfaces"]), job.input.surfaces)
    job.write(add_labels_and_sources(stack(contacts, ["surface"]), params), title=params["title"])
