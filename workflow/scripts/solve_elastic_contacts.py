"""Elastic contact of some contacts on one surface: pressure at the preload, and pull-off."""

from hardcontact.base import published
from hardcontact.base.arrays import generator
from hardcontact.contact.contact import Contact
from hardcontact.contact.elastic import solve_elastic_contacts, stack_elastic_contacts
from hardcontact.contact.geometry import read_bodies, sample_contacts
from hardcontact.records.job import run_job

with run_job(snakemake) as job:
    params = job.parameters
    surface = params["surface"]
    constants = published.read_constants(job.input.published_constants)["value"]
    contact = Contact(
        rho=constants["range_of_adhesion"], work=constants["work_of_adhesion"], **params["contact"]
    )
    scans_and_paths = zip(params["scans"], job.input.substrates, job.input.spheres, strict=True)
    contacts = {}
    for scan, *paths in scans_and_paths:
        rng = generator(params["seed"], surface, scan, "elastic contacts")
        contacts[(scan,)] = solve_elastic_contacts(
            read_bodies(*paths, contact),
            contact,
            sample_contacts(rng, contact.contacts_per_row, params["contacts"]),
            published.effective_modulus(constants),
        )
    job.write(stack_elastic_contacts(contacts), title=f"elastic contacts of {surface}")
