"""Rigid and plastic pull-off of a scan on all scans of the sphere, and the effect of the window."""

from dataclasses import replace

from hardcontact.base.job import job
from hardcontact.contact.all_surfaces import over_sphere_scans
from hardcontact.contact.contact import Contact
from hardcontact.contact.geometry import read_bodies
from hardcontact.contact.pull_off import finer_pixel_ratio, pull_off_of_pair, wider_window_change

with job(snakemake) as job:
    params = job.parameters
    contact = Contact(radius=params["radius"], range=params["reference_range"], **params["contact"])
    pairs = {
        number: read_bodies(job.input.substrate, sphere, contact)
        for number, sphere in zip(params["sphere_scans"], job.input.spheres or [None], strict=True)
    }
    forces = over_sphere_scans(
        {
            number: pull_off_of_pair(pair, contact, params["ranges"])
            for number, pair in pairs.items()
        }
    )
    first_pair = next(iter(pairs.values()))
    at_shortest_range = replace(contact, range=min(params["ranges"]))
    job.write(
        forces.assign(wider_window_change(pairs.values(), contact)).assign(
            finer_pixel_ratio(first_pair, at_shortest_range)
        ),
        title="pull-off forces of one substrate scan on all scans of the sphere",
    )
