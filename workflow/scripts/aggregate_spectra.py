"""Spectra of all surfaces: joined from measured scans, or described for substitutes."""

from hardcontact.base import dataset
from hardcontact.records.job import run_job
from hardcontact.scans.spectrum_datasets import convert_described_spectrum, stack_spectra

with run_job(snakemake) as job:
    params = job.parameters
    paths = zip(params["surfaces"], job.input.spectra, strict=True)
    spectra = {surface: dataset.read(path) for surface, path in paths}
    # The spectra of descriptions get the form of measured spectra.
    for surface, path in params["descriptions"].items():
        spectra[surface] = convert_described_spectrum(spectra[surface], path)
    job.write(
        stack_spectra(spectra, params["labels"]),
        title="power spectral densities of all surfaces, measured or described",
    )
