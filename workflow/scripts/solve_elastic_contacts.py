"""Elastic contact of one pair of scans at some contacts: pressure at the preload, and pull-off."""

from hardcontact.base import published
from hardcontact.base.random import generator
from hardcontact.contact.contact import Contact
from hardcontact.contact.elastic import PULL_OFF_WINDOW, solve_elastic_contacts
from hardcontact.contact.geometry import read_bodies, sample_contacts
from hardcontact.records.job import run_job

with run_job(snakemake) as job:
    params = job.parameters
    surface = params["surface"]
    scan = params["scan"]
    constants = published.read_constants(job.input.published_constants)["value"]
    contact = Contact(
        rho=constants["range_of_adhesion"],
        work=constants["work_of_adhesion"],
        **params["contact"],
    )
    rng = generator(params["seed"], surface, scan, "elastic contacts")
    job.write(
        solve_elastic_contacts(
            read_bodies(job.input.substrate, job.input.sphere, contact),
            contact,
            sample_contacts(rng, contact.contacts_per_row, params["contacts"]),
            published.effective_modulus(constants),
            PULL_OFF_WINDOW,
        ),
        title=f"elastic contacts of scan {scan} of {surface}",
    )
