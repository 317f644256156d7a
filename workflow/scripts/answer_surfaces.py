"""The answer of a study of your surfaces: answer.json, and the page that shows it."""

import pandas as pd

from hardcontact.base.dataset import read_dataset
from hardcontact.config.user_files import read_yaml
from hardcontact.records.job import run_job
from hardcontact.report.figures.listing import FIGURE_SUFFIXES
from hardcontact.report.own_surfaces.answer import LIMITS, own_answer
from hardcontact.report.own_surfaces.datasets import Datasets, Setting
from hardcontact.report.own_surfaces.figures import write_figures
from hardcontact.report.quantities import answer_text
from hardcontact.report.templates import Frame, render_page

with run_job(snakemake) as job:
    paths = {name: job.input[name] for name in Datasets._fields}
    datasets = Datasets(
        **{name: read_dataset(path) if path else None for name, path in paths.items()}
    )
    setting = Setting(**job.parameters, pairs=pd.read_csv(job.input.pairs).to_dict("records"))
    answer = own_answer(datasets, setting)
    job.write_text(answer_text(answer), "json")
    figures = write_figures(datasets, {suffix: job.output[suffix] for suffix in FIGURE_SUFFIXES})
    citation = read_yaml(job.input.citation)
    frame = Frame(answer["version"])
    job.write_text(render_page(answer, figures, citation, frame, **LIMITS), "page")
