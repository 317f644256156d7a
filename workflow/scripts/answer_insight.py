"""The page on the causes of the critical band, part by part."""

from pathlib import Path

from hardcontact.base import published
from hardcontact.base.dataset import read
from hardcontact.base.job import job
from hardcontact.paper.evaluation import read_statements
from hardcontact.paper.verdicts import read_verdicts
from hardcontact.report.figures.listing import INSIGHT_FIGURES, caption, describe_figure
from hardcontact.report.insight import insight_page
from hardcontact.theory.prediction_errors import validated_errors

with job(snakemake) as job:
    figures = {}
    for path in map(Path, job.input.figures):
        figures[path.stem] = path.read_bytes(), caption(path.stem, job.parameters)
    names = ["edges", *(describe_figure(figure).inputs[0] for figure in INSIGHT_FIGURES)]
    claims = read_verdicts(job.input.claims)
    statements = read_statements(job.input.statements)[["id", "dataset", "quantity"]]
    page = insight_page(
        {name: read(job.input[name]) for name in names},
        figures,
        claims.merge(statements, on="id"),
        published.constants(job.input.published_constants),
        job.parameters["scan"]["pixels"],
        validated_errors(job.input.validation),
    )
    job.write_text(page, "page")
