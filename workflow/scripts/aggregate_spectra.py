"""Spectra of all surfaces: joined from measured scans, or described for substitutes."""

from hardcontact.base import dataset
from hardcontact.base.job import job
from hardcontact.surfaces.spectrum_datasets import convert_described_spectrum, stack_spectra

with job(snakemake) as job:
    surfaces, labels = job.parameters["surfaces"], job.parameters["labels"]
    spectra = dict(zip(surfaces, map(dataset.read, job.input.spectra), strict=True))
    for surface, path in job.parameters["descriptions"].items():
        spectra[surface] = convert_described_spectrum(spectra[surface], path)
    job.write(
        stack_spectra(spectra, labels),
        title="power spectral densities of all surfaces, measured or described",
    )
