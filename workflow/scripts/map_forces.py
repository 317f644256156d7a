"""Maps of the rigid pull-off force on every scan, and how many contacts and scans a mean needs."""

from hardcontact.insight.surface_maps import maps_of_surfaces
from hardcontact.records.job import job

with job(snakemake) as this:
    given = this.parameters
    scans = [(surface, scan) for surface, scan in given["scans"]]
    this.write(
        maps_of_surfaces(
            zip(scans, this.input.substrates, strict=True),
            given["settings"],
            given["labels"],
            given["basis"],
        ),
        title="maps of the rigid pull-off force on a smooth sphere",
    )
