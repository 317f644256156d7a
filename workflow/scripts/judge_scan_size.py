"""How large a scan must be: the rows of the validation table for the surfaces of the study."""

from hardcontact.base import dataset
from hardcontact.base.job import job

with job(snakemake) as job:
    params = job.parameters
    table = dataset.read(job.input.validation)
    surfaces = [name for name in table["surface"].values if name in params["surfaces"]]
    job.write(
        table.sel(surface=surfaces).assign_attrs(scan_size=params["scan_size"]),
        title="how large a scan must be, and the error of the rule that says so",
    )
