"""The edges of the band of own surfaces, found or open, with their intervals."""

from hardcontact.base import dataset
from hardcontact.base.job import job
from hardcontact.own.master_forces import Masters
from hardcontact.own.open_edges import band_edges

with job(snakemake) as job:
    params = job.parameters
    job.write(
        band_edges(
            dataset.read(job.input.scales),
            Masters(params["scans"], params["tiles"]),
            params["tolerance"],
            params["confidence"],
        ),
        title="pull-off force against cutoff wavelength, and the edges of the band",
    )
