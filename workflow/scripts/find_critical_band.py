"""The wavelengths whose removal changes the pull-off force, with their intervals."""

from hardcontact.numbers.statistics import Sampling
from hardcontact.records import dataset
from hardcontact.records.job import job
from hardcontact.scales.critical_band import find_critical_band

with job(snakemake) as this:
    given = this.parameters
    this.write(
        find_critical_band(
            dataset.read(this.input.scales),
            given["tolerance"],
            Sampling(given["seed"], given["samples"], given["confidence"]),
        ),
        title="pull-off force against cutoff wavelength, and the critical band",
    )
