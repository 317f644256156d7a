"""A scan, measured or substitute: the plane removed, and the sphere if there is one; stitched."""

from hardcontact.study.job import job
from hardcontact.surfaces.scans import read_scan
from hardcontact.surfaces.topography import prepared_scan

with job(snakemake) as this:
    levelled, stitched = prepared_scan(
        read_scan(
            this.input.scan,
            this.parameters["dataset"],
            this.parameters["undefined_pixels"],
            this.parameters["source"],
        ),
        this.parameters["sphere_radius"],
    )
    this.write_arrays(levelled, "levelled scan, the sphere subtracted if it shows one", "scan")
    this.write_arrays(stitched, "scan and its mirror images, periodic", "stitched")
