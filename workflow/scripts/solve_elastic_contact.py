"""Elastic contact of one pair of scans at some contacts: pressure at the preload, and pull-off."""

from hardcontact.contact.elastic import elastic_contacts_of_pair
from hardcontact.contact.geometry import read_bodies
from hardcontact.numbers.random import generator
from hardcontact.records import published
from hardcontact.records.job import job

with job(snakemake) as this:
    given, contact = this.parameters, this.parameters["contact"]
    surface, scan = given["surface"], given["scan"]
    constants = published.constants(this.input.published_constants).value
    this.write(
        elastic_contacts_of_pair(
            read_bodies(this.input.substrate, this.input.sphere, given["radius"], contact),
            contact,
            given["elastic"],
            constants["range_of_adhesion"],
            constants["work_of_adhesion"],
            generator(given["seed"], surface, scan, "elastic contacts"),
        ),
        title=f"elastic contacts of scan {scan} of {surface}",
    )
