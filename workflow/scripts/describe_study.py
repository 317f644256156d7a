"""Pages of the report that are no figures."""

import json
import re
from importlib.metadata import version
from pathlib import Path

from hardcontact import dataset, log, pages

log.start(snakemake.log[0])
pinned = re.findall(r"^([\w.-]+)==", Path(snakemake.input.environment).read_text(), re.M)
for output, page in (
    ("claims", pages.claims_page(pages.read_claims(snakemake.input.claims))),
    ("departures", pages.departures_page(Path(snakemake.input.readme).read_text())),
    (
        "parameters",
        pages.parameters_page(
            json.loads(snakemake.params.canonical), {name: version(name) for name in pinned}
        ),
    ),
):
    with dataset.atomic_path(snakemake.output[output]) as path:
        Path(path).write_text(page)
dataset.record(
    snakemake.output.record,
    [snakemake.output[name] for name in ("claims", "departures", "parameters")],
    parameters=snakemake.params.canonical,
    inputs=snakemake.input,
    code=snakemake.input.code,
)
