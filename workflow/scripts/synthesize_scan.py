"""A substitute scan, written as a file that scan readers know."""

from hardcontact.random import generator
from hardcontact.records import dataset
from hardcontact.study.job import job
from hardcontact.surfaces.substitute_scans import synthesized_scan

with job(snakemake) as this:
    surface, number = this.parameters["surface"], this.parameters["number"]
    this.write(
        synthesized_scan(
            generator(this.parameters["seed"], surface, number, "scan"),
            dataset.read(this.input.spectrum),
            **this.parameters["scan"],
            sphere_radius=this.parameters["sphere_radius"],
        ),
        title=f"substitute scan {number} of {surface}",
        file_format="NETCDF3_64BIT",
    )
