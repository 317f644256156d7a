"""Joined spectra of all measured surfaces, with what each scan adds to them."""

from hardcontact.records import dataset
from hardcontact.study.job import job
from hardcontact.surfaces.joined_spectrum import stacked_spectra

with job(snakemake) as this:
    labels = this.parameters["labels"]
    spectra = map(dataset.read, this.input.spectra)
    this.write(
        stacked_spectra(dict(zip(labels, spectra, strict=True)), labels),
        title="power spectral densities of all measured surfaces, joined over their scans",
    )
