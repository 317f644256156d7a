"""The wavelengths whose removal changes the pull-off force, with their intervals."""

from hardcontact.band.critical_band import critical_band
from hardcontact.base import dataset
from hardcontact.base.job import job
from hardcontact.base.statistics import Sampling

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
