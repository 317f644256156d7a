"""A spectrum of both bodies, sampled within the uncertainty of the measurements of each."""

from hardcontact.base.dataset import read_dataset
from hardcontact.records.job import run_job
from hardcontact.scans.both_bodies import combine_sampled_spectra

with run_job(snakemake) as job:
    substrate, sphere = read_dataset(job.input.substrate), read_dataset(job.input.sphere)
    title = f"a spectrum that the measurements of {job.parameters['surface']} and sphere allow"
    job.write(combine_sampled_spectra(substrate, sphere), title)
