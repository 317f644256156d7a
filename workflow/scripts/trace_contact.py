"""One contact: its gap, the adhesive pressure after plastic contact, and the force on parting."""

from hardcontact.base import published
from hardcontact.base.job import job
from hardcontact.contact.contact import Contact
from hardcontact.contact.geometry import read_bodies
from hardcontact.contact.traced_contact import traced_contact

ATTRIBUTES = "surface", "scan", "sphere_scan", "contact", "label", "basis"

with job(snakemake) as job:
    params = job.parameters
    constants = published.constants(job.input.published_constants)["value"]
    contact = Contact(
        radius=params["radius"],
        range=constants["range_of_adhesion"],
        work=constants["work_of_adhesion"],
        **params["contacts"],
    )
    pair = read_bodies(job.input.substrate, job.input.sphere, contact)
    traced = traced_contact(pair, params["contact"], contact)
    names = {name: params[name] for name in ATTRIBUTES}
    job.write(
        traced.assign_attrs(names),
        title=f"contact {params['contact']} on {params['label']}",
    )
