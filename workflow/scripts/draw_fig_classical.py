"""Classical models of rough adhesion and the effective work of adhesion."""

from hardcontact import dataset, log
from hardcontact.figures import fig_classical, style

log.start(snakemake.log[0])
datasets = (dataset.read(snakemake.input.classical),)
style.save(
    fig_classical.draw(*datasets),
    fig_classical.table(*datasets),
    snakemake.output,
    title="classical models of rough adhesion",
    parameters=snakemake.params.canonical,
    inputs=snakemake.input,
    code=snakemake.input.code,
)
