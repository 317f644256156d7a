"""Pull-off force without some scales of roughness."""

from hardcontact import dataset, log
from hardcontact.figures import fig6, style

log.start(snakemake.log[0])
datasets = (
    dataset.read(snakemake.input.inference),
    dataset.read(snakemake.input.scales),
)
style.save(
    fig6.draw(*datasets),
    fig6.table(*datasets),
    snakemake.output,
    title="pull-off force without some scales of roughness",
    parameters=snakemake.params.canonical,
    inputs=snakemake.input,
    code=snakemake.input.code,
)
