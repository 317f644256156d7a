"""Pull-off of a scan on all scans of the sphere and on a smooth one, and the effect of the grid."""

from dataclasses import replace

from hardcontact.base.job import run_job
from hardcontact.contact.contact import Contact
from hardcontact.contact.geometry import join_bodies, spheres_at_positions
from hardcontact.contact.pull_off import (
    force_on_finer_pixels,
    mean_pull_off_dataset,
    pull_off_dataset,
    wider_window_change,
)
from hardcontact.contact.stacked_datasets import stack_sphere_scans
from hardcontact.surfaces.height_map import read_height_map

with run_job(snakemake) as job:
    params = job.parameters
    contact = Contact(**params["contact"])
    substrate = read_height_map(job.input.substrate)
    spheres = [
        sphere
        for path in job.input.spheres
        for sphere in spheres_at_positions(read_height_map(path), params["positions_per_row"])
    ]
    pairs = {
        number: join_bodies(substrate, sphere, contact)
        for number, sphere in zip(params["sphere_positions"], spheres or [None], strict=True)
    }
    forces = stack_sphere_scans(
        {
            number: pull_off_dataset(pair, contact, params["ranges"])
            for number, pair in pairs.items()
        }
    )
    plastic_force = forces["pull_off_force"].sel(contact_model="plastic")
    shortest = min(params["ranges"])
    first_pair = next(iter(pairs.values()))
    smooth = mean_pull_off_dataset(replace(first_pair, roughness=None), contact, params["ranges"])
    job.write(
        forces.assign(
            wider_window_change(pairs.values(), contact, plastic_force.sel(rho=contact.rho))
        )
        .assign(
            force_on_finer_pixels(
                first_pair,
                replace(contact, rho=shortest),
                plastic_force.isel(sphere_scan=0).sel(rho=shortest),
            )
        )
        .assign(smooth_sphere_force=smooth["pull_off_force"]),
        title="pull-off forces of one substrate scan on all scans of the sphere",
    )
