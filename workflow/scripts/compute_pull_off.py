"""Rigid and plastic pull-off of one scan on all scans of the sphere, and how the window matters."""

from hardcontact.adhesion.all_surfaces import over_sphere_scans
from hardcontact.adhesion.pull_off import finer_pixel_change, pull_off_of_pair, window_change
from hardcontact.contact.geometry import read_bodies
from hardcontact.records.job import job

with job(snakemake) as this:
    given, contact = this.parameters, this.parameters["contact"]
    pairs = {
        number: read_bodies(this.input.substrate, sphere, given["radius"], contact)
        for number, sphere in zip(given["sphere_scans"], this.input.spheres or [None], strict=True)
    }
    forces = over_sphere_scans(
        {number: pull_off_of_pair(pair, contact, given["ranges"]) for number, pair in pairs.items()}
    )
    first = next(iter(pairs.values()))
    this.write(
        forces.assign(window_change(pairs.values(), contact, given["reference_range"])).assign(
            finer_pixel_change(first, contact, min(given["ranges"]))
        ),
        title="pull-off forces of one substrate scan on all scans of the sphere",
    )
