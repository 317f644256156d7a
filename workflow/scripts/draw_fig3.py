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
    snakemake.output.pdf,
    snakemake.output.png,
    snakemake.output.csv,
    {"Title": "distributions of pull-off forces"},
)
