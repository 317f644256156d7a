"""A measured scan: levelled, the sphere subtracted if there is one; stitched."""

from hardcontact.base.job import job
from hardcontact.surfaces.scans import LEVELLED, STITCHED, prepared, read_stored

with job(snakemake) as this:
    levelled, stitched = prepared(
        read_stored(this.input.measurement), "measured", **this.parameters
    )
    this.write(levelled, LEVELLED, "scan")
    this.write(stitched, STITCHED, "stitched")
