"""The edges of the band of own surfaces, found or open, with their intervals."""

from hardcontact.own_surfaces.master_forces import Masters
from hardcontact.own_surfaces.open_edges import band_edges
from hardcontact.records import dataset
from hardcontact.records.job import job

with job(snakemake) as this:
    given = this.parameters
    this.write(
        band_edges(
            dataset.read(this.input.scales),
            Masters(given["scans"], given["tiles"]),
            given["tolerance"],
            given["confidence"],
        ),
        title="pull-off force against cutoff wavelength, and the edges of the band",
    )
