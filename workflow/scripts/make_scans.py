"""Substitute scans that are conditioned together: as files that scan readers know, and prepared."""

from hardcontact.numbers.random import generator
from hardcontact.records import dataset
from hardcontact.records.job import job
from hardcontact.surfaces.conditioning import conditioned_density
from hardcontact.surfaces.prepared_scans import LEVELLED, STITCHED, prepared_file
from hardcontact.surfaces.substitute_scans import HeightChoices, ScanGrid, synthesized_scan

with job(snakemake) as this:
    given, surface, scans = this.parameters, this.parameters["surface"], this.parameters["scans"]
    conditioning = dataset.read(this.input.conditioning)
    density = conditioned_density(dataset.read(this.input.spectrum), conditioning)
    for place, number in enumerate(scans):
        # Substitutes of all scans come first among the outputs, then levelled and stitched ones.
        substitute, levelled, stitched = (place + kind * len(scans) for kind in range(3))
        this.write(
            synthesized_scan(
                generator(given["seed"], surface, number, "scan"),
                density,
                ScanGrid(**given["scan"]),
                float(conditioning["factor"].sel(scan=number)),
                given["sphere_radius"],
                HeightChoices(given["skewness"], given["tip_radius"]),
            ),
            title=f"substitute scan {number} of {surface}",
            output=substitute,
            file_format="NETCDF3_64BIT",
        )
        flat, periodic = prepared_file(
            this.output[substitute], basis="substitute", sphere_radius=given["sphere_radius"]
        )
        this.write(flat, LEVELLED, levelled)
        this.write(periodic, STITCHED, stitched)
