"""Which asperities carry the force of some plastic contacts on one scan, by range of adhesion."""

from hardcontact.base.random import generator
from hardcontact.contact.asperities import CARRIED_SHARE, find_carrying_asperities
from hardcontact.contact.contact import Contact
from hardcontact.contact.geometry import read_bodies, sample_contacts
from hardcontact.records.job import run_job

with run_job(snakemake) as job:
    params = job.parameters
    settings = params["asperities"]
    surface = params["surface"]
    scan = params["scan"]
    contact = Contact(**params["contact"])
    rng = generator(params["seed"], surface, scan, "contacts for asperities")
    job.write(
        find_carrying_asperities(
            read_bodies(job.input.substrate, job.input.sphere, contact),
            contact,
            sample_contacts(rng, contact.contacts_per_row, settings["contacts"]),
            CARRIED_SHARE,
            settings["ranges"],
        ),
        title=f"asperities of scan {scan} of {surface}",
    )
