"""Spectra drawn within what the measurements of a surface leave open, one a realization."""

from hardcontact.base.job import job
from hardcontact.base.random import generator
from hardcontact.surfaces.joined_spectrum import drawn_spectra
from hardcontact.surfaces.scans import flatten, read_stored
from hardcontact.surfaces.spectrum import spectrum_dataset

with job(snakemake) as job:
    params = job.parameters
    surface, places = params["surface"], params["contact_places"]
    drawn = drawn_spectra(
        (
            generator(params["seed"], surface, realization, "drawn spectrum")
            for realization in range(1, len(job.output) + 1)
        ),
        [
            flatten(read_stored(file), params["sphere_radius"], params["levelling"])
            for file in job.input.measurements
        ],
        params["tip_radii"],
    )
    for output, (spectrum, factors) in enumerate(drawn):
        # Realizations build on the scans in turn, as do the masters that theirs are set beside.
        factor = factors[places[output % len(places)]]
        job.write(
            spectrum_dataset(spectrum.density).assign_attrs(height_factor=factor),
            title=f"a spectrum that the measurements of {surface} allow",
            output=output,
        )
