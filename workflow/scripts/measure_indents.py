"""Indents that plastic contact leaves in the sphere: the sizes of all, and a map of one."""

from hardcontact.base.job import job
from hardcontact.contact.contact import Contact
from hardcontact.contact.indents import indents_of_scans
from hardcontact.surfaces.height_map import HeightMap, read_height_map


def read_scans(numbers: tuple[int, ...], paths: list[str]) -> dict[int, HeightMap]:
    """Return height maps by the number of the scan.

    There is one number and path for each pair of scans: a file that occurs several times is read
    once.
    """
    path_by_number = dict(zip(numbers, paths, strict=True))
    return {number: read_height_map(path) for number, path in path_by_number.items()}


with job(snakemake) as job:
    params = job.parameters
    scan_numbers, sphere_numbers = zip(*params["pairs"], strict=True)
    indents = indents_of_scans(
        read_scans(scan_numbers, job.input.substrates),
        read_scans(sphere_numbers, job.input.spheres),
        Contact(radius=params["radius"], preload=max(params["preloads"]), **params["contact"]),
        params["preloads"],
    )
    job.write(
        indents.assign_attrs({name: params[name] for name in ("surface", "label", "basis")}),
        title=f"indents left in the sphere by contacts on {params['label']}",
    )
