"""Repeated contact of one pair of scans: a place of the sphere meets all places of the array."""

from hardcontact.contact.geometry import read_bodies
from hardcontact.insight.repeated_contact import Adhesion, repeated_contact_of_pair
from hardcontact.numbers.random import generator
from hardcontact.records import published
from hardcontact.records.job import job

with job(snakemake) as this:
    given, contact = this.parameters, this.parameters["contact"]
    surface, scan = given["surface"], given["scan"]
    constants = published.constants(this.input.published_constants).value
    this.write(
        repeated_contact_of_pair(
            read_bodies(this.input.substrate, this.input.sphere, given["radius"], contact),
            {"preload": contact["preload"], "hardness": contact["hardness"]},
            Adhesion(constants["range_of_adhesion"], constants["work_of_adhesion"]),
            generator(given["seed"], surface, scan, contact["preload"], "repeated contact"),
            given["orders"],
        ),
        title=f"repeated contact on scan {scan} of {surface}",
    )
