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
    snakemake.output.pdf,
    snakemake.output.png,
    snakemake.output.csv,
    {"Title": "results under other assumptions"},
)
