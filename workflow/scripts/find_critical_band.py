"""The wavelengths whose removal changes the pull-off force, with their intervals."""

from hardcontact.adhesion.bootstrap import Bootstrap
from hardcontact.adhesion.critical_band import find_critical_band
from hardcontact.records import dataset
from hardcontact.study.job import job

with job(snakemake) as this:
    given = this.parameters
    this.write(
        find_critical_band(
            dataset.read(this.input.scales),
            given["tolerance"],
            Bootstrap(given["seed"], given["bootstrap_samples"], given["confidence"]),
        ),
        title="pull-off force against cutoff wavelength, and the critical band",
    )
