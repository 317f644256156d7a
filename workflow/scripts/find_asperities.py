"""Which asperities carry the force of some plastic contacts on a surface, by range of adhesion."""

from hardcontact.base.arrays import generator
from hardcontact.base.dataset import stack
from hardcontact.contact.attraction import find_carrying_asperities
from hardcontact.contact.contact import Contact
from hardcontact.contact.geometry import read_bodies, sample_contacts
from hardcontact.records.job import run_job

with run_job(snakemake) as job:
    params = job.parameters
    settings = params["asperities"]
    surface = params["surface"]
    contact = Contact(**params["contact"])
    scans_and_paths = zip(params["scans"], job.input.substrates, job.input.spheres, strict=True)
    asperities = {}
    for scan, *paths in scans_and_paths:
        rng = generator(params["seed"], surface, scan, "contacts for asperities")
        asperities[(scan,)] = find_carrying_asperities(
            read_bodies(*paths, contact),
            contact,
            sample_contacts(rng, contact.contacts_per_row, settings["contacts"]),
            settings["ranges"],
        )
    job.write(stack(asperities, ["scan"]), title=f"asperities of {surface}")
