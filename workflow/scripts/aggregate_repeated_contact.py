"""Repeated contact on all surfaces: force and indents against the number of contacts."""

from hardcontact.insight.repeated_contact import repeated_contact
from hardcontact.records import published
from hardcontact.records.dataset import read_all
from hardcontact.records.job import job

IMAGED = {"depth": "measured_indent_depth", "lateral_size": "measured_indent_size"}

with job(snakemake) as this:
    given = this.parameters
    constants = published.constants(this.input.published_constants).value
    image = {
        f"published_{name}": [
            float(constants[f"{imaged}_{end}_bound"]) for end in ("lower", "upper")
        ]
        for name, imaged in IMAGED.items()
    }
    found = repeated_contact(read_all(given["pairs"], this.input.pairs), given, given["confidence"])
    this.write(
        found.assign_attrs(image),
        title="force and indents of repeated contact against the number of contacts",
    )
