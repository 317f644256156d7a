"""Mean plastic pull-off of the scans of a surface on one of the sphere, at several loads."""

from hardcontact.adhesion.pull_off import mean_pull_off_of_pair
from hardcontact.contact.contact import Contact
from hardcontact.contact.geometry import read_bodies
from hardcontact.records.dataset import stack
from hardcontact.records.job import job

with job(snakemake) as this:
    given = this.parameters
    contacts = [
        Contact(radius=given["radius"], **given["array"], **load) for load in given["loads"]
    ]
    forces = {}
    for scan, path in zip(given["scans"], this.input.substrates, strict=True):
        pair = read_bodies(path, this.input.sphere, contacts[0])
        forces[scan, given["sphere_scan"]] = mean_pull_off_of_pair(pair, contacts, given["ranges"])
    this.write(
        stack(forces, ["scan", "sphere_scan"]),
        title=f"mean pull-off forces of scans of {given['surface']} at several loads",
    )
