"""Scans of the substrates and the sphere."""

from hardcontact import dataset, log
from hardcontact.figures import fig1, style

log.start(snakemake.log[0])
datasets = (dataset.read(snakemake.input.topography),)
style.save(
    fig1.draw(*datasets),
    fig1.table(*datasets),
    snakemake.output,
    title="scans of the substrates and the sphere",
    parameters=snakemake.params.canonical,
    inputs=snakemake.input,
    code=snakemake.input.code,
)
