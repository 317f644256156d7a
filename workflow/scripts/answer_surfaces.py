"""The answer of a study of the user's surfaces: answer.json, and the page that shows it."""

from pathlib import Path

import pandas as pd
import yaml

from hardcontact.base.dataset import read
from hardcontact.records.job import run_job
from hardcontact.report.answer import answer_text
from hardcontact.report.figures.listing import FILE_KINDS
from hardcontact.report.own_surfaces.answer import own_answer, own_page
from hardcontact.report.own_surfaces.datasets import Datasets, Setting
from hardcontact.report.own_surfaces.figures import write_figures
from hardcontact.report.templates import Frame

with run_job(snakemake) as job:
    paths = {name: getattr(job.input, name, None) for name in Datasets._fields}
    datasets = Datasets(**{name: read(path) if path else None for name, path in paths.items()})
    pairs = pd.read_csv(job.input.pairs).to_dict("records")
    setting = Setting(**job.parameters, pairs=pairs)
    answer = own_answer(datasets, setting)
    job.write_text(answer_text(answer), "json")
    figures = write_figures(datasets, {kind: job.output[kind] for kind in FILE_KINDS})
    frame = Frame(answer["version"])
    citation = yaml.safe_load(Path(job.input.citation).read_text("utf-8"))
    job.write_text(own_page(answer, figures, citation, frame), "page")
