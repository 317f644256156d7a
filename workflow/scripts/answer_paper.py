"""The page of the paper's study, and its numbers for machines."""

from pathlib import Path

import yaml

from hardcontact.base import published
from hardcontact.base.dataset import read
from hardcontact.base.job import job
from hardcontact.paper.verdicts import read_verdicts
from hardcontact.report.figures.listing import caption
from hardcontact.report.paper_answer import paper_answer, paper_quantities
from hardcontact.report.paper_page import paper_head, paper_page
from hardcontact.report.quantities import answer_json

DATASETS = (
    "topography", "scales", "band", "sets", "leave_one_out", "protruded", "protruded_sphere",
    "scan_size",
)  # fmt: skip

with job(snakemake) as job:
    answer = paper_answer(
        read_verdicts(job.input.claims),
        {name: read(job.input[name]) for name in DATASETS},
        published.constants(job.input.published_constants),
        published.table1(job.input.published_table1),
    )
    figures = {path.stem: path.read_bytes() for path in map(Path, job.input.figures)}
    captions = {name: caption(name, job.parameters) for name in figures}
    citation = yaml.safe_load(Path(job.input.citation).read_text("utf-8"))
    head = paper_head(answer, job.parameters, citation["version"])
    job.write_text(paper_page(answer, head, figures, captions, citation), "page")
    job.write_text(answer_json(head, paper_quantities(answer)), "json")
