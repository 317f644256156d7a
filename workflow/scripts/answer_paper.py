"""The page of the paper's study, and its numbers for machines."""

from pathlib import Path

import yaml

from hardcontact.base import published
from hardcontact.base.dataset import read
from hardcontact.base.job import job
from hardcontact.paper.verdicts import read_verdicts
from hardcontact.report.captions import caption
from hardcontact.report.paper_answer import (
    paper_answer,
    paper_head,
    paper_page,
    paper_quantities,
)
from hardcontact.report.quantities import answer_json

DATASETS = ("topography", "scales", "band", "sets", "leave_one_out", "protruded", "scan_size")

with job(snakemake) as this:
    answer = paper_answer(
        read_verdicts(this.input.claims),
        {name: read(this.input[name]) for name in DATASETS},
        published.constants(this.input.published_constants),
        published.table1(this.input.published_table1),
    )
    figures = {path.stem: path.read_bytes() for path in map(Path, this.input.figures)}
    captions = {name: caption(name, this.parameters) for name in figures}
    citation = yaml.safe_load(Path(this.input.citation).read_text("utf-8"))
    this.write_text(paper_page(answer, figures, captions, citation), "page")
    head = paper_head(this.parameters, citation["version"])
    this.write_text(answer_json(head, paper_quantities(answer)), "json")
