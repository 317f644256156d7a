"""One contact: its gap, the adhesive pressure after plastic contact, and the force on parting."""

from hardcontact.base import published
from hardcontact.base.job import job
from hardcontact.contact.contact import Contact
from hardcontact.contact.geometry import read_bodies
from hardcontact.contact.traced_contact import traced_contact

NAMED = "surface", "scan", "sphere_scan", "contact", "label", "basis"

with job(snakemake) as this:
    given, constants = this.parameters, published.constants(this.input.published_constants).value
    contact = Contact(
        radius=given["radius"],
        range=constants["range_of_adhesion"],
        work=constants["work_of_adhesion"],
        **given["contacts"],
    )
    pair = read_bodies(this.input.substrate, this.input.sphere, contact)
    traced = traced_contact(pair, given["contact"], contact)
    named = {name: given[name] for name in NAMED}
    this.write(
        traced.assign_attrs(named),
        title=f"contact {given['contact']} on {given['label']}",
    )
