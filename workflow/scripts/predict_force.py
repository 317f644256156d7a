"""The pull-off forces that a work and a range of adhesion predict."""

from hardcontact.insight.closed_form import Contact, contact_area
from hardcontact.own_surfaces.master_forces import Masters
from hardcontact.own_surfaces.predicted_force import own_force
from hardcontact.records import dataset
from hardcontact.records.job import job

with job(snakemake) as this:
    params = this.parameters
    area = contact_area(params["contact"]["preload"], params["contact"]["hardness"])
    this.write(
        own_force(
            dataset.read(this.input.adhesion),
            dataset.read(this.input.scales),
            dataset.read(this.input.topography),
            dataset.read(this.input.spectra),
            contact=Contact(params["radius"], params["rho"], params["work"], area),
            masters=Masters(params["scans"], params["tiles"]),
            window=params["contact"]["window"],
            tolerance=params["tolerance"],
            confidence=params["confidence"],
        ),
        title="predicted pull-off forces",
    )
