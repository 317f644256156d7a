"""A scan, measured or substitute: levelled, the sphere subtracted if there is one; stitched."""

from hardcontact.records.job import job
from hardcontact.surfaces.scans import described, height_map, read_measurement
from hardcontact.surfaces.topography import LEVELLING, prepared_scan

with job(snakemake) as this:
    measurement = read_measurement(
        this.input.scan, this.parameters["dataset"], this.parameters["undefined_pixels"]
    )
    levelled, stitched = prepared_scan(
        height_map(measurement, this.parameters["source"]),
        this.parameters["sphere_radius"],
        LEVELLING[this.parameters["levelling"]],
        described(measurement),
    )
    this.write_arrays(levelled, "levelled scan, the sphere subtracted if it shows one", "scan")
    this.write_arrays(stitched, "scan and its mirror images, periodic", "stitched")
