"""The page of the paper's study, and its numbers for machines."""

import json
from pathlib import Path

import yaml

from hardcontact.answer.captions import caption, web_png
from hardcontact.answer.paper_answer import as_plain, paper_answer, paper_page
from hardcontact.claims.verdicts import read_verdicts
from hardcontact.records import published
from hardcontact.records.dataset import read
from hardcontact.records.job import job

DATASETS = ("topography", "scales", "band", "sets", "scan_size")

with job(snakemake) as this:
    answer = paper_answer(
        read_verdicts(this.input.claims),
        {name: read(this.input[name]) for name in DATASETS},
        published.constants(this.input.published_constants),
    )
    figures = {path.stem: web_png(path.read_bytes()) for path in map(Path, this.input.figures)}
    captions = {
        path.stem: caption(path.read_text("utf-8"), this.parameters)
        for path in map(Path, this.input.captions)
    }
    departures = Path(this.input.departures).read_text("utf-8")
    citation = yaml.safe_load(Path(this.input.citation).read_text("utf-8"))
    this.write_text(paper_page(answer, figures, captions, departures, citation), "page")
    numbers = json.dumps(as_plain(answer), ensure_ascii=False, allow_nan=False, indent=1)
    this.write_text(numbers + "\n", "json")
