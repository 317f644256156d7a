"""Scans of the substrates and the sphere."""

from hardcontact import dataset, log
from hardcontact.figures import fig1, style

log.start(snakemake.log[0])
datasets = (dataset.read(snakemake.input.topography),)
style.save(
    fig1.draw(*datasets),
    fig1.table(*datasets),
    snakemake.output.pdf,
    snakemake.output.png,
    snakemake.output.csv,
    {"Title": "scans of the substrates and the sphere"},
)
