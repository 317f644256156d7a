"""Substitute scans that are conditioned together: as files that scan readers know, and prepared."""

from hardcontact.base import dataset
from hardcontact.base.job import job
from hardcontact.base.random import generator
from hardcontact.surfaces.conditioning import amplified
from hardcontact.surfaces.scans import LEVELLED, STITCHED, prepared, read_measurement
from hardcontact.surfaces.spectrum import read_spectrum
from hardcontact.surfaces.substitute_scans import ScanGrid, synthesized_scan

with job(snakemake) as this:
    given, surface, scans = this.parameters, this.parameters["surface"], this.parameters["scans"]
    conditioning = dataset.read(this.input.conditioning)
    density = amplified(read_spectrum(this.input.spectrum), conditioning["gain"].values)
    for place, number in enumerate(scans):
        # Substitutes of all scans come first among the outputs, then levelled and stitched ones.
        substitute, levelled, stitched = (place + kind * len(scans) for kind in range(3))
        this.write(
            synthesized_scan(
                generator(given["seed"], surface, number, "scan"),
                density,
                ScanGrid(**given["scan"]),
                float(conditioning["factor"].sel(scan=number)),
                sphere_radius=given["sphere_radius"],
                skewness=given["skewness"],
            ),
            title=f"substitute scan {number} of {surface}",
            output=substitute,
            file_format="NETCDF3_64BIT",
        )
        flat, periodic = prepared(
            read_measurement(this.output[substitute]), "substitute", given["sphere_radius"]
        )
        this.write(flat, LEVELLED, levelled)
        this.write(periodic, STITCHED, stitched)
