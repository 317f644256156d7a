"""Mean pull-off of a smooth sphere on the scans of a surface."""

from hardcontact.base.dataset import stack
from hardcontact.base.job import job, progress
from hardcontact.contact.contact import Contact
from hardcontact.contact.geometry import read_bodies
from hardcontact.contact.pull_off import mean_pull_off_of_pair

with job(snakemake) as job:
    params = job.parameters
    contact = Contact(**params["contact"])
    paths = zip(params["scans"], job.input.scans, strict=True)
    forces = {}
    for scan, path in progress(paths, len(params["scans"]), "scans"):
        bodies = read_bodies(path, None, contact)
        forces[(scan,)] = mean_pull_off_of_pair(bodies, contact, params["ranges"])
    job.write(
        stack(forces, ["scan"]),
        title=f"mean pull-off forces of a smooth sphere on scans of {params['surface']}",
    )
