"""Plastic pull-off of masters whose spectrum is drawn within what the measurements leave open."""

from dataclasses import replace

from hardcontact.contact.contact import Contact
from hardcontact.numbers.random import generator
from hardcontact.records import dataset
from hardcontact.records.job import job
from hardcontact.scales.filtered_masters import Filters, filtered_pull_off
from hardcontact.surfaces.height_map import read_height_map
from hardcontact.surfaces.spectrum import spectrum_from
from hardcontact.surfaces.synthesis import SIDES, synthesized_master

with job(snakemake) as this:
    given = this.parameters
    of_master = given["seed"], given["surface"], given["realization"]
    drawn, scan = dataset.read(this.input.spectrum), read_height_map(this.input.stitched)
    scan = replace(scan, heights=scan.heights * drawn.attrs["height_factor"])
    contact = Contact(radius=given["radius"], range=given["rho"], **given["contact"])
    sphere = read_height_map(this.input.sphere) if this.input.sphere else None
    for output, side in enumerate(SIDES):
        scales = given["sides"][side]
        master = synthesized_master(
            side,
            generator(*of_master, f"{side}-scale master"),  # as in the master that it is set beside
            scan,
            scales,
            spectrum_from(drawn),
        )
        filters = Filters(side, scales["pixels"], scales["cutoffs"])
        this.write(
            filtered_pull_off(
                master, Filters(side, scales["pixels"], scales["cutoffs"]), [contact], sphere
            ),
            title=f"pull-off of a {side}-scale master of a drawn spectrum",
            output=output,
        )
