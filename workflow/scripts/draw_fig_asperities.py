"""Patches that carry the pull-off force."""

from hardcontact import dataset, log
from hardcontact.figures import fig_asperities, style

log.start(snakemake.log[0])
datasets = (
    dataset.read(snakemake.input.asperities),
    dataset.read(snakemake.input.inference),
)
style.save(
    fig_asperities.draw(*datasets),
    fig_asperities.table(*datasets),
    snakemake.output,
    title="patches that carry the pull-off force",
    parameters=snakemake.params.canonical,
    inputs=snakemake.input,
    code=snakemake.input.code,
)
