"""Elastic contact beside hardness and rigid contact."""

from hardcontact import dataset, log
from hardcontact.figures import fig_elastic, style

log.start(snakemake.log[0])
datasets = (dataset.read(snakemake.input.elastic),)
style.save(
    fig_elastic.draw(*datasets),
    fig_elastic.table(*datasets),
    snakemake.output,
    title="elastic contact beside hardness and rigid contact",
    parameters=snakemake.params.canonical,
    inputs=snakemake.input,
    code=snakemake.input.code,
)
