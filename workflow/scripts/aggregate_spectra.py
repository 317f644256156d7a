"""Spectra of all surfaces: joined from measured scans, or described for substitutes."""

from hardcontact.base.dataset import read_by_name
from hardcontact.records.job import run_job
from hardcontact.scans.spectrum_datasets import convert_described_spectrum, stack_spectra

with run_job(snakemake) as job:
    params = job.parameters
    spectra = read_by_name(params["surfaces"], job.input.spectra)
    # The spectra of descriptions get the form of measured spectra.
    for surface, path in params["descriptions"].items():
        spectra[surface] = convert_described_spectrum(spectra[surface], path)
    all_spectra = stack_spectra(spectra, params["labels"])
    job.write(all_spectra, title="power spectral densities of all surfaces, measured or described")
