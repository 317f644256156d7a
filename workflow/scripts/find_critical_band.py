"""The wavelengths whose removal changes the pull-off force, with their intervals."""

from hardcontact.band.critical_band import critical_band
from hardcontact.base import dataset
from hardcontact.base.job import job
from hardcontact.base.statistics import Sampling

with job(snakemake) as job:
    params = job.parameters
    scales = dataset.read(job.input.scales)
    sampling = Sampling(params["seed"], params["samples"], params["confidence"])
    band = critical_band(scales, params["tolerance"], sampling)
    job.write(
        band.assign(label=scales.label, basis=scales.basis).assign_attrs(
            scale_tolerance=params["tolerance"],
            confidence=params["confidence"],
            sphere_radius=scales.attrs["sphere_radius"],
        ),
        title="pull-off force against cutoff wavelength, and the critical band",
    )
