"""Range and work of adhesion."""

from hardcontact import dataset, log
from hardcontact.figures import fig4, style

log.start(snakemake.log[0])
datasets = (
    dataset.read(snakemake.input.contact),
    dataset.read(snakemake.input.inference),
)
style.save(
    fig4.draw(*datasets),
    fig4.table(*datasets),
    snakemake.output,
    title="range and work of adhesion",
    parameters=snakemake.params.canonical,
    inputs=snakemake.input,
    code=snakemake.input.code,
)
