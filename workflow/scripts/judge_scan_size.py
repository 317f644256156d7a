"""How large a scan must be, from the validation table, beside the creases of the study's scans."""

from hardcontact.insight.scan_size import crease_shares
from hardcontact.records import dataset
from hardcontact.records.job import job

with job(snakemake) as this:
    params = this.parameters
    table = dataset.read(this.input.validation)
    asperities = dataset.read(this.input.asperities)
    creases = crease_shares(asperities, params["rho"], params["confidence"])
    this.write(
        table.merge(creases, join="inner").assign_attrs(scan_size=params["scan_size"]),
        title="how large a scan must be, and the error of the rule that says so",
    )
