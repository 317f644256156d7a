"""Each quantitative statement of the paper beside what was computed, with its verdict."""

from hardcontact.claims.evaluation import DATASETS, evaluate, read_statements
from hardcontact.records import published
from hardcontact.records.dataset import read
from hardcontact.records.job import job

with job(snakemake) as this:
    evaluated = evaluate(
        read_statements(this.input.claims),
        {name: read(this.input[name]) for name in DATASETS},
        published.constants(this.input.published_constants),
        this.parameters["confidence"],
        read(this.input.sets),
        this.parameters["seed"],
    )
    this.write_text(evaluated.to_csv(index=False, float_format="%.6g"), "claims")
    this.record("claims")
