"""Plastic pull-off at every contact of a master, whole and filtered at every cutoff."""

from hardcontact.contact.contact import Contact
from hardcontact.records.job import job
from hardcontact.scales.filtered_masters import Filters, filtered_pull_off
from hardcontact.surfaces.height_map import read_height_map

with job(snakemake) as this:
    given = this.parameters
    contact = Contact(radius=given["radius"], range=given["rho"], **given["contact"])
    sphere = read_height_map(this.input.sphere) if this.input.sphere else None
    this.write(
        filtered_pull_off(
            read_height_map(this.input.master),
            Filters(given["side"], **given["scales"]),
            [contact],
            sphere,
        ),
        title=f"plastic pull-off of a {given['side']}-scale master at all cutoffs",
    )
