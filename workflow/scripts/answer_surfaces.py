"""The answer of a study of own surfaces: one page for people, the same numbers for machines."""

import json

import pandas as pd

from hardcontact.answer.datasets import Datasets, Setting
from hardcontact.answer.own_answer import as_plain, own_answer
from hardcontact.answer.own_page import own_page
from hardcontact.records import dataset
from hardcontact.records.job import job

with job(snakemake) as this:
    paths = {name: getattr(this.input, name, None) for name in Datasets._fields}
    given = Datasets(**{name: dataset.read(path) if path else None for name, path in paths.items()})
    pairs = pd.read_csv(this.input.pairs).to_dict("records")
    answer = own_answer(given, Setting(**this.parameters, pairs=pairs))
    numbers = json.dumps(as_plain(answer), ensure_ascii=False, allow_nan=False, indent=1)
    this.write_text(own_page(answer), "page")
    this.write_text(numbers + "\n", "json")
