"""The answer of the paper's study: answer.json, the page that shows it, and the report."""

from pathlib import Path

import yaml

from hardcontact.base import published
from hardcontact.base.dataset import read
from hardcontact.paper.claims.verdicts import add_open_ends, read_verdicts
from hardcontact.records.job import run_job
from hardcontact.records.packages import read_pins
from hardcontact.report.answer import answer_text
from hardcontact.report.figures.listing import caption
from hardcontact.report.paper_study.answer import paper_answer
from hardcontact.report.paper_study.pages import figures_page, paper_page, report_pages
from hardcontact.report.paper_study.table1 import table1_rows
from hardcontact.report.templates import Frame

with run_job(snakemake) as job:
    datasets = {path.stem: read(path) for path in map(Path, job.input.datasets)}
    claims = read_verdicts(job.input.claims)
    claims = add_open_ends(claims, [datasets["edges"], datasets["sets"]])
    constants = published.read_constants(job.input.published_constants)
    citation = yaml.safe_load(Path(job.input.citation).read_text("utf-8"))
    published_table1 = published.read_table1(job.input.published_table1)
    answer = paper_answer(
        claims,
        datasets,
        constants=constants,
        table1=published_table1,
        configuration=job.parameters,
        version=citation["version"],
    )
    job.write_text(answer_text(answer), "json")
    table1 = table1_rows(datasets["topography"], published_table1)
    figures = {path.stem: path.read_bytes() for path in map(Path, job.input.figures)}
    captions = {name: caption(name, job.parameters) for name in figures}
    pages = yaml.safe_load(Path(job.input.pages).read_text("utf-8"))
    frame = Frame(answer["version"], {name: category for name, (category, _) in pages.items()})
    job.write_text(paper_page(answer, claims, figures, captions, citation, frame), "page")
    job.write_text(figures_page(answer, table1, figures, captions, frame), "figures")
    chapters = {path.stem: path.read_text("utf-8") for path in map(Path, job.input.chapters)}
    versions = read_pins(job.input.environment)
    report = report_pages(claims, answer["changed"], chapters, job.parameters, versions, frame)
    for name, page in report.items():
        job.write_text(page, name)
