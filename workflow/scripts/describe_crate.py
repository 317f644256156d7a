"""The finished study as an RO-Crate."""

import json
import re
from importlib.metadata import version
from pathlib import Path

import yaml

from hardcontact import crate, dataset, log, provenance

log.start(snakemake.log[0])
pinned = re.findall(r"^([\w.-]+)==", Path(snakemake.input.environment).read_text(), re.M)
for path in snakemake.input:
    if path.endswith(".json"):
        provenance.require(path)
described = crate.describe(
    Path(snakemake.output[0]).parent,
    json.loads(snakemake.params.canonical)["study"],
    yaml.safe_load(Path(snakemake.input.citation).read_text()),
    {name: version(name) for name in pinned},
)
with dataset.atomic_path(snakemake.output[0]) as path:
    Path(path).write_text(json.dumps(described, indent=1, sort_keys=True, ensure_ascii=False))
