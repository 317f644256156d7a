"""The spectrum of both bodies: that of the substrate plus that of the sphere."""

from hardcontact.base.dataset import read_dataset
from hardcontact.records.job import run_job
from hardcontact.scans.both_bodies import combine_spectra

with run_job(snakemake) as job:
    substrate, sphere = read_dataset(job.input.substrate), read_dataset(job.input.sphere)
    title = f"power spectral density of {job.parameters['surface']} and of the sphere"
    job.write(combine_spectra(substrate, sphere), title)
