"""Mean pull-off of the filtered masters of a scan over radii, ranges and contact areas."""

from hardcontact.contact.contact import Contact
from hardcontact.numbers.random import generator
from hardcontact.records.job import job
from hardcontact.scales.filtered_masters import Filters, scaled_pull_off
from hardcontact.surfaces.height_map import read_height_map
from hardcontact.surfaces.spectrum import read_spectrum
from hardcontact.surfaces.synthesis import synthesized_master

with job(snakemake) as this:
    given, surface = this.parameters, this.parameters["surface"]
    contacts = [
        Contact(radius=given["radii"][0], preload=preload, **given["contact"])
        for preload in given["preloads"]
    ]
    scan, spectrum = read_height_map(this.input.scan), read_spectrum(this.input.spectrum)
    for side, scales in given["sides"].items():
        rng = generator(given["seed"], surface, given["realization"], f"{side}-scale scaling")
        master = synthesized_master(side, rng, scan, scales, spectrum)
        this.write(
            scaled_pull_off(
                master,
                Filters(side, scales["pixels"], scales["cutoffs"]),
                contacts,
                given["radii"],
                given["ranges"],
            ),
            title=f"pull-off of a filtered {side}-scale master of {surface}, scaled",
            output=side,
        )
