"""The page on what decides the band, part by part."""

from pathlib import Path

from hardcontact.base import published
from hardcontact.base.dataset import read
from hardcontact.base.job import job
from hardcontact.paper.evaluation import read_statements
from hardcontact.paper.verdicts import read_verdicts
from hardcontact.report.captions import caption
from hardcontact.report.figures.listing import OF_INSIGHT, describe
from hardcontact.report.insight import insight_page
from hardcontact.theory.prediction import validated_errors

with job(snakemake) as this:
    figures = {}
    for path in map(Path, this.input.figures):
        figures[path.stem] = path.read_bytes(), caption(path.stem, this.parameters)
    names = ["band", *(describe(figure).inputs[0] for figure in OF_INSIGHT)]
    claims = read_verdicts(this.input.claims)
    statements = read_statements(this.input.statements)[["id", "dataset", "quantity"]]
    page = insight_page(
        {name: read(this.input[name]) for name in names},
        figures,
        claims.merge(statements, on="id"),
        published.constants(this.input.published_constants),
        this.parameters["scan"]["pixels"],
        validated_errors(this.input.validation),
    )
    this.write_text(page, "page")
