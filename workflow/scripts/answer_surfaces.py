"""The answer of a study of own surfaces: one page for people, the same numbers for machines."""

import json

from hardcontact.answer.datasets import Datasets, Setting
from hardcontact.answer.numbers import answer_numbers
from hardcontact.answer.own_surfaces import own_page
from hardcontact.records import dataset
from hardcontact.records.job import job

with job(snakemake) as this:
    paths = {name: getattr(this.input, name, None) for name in Datasets._fields}
    given = Datasets(**{name: dataset.read(path) if path else None for name, path in paths.items()})
    setting = Setting(**this.parameters)
    numbers = answer_numbers(given, setting)
    this.write_text(own_page(given, setting), "page")
    this.write_text(
        json.dumps(numbers, ensure_ascii=False, allow_nan=False, indent=1) + "\n", "json"
    )
    this.record("page", "json")
