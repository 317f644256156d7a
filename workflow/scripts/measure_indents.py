"""Indents that plastic contact leaves in the sphere: the sizes of all, and a map of one."""

from hardcontact.base.job import job
from hardcontact.contact.contact import Contact
from hardcontact.contact.indents import indents_of_scans
from hardcontact.surfaces.height_map import HeightMap, read_height_map


def read_scans(scans: tuple[int, ...], paths: list[str]) -> dict[int, HeightMap]:
    """Return the height maps of files by the number of the scan; each file is read once."""
    files = dict(zip(scans, paths, strict=True))
    return {scan: read_height_map(path) for scan, path in files.items()}


with job(snakemake) as job:
    params = job.parameters
    scans, sphere_scans = zip(*params["pairs"], strict=True)
    indents = indents_of_scans(
        read_scans(scans, job.input.substrates),
        read_scans(sphere_scans, job.input.spheres),
        Contact(radius=params["radius"], preload=max(params["preloads"]), **params["contact"]),
        params["preloads"],
    )
    job.write(
        indents.assign_attrs({name: params[name] for name in ("surface", "label", "basis")}),
        title=f"indents left in the sphere by contacts on {params['label']}",
    )
