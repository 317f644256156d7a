"""A spectrum of both bodies, sampled within the uncertainty of the measurements of each."""

from hardcontact.base.dataset import read
from hardcontact.records.job import run_job
from hardcontact.scans.both_bodies import combine_sampled_spectra

with run_job(snakemake) as job:
    job.write(
        combine_sampled_spectra(read(job.input.substrate), read(job.input.sphere)),
        title=f"a spectrum that the measurements of {job.parameters['surface']} and sphere allow",
    )
