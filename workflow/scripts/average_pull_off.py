"""Mean rigid and plastic pull-off of the scans of a surface, at several loads."""

from hardcontact.base.dataset import stack
from hardcontact.base.job import job, progress
from hardcontact.contact.contact import Contact
from hardcontact.contact.geometry import read_bodies
from hardcontact.contact.pull_off import mean_pull_off_of_pair

with job(snakemake) as job:
    params = job.parameters
    contacts = [
        Contact(radius=params["radius"], **load, **params["array"]) for load in params["loads"]
    ]
    paths = zip(params["scans"], job.input.substrates, strict=True)
    forces = {}
    for scan, path in progress(paths, len(params["scans"]), "scans"):
        contact_bodies = read_bodies(path, job.input.sphere or None, contacts[0])
        forces[scan, params["sphere_scan"]] = mean_pull_off_of_pair(
            contact_bodies, contacts, params["ranges"]
        )
    job.write(
        stack(forces, ["scan", "sphere_scan"]),
        title=f"mean pull-off forces of scans of {params['surface']}",
    )
