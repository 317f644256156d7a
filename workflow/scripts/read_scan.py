"""A measured scan as its file has it, in nm: a map on square pixels, or a line scan."""

from hardcontact.base.job import job
from hardcontact.surfaces.scans import read_measurement

with job(snakemake) as this:
    this.write(
        read_measurement(this.input.scan, **this.parameters).stored(),
        title="heights of a measured scan, as read",
    )
