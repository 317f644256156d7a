"""Plastic pull-off of the masters of one realization at every cutoff and several loads."""

from itertools import product

from hardcontact.contact.contact import Contact
from hardcontact.numbers.random import generator
from hardcontact.records.job import job
from hardcontact.scales.filtered_masters import Filters, filtered_pull_off
from hardcontact.surfaces.height_map import read_height_map
from hardcontact.surfaces.spectrum import read_spectrum
from hardcontact.surfaces.synthesis import SIDES, synthesized_master

with job(snakemake) as this:
    given = this.parameters
    contacts = [
        Contact(radius=given["radius"], range=given["rho"], **given["array"], **load)
        for load in given["loads"]
    ]
    sphere = read_height_map(this.input.sphere) if this.input.sphere else None
    inputs = zip(given["surfaces"], this.input.scans, this.input.spectra, strict=True)
    masters = product(inputs, SIDES)
    for output, ((surface, scan, spectrum), side) in enumerate(masters):
        scales = given["sides"][side]
        master = synthesized_master(
            side,
            generator(given["seed"], surface, given["realization"], f"{side}-scale variant"),
            read_height_map(scan),
            scales,
            read_spectrum(spectrum),
        )
        filters = Filters(side, scales["pixels"], scales["cutoffs"])
        this.write(
            filtered_pull_off(
                master, Filters(side, scales["pixels"], scales["cutoffs"]), contacts, sphere
            ),
            title=f"pull-off of a filtered {side}-scale master of {surface}",
            output=output,
        )
