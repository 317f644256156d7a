"""Indents in the sphere."""

from hardcontact import dataset, log
from hardcontact.figures import fig5, style

log.start(snakemake.log[0])
datasets = (dataset.read(snakemake.input.indent),)
style.save(
    fig5.draw(*datasets),
    fig5.table(*datasets),
    snakemake.output,
    title="indents in the sphere",
    parameters=snakemake.params.canonical,
    inputs=snakemake.input,
    code=snakemake.input.code,
)
