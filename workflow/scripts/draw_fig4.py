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
    snakemake.output.pdf,
    snakemake.output.png,
    snakemake.output.csv,
    {"Title": "range and work of adhesion"},
)
