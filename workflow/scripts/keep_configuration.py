"""The configuration of a study and its table of surfaces, kept with the results."""

import json
import shutil
from pathlib import Path

import yaml

from hardcontact import dataset, log

log.start(snakemake.log[0])
configuration = json.loads(snakemake.params.canonical)
with dataset.atomic_path(snakemake.output.configuration) as path:
    Path(path).write_text(yaml.safe_dump(configuration, allow_unicode=True))
with dataset.atomic_path(snakemake.output.surfaces) as path:
    shutil.copyfile(snakemake.input.surfaces, path)
dataset.record(
    snakemake.output.record,
    [snakemake.output.configuration, snakemake.output.surfaces],
    parameters=snakemake.params.canonical,
    inputs=snakemake.input,
    code=snakemake.input.code,
)
