"""Pages of the report that are no figures."""

from pathlib import Path

from hardcontact.base.dataset import read
from hardcontact.base.job import job
from hardcontact.base.origin import pinned_versions
from hardcontact.paper.verdicts import read_verdicts, with_open_ends
from hardcontact.report.report_pages import pages

with job(snakemake) as this:
    chapters = [Path(path) for path in this.input if path.endswith(".md")]
    bands = [read(this.input.band), read(this.input.sets)]
    made = pages(
        with_open_ends(read_verdicts(this.input.claims), bands),
        {path.stem: path.read_text("utf-8") for path in chapters},
        this.parameters,
        pinned_versions(this.input.environment),
    )
    for name, page in made.items():
        this.write_text(page, name)
