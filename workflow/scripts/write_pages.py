"""The pages of the report: verdicts, chapters, parameters."""

from pathlib import Path

from hardcontact.base.dataset import read
from hardcontact.base.job import job
from hardcontact.base.origin import pinned_versions
from hardcontact.paper.verdicts import add_open_ends, read_verdicts
from hardcontact.report.report_pages import pages

with job(snakemake) as job:
    params = job.parameters
    chapters = [Path(path) for path in job.input if path.endswith(".md")]
    datasets_with_edges = [read(job.input.edges), read(job.input.sets)]
    page_texts = pages(
        add_open_ends(read_verdicts(job.input.claims), datasets_with_edges),
        {path.stem: path.read_text("utf-8") for path in chapters},
        params,
        pinned_versions(job.input.environment),
    )
    for name, page in page_texts.items():
        job.write_text(page, name)
