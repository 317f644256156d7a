"""The answer of a study of own surfaces: one page for people, the same numbers for machines."""

import json

from hardcontact.answer.datasets import Datasets, Setting
from hardcontact.answer.own_surfaces import answer
from hardcontact.records import dataset
from hardcontact.records.job import job

with job(snakemake) as this:
    paths = {name: getattr(this.input, name, None) for name in Datasets._fields}
    made = answer(
        Datasets(**{name: dataset.read(path) if path else None for name, path in paths.items()}),
        Setting(**this.parameters),
    )
    this.write_text(made.page, "page")
    this.write_text(
        json.dumps(made.numbers, ensure_ascii=False, allow_nan=False, indent=1) + "\n", "json"
    )
    this.record("page", "json")
