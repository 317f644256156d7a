"""Results under other assumptions."""

from hardcontact import dataset, log
from hardcontact.figures import fig_robustness, style

log.start(snakemake.log[0])
datasets = (
    dataset.read(snakemake.input.robustness),
    dataset.read(snakemake.input.inference),
)
style.save(
    fig_robustness.draw(*datasets),
    fig_robustness.table(*datasets),
    snakemake.output,
    title="results under other assumptions",
    parameters=snakemake.params.canonical,
    inputs=snakemake.input,
    code=snakemake.input.code,
)
