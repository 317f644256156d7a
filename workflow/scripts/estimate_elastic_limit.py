"""Plasticity index, elastic area and force of every contact of one pair of scans."""

from hardcontact.contact.contact import Contact
from hardcontact.contact.geometry import read_bodies
from hardcontact.contact.smooth_sphere import effective_modulus
from hardcontact.insight.elastic_limit import elastic_limit_of_pair
from hardcontact.records import published
from hardcontact.records.job import job

with job(snakemake) as this:
    given = this.parameters
    contact = Contact(radius=given["radius"], **given["contact"])
    constants = published.constants(this.input.published_constants).value
    this.write(
        elastic_limit_of_pair(
            read_bodies(this.input.substrate, this.input.sphere, contact),
            contact,
            effective_modulus(given["elastic"]["sphere"], given["elastic"]["substrate"]),
            constants["range_of_adhesion"],
            constants["work_of_adhesion"],
        ),
        title=f"contacts of scan {given['scan']} of {given['surface']}, elastic or plastic",
    )
