"""The edges of the band of own surfaces, found or open, with their intervals."""

from hardcontact.base import dataset
from hardcontact.base.job import job
from hardcontact.own.master_forces import Masters
from hardcontact.own.open_edges import band_edges

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
