"""Spectra of a surface, one per realization, sampled within the uncertainty of its scans."""

from hardcontact.base.arrays import SEED_WORDS, generator
from hardcontact.records.job import run_job
from hardcontact.scans.joined_spectrum import sample_spectra
from hardcontact.surfaces.height_map import load_height_map
from hardcontact.surfaces.levelling import remove_form
from hardcontact.surfaces.spectrum import spectrum_dataset

with run_job(snakemake) as job:
    params = job.parameters
    surface = params["surface"]
    contact_scan_indices = params["contact_scan_indices"]
    realizations = range(1, len(job.output) + 1)
    rngs = (
        generator(params["seed"], surface, realization, SEED_WORDS["sampled spectrum"])
        for realization in realizations
    )
    scans = [
        remove_form(load_height_map(path), params["sphere_radius"], params["levelling"])
        for path in job.input.measurements
    ]
    spectra = sample_spectra(rngs, scans, params["tip_radii"])
    for index, (spectrum, height_factors) in enumerate(spectra):
        # Realizations use the scans in turn, like the masters with which they are compared.
        factor = height_factors[contact_scan_indices[index % len(contact_scan_indices)]]
        sampled = spectrum_dataset(spectrum.density).assign_attrs(height_factor=factor)
        job.write(sampled, f"a spectrum that the measurements of {surface} allow", index)
