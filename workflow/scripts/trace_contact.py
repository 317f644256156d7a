"""One contact: its gap, the adhesive pressure after plastic contact, and the force on parting."""

from hardcontact.base import published
from hardcontact.contact.attraction import trace_contact
from hardcontact.contact.contact import Contact
from hardcontact.contact.geometry import read_bodies
from hardcontact.records.job import run_job

ATTRIBUTES = "surface", "scan", "sphere_scan", "label", "source"

with run_job(snakemake) as job:
    params = job.parameters
    constants = published.read_constants(job.input.published_constants)["value"]
    contact = Contact(
        rho=constants["range_of_adhesion"], work=constants["work_of_adhesion"], **params["contact"]
    )
    contact_index = params["contact_index"]
    bodies = read_bodies(job.input.substrate, job.input.sphere, contact)
    trace = trace_contact(bodies, contact_index, contact)
    trace.attrs |= {name: params[name] for name in ATTRIBUTES} | {"contact": contact_index}
    job.write(trace, title=f"contact {contact_index} on {params['label']}")
