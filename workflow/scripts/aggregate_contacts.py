"""Single contacts on all surfaces: elastic contacts, or asperities that carry plastic contacts."""

from hardcontact.base.dataset import add_surface_names, read_by_key, stack
from hardcontact.records.job import run_job

with run_job(snakemake) as job:
    params = job.parameters
    keys = [(surface,) for surface in params["surfaces"]]
    contacts = stack(read_by_key(keys, job.input.surfaces), ["surface"])
    job.write(add_surface_names(contacts, params), title=params["title"])
