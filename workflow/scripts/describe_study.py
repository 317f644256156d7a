"""Pages of the report that are no figures."""

from pathlib import Path

from hardcontact.answer.report_pages import pages
from hardcontact.claims.verdicts import read_verdicts, with_open_ends
from hardcontact.records.dataset import read
from hardcontact.records.job import job
from hardcontact.records.origin import pinned_versions

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
