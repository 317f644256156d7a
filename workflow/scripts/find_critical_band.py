"""The wavelengths whose removal changes the pull-off force, with their intervals."""

from hardcontact.numbers.statistics import Sampling
from hardcontact.records import dataset
from hardcontact.records.job import job
from hardcontact.scales.critical_band import critical_band

with job(snakemake) as this:
    given, scales = this.parameters, dataset.read(this.input.scales)
    sampling = Sampling(given["seed"], given["samples"], given["confidence"])
    band = critical_band(scales, given["tolerance"], sampling)
    this.write(
        band.assign(label=scales.label, basis=scales.basis).assign_attrs(
            scale_tolerance=given["tolerance"],
            confidence=given["confidence"],
            sphere_radius=scales.attrs["sphere_radius"],
        ),
        title="pull-off force against cutoff wavelength, and the critical band",
    )
