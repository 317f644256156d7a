"""Pull-off forces on a scan at each position on the sphere; effects of window and pixels."""

from hardcontact.contact.contact import Contact
from hardcontact.contact.geometry import join_bodies, spheres_at_positions
from hardcontact.contact.pull_off import pull_off_with_checks
from hardcontact.records.job import run_job
from hardcontact.surfaces.height_map import load_height_map

with run_job(snakemake) as job:
    params = job.parameters
    contact = Contact(**params["contact"])
    substrate = load_height_map(job.input.substrate)
    spheres = []
    for path in job.input.spheres:
        spheres += spheres_at_positions(load_height_map(path), params["positions_per_row"])
    spheres = spheres or [None]  # None: a smooth sphere
    bodies_by_position = {
        position: join_bodies(substrate, sphere, contact)
        for position, sphere in zip(params["sphere_positions"], spheres, strict=True)
    }
    forces = pull_off_with_checks(bodies_by_position, contact, params["ranges"])
    job.write(forces, title="pull-off forces of one substrate scan on all scans of the sphere")
