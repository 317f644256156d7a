"""Which asperities carry the force of some plastic contacts on one scan, by range of adhesion."""

from hardcontact.contact.asperities import asperities_of_pair
from hardcontact.contact.geometry import read_bodies
from hardcontact.numbers.random import generator
from hardcontact.records.job import job

with job(snakemake) as this:
    given, contact = this.parameters, this.parameters["contact"]
    surface, scan = given["surface"], given["scan"]
    this.write(
        asperities_of_pair(
            read_bodies(this.input.substrate, this.input.sphere, given["radius"], contact),
            contact,
            given["asperities"],
            generator(given["seed"], surface, scan, "contacts for asperities"),
        ),
        title=f"asperities of scan {scan} of {surface}",
    )
