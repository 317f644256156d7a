"""The answer of a study of own surfaces: one page for people, the same numbers for machines."""

import pandas as pd

from hardcontact.base import dataset
from hardcontact.base.job import job
from hardcontact.report.datasets import Datasets, Setting
from hardcontact.report.figures.listing import FILE_KINDS
from hardcontact.report.figures.own_figures import write_figures
from hardcontact.report.own_answer import (
    own_answer,
    own_head,
    own_headline,
    own_page,
    own_quantities,
    own_warnings,
)
from hardcontact.report.quantities import answer_json

with job(snakemake) as job:
    paths = {name: getattr(job.input, name, None) for name in Datasets._fields}
    datasets = Datasets(
        **{name: dataset.read(path) if path else None for name, path in paths.items()}
    )
    pairs = pd.read_csv(job.input.pairs).to_dict("records")
    setting = Setting(**job.parameters, pairs=pairs)
    answer = own_answer(datasets, setting)
    headline = own_headline(answer)
    warnings = own_warnings(answer)
    pictures = write_figures(datasets, {kind: job.output[kind] for kind in FILE_KINDS})
    job.write_text(own_page(answer, headline, warnings, pictures), "page")
    head = own_head(setting, [*headline, *warnings])
    job.write_text(answer_json(head, own_quantities(answer, setting.of_paper)), "json")
