"""The spectrum of a substitute, from its description and the published Table 1."""

from hardcontact.base import published
from hardcontact.records.job import run_job
from hardcontact.surfaces.substitute_spectra import substitute_spectrum

with run_job(snakemake) as job:
    surface = job.parameters["surface"]
    table1 = published.read_table1(job.input.published_table1)
    rows = published.rows_of_surface(table1, surface)
    constants = published.read_constants(job.input.published_constants)
    spectrum = substitute_spectrum(job.input.description, rows, constants)
    job.write(spectrum, title=f"power spectral density of the substitute for {surface}")
