"""Mean pull-off forces of the study's scans of one substrate on a smooth sphere."""

from hardcontact.contact.contact import Contact
from hardcontact.records.job import job
from hardcontact.sets.pool import on_smooth_sphere
from hardcontact.surfaces.height_map import read_height_map

with job(snakemake) as this:
    given = this.parameters
    scans = zip(given["scans"], this.input.scans, strict=True)
    this.write(
        on_smooth_sphere(
            {number: read_height_map(path) for number, path in scans},
            Contact(radius=given["radius"], **given["contact"]),
            given["ranges"],
        ),
        title=f"mean pull-off forces of scans of {given['surface']} on a smooth sphere",
    )
