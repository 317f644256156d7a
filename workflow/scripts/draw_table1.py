"""Table 1, published and computed."""

import pandas as pd

from hardcontact import dataset, log
from hardcontact.figures import style, table1

log.start(snakemake.log[0])
datasets = (
    dataset.read(snakemake.input.topography),
    pd.read_csv(snakemake.input.published),
)
style.save(
    table1.draw(*datasets),
    table1.table(*datasets),
    snakemake.output,
    title="Table 1, published and computed",
    parameters=snakemake.params.canonical,
    inputs=snakemake.input,
    code=snakemake.input.code,
)
