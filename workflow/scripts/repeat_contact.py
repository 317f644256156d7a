"""Repeated contact of one place of the sphere: forces on a scan, indents of a large surface."""

from hardcontact.contact.geometry import bodies, read_bodies
from hardcontact.insight.repeated_contact import (
    Adhesion,
    indents_at_random_places,
    large_surface,
    repeated_forces,
)
from hardcontact.numbers.random import generator
from hardcontact.records import published
from hardcontact.records.job import job
from hardcontact.surfaces.height_map import read_height_map
from hardcontact.surfaces.spectrum import read_spectrum

with job(snakemake) as this:
    given, contact = this.parameters, this.parameters["contact"]
    seed, surface, scan = (given[key] for key in ("seed", "surface", "scan"))
    load = {"preload": contact["preload"], "hardness": contact["hardness"]}
    constants = published.constants(this.input.published_constants).value
    pair = read_bodies(this.input.substrate, this.input.sphere, given["radius"], contact)
    forces = repeated_forces(
        pair,
        load,
        Adhesion(constants["range_of_adhesion"], constants["work_of_adhesion"]),
        generator(seed, surface, scan, contact["preload"], "repeated contact"),
        given["orders"],
    )
    spectrum, rng = read_spectrum(this.input.spectrum), generator(seed, surface, scan, "places")
    large = large_surface(rng, spectrum, given["size"], pair.geometry.pixel_size)
    sphere = read_height_map(this.input.sphere)
    # All of the large surface lies in the window, each point once.
    over_all = bodies(large, sphere, given["radius"], {"window": large.size, "count": 1})
    this.write(
        forces.merge(indents_at_random_places(over_all, load, rng, forces.sizes["contact"])),
        title=f"repeated contact on scan {scan} of {surface}",
    )
