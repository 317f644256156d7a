"""The answer of the paper's study: answer.json, the page that shows it, and the report."""

from pathlib import Path

from hardcontact.base import published
from hardcontact.base.dataset import read_dataset
from hardcontact.config.user_files import read_yaml
from hardcontact.paper.claims.verdicts import read_judged_claims
from hardcontact.records.code import read_pins
from hardcontact.records.job import run_job
from hardcontact.report.figures.listing import render_description
from hardcontact.report.paper_study.answer import paper_answer
from hardcontact.report.paper_study.pages import figures_page, paper_page, report_pages
from hardcontact.report.paper_study.tables import table1_rows
from hardcontact.report.quantities import answer_text
from hardcontact.report.templates import Frame

with run_job(snakemake) as job:
    configuration = job.parameters
    datasets = {Path(path).stem: read_dataset(path) for path in job.input.datasets}
    figures = {Path(path).stem: Path(path).read_bytes() for path in job.input.figures}
    chapters = {Path(path).stem: Path(path).read_text("utf-8") for path in job.input.chapters}
    captions = {name: render_description(name, configuration) for name in figures}
    citation = read_yaml(job.input.citation)
    table1 = published.read_table1(job.input.published_table1)
    claims = read_judged_claims(job.input.claims)

    answer = paper_answer(
        claims,
        datasets,
        constants=published.read_constants(job.input.published_constants),
        table1=table1,
        configuration=configuration,
        version=citation["version"],
    )
    job.write_text(answer_text(answer), "json")

    pages = read_yaml(job.input.pages)
    frame = Frame(answer["version"], {name: category for name, (category, _) in pages.items()})
    job.write_text(paper_page(answer, claims, figures, captions, citation, frame), "page")
    printed_table1 = table1_rows(datasets["topography"], table1)
    job.write_text(figures_page(answer, printed_table1, figures, captions, frame), "figures")
    versions = read_pins(job.input.environment)
    report = report_pages(claims, answer["changed"], chapters, configuration, versions, frame)
    for name, page in report.items():
        job.write_text(page, name)
