"""C_iso of a measured surface: the mean PSD of its scans, continued beyond their band."""

from hardcontact.records import dataset
from hardcontact.study.job import job
from hardcontact.surfaces.spectrum import extrapolated_spectrum

with job(snakemake) as this:
    this.write(
        extrapolated_spectrum([dataset.read(path) for path in this.input.scans]),
        title="power spectral density of a measured surface, extrapolated",
    )
