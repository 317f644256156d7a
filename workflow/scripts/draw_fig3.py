"""Distributions of pull-off forces."""

from hardcontact import dataset, log
from hardcontact.figures import fig3, style

log.start(snakemake.log[0])
datasets = (
    dataset.read(snakemake.input.adhesion),
    dataset.read(snakemake.input.inference),
)
style.save(
    fig3.draw(*datasets),
    fig3.table(*datasets),
    snakemake.output,
    title="distributions of pull-off forces",
    parameters=snakemake.params.canonical,
    inputs=snakemake.input,
    code=snakemake.input.code,
)
