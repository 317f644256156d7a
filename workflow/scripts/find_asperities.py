"""Which asperities carry the force of some plastic contacts on one scan, by range of adhesion."""

from hardcontact.base.job import job
from hardcontact.base.random import generator
from hardcontact.contact.asperities import SHARE, asperities_of_pair
from hardcontact.contact.contact import Contact
from hardcontact.contact.geometry import read_bodies, sampled_contacts

with job(snakemake) as this:
    given, settings = this.parameters, this.parameters["asperities"]
    surface, scan = given["surface"], given["scan"]
    contact = Contact(radius=given["radius"], **given["contact"])
    rng = generator(given["seed"], surface, scan, "contacts for asperities")
    this.write(
        asperities_of_pair(
            read_bodies(this.input.substrate, this.input.sphere, contact),
            contact,
            sampled_contacts(rng, contact.count, settings["contacts"]),
            SHARE,
            settings["ranges"],
        ),
        title=f"asperities of scan {scan} of {surface}",
    )
