"""A substitute scan, written as a file that scan readers know."""

from hardcontact.numbers.random import generator
from hardcontact.records import dataset
from hardcontact.records.job import job
from hardcontact.surfaces.conditioning import conditioned_density
from hardcontact.surfaces.substitute_scans import HeightChoices, ScanGrid, synthesized_scan

with job(snakemake) as this:
    surface, number = this.parameters["surface"], this.parameters["number"]
    conditioning = dataset.read(this.input.conditioning)
    this.write(
        synthesized_scan(
            generator(this.parameters["seed"], surface, number, "scan"),
            conditioned_density(dataset.read(this.input.spectrum), conditioning),
            ScanGrid(**this.parameters["scan"]),
            float(conditioning["factor"].sel(scan=number)),
            this.parameters["sphere_radius"],
            HeightChoices(this.parameters["skewness"], this.parameters["tip_radius"]),
        ),
        title=f"substitute scan {number} of {surface}",
        file_format="NETCDF3_64BIT",
    )
