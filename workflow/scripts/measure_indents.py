"""Indents that plastic contact leaves in the sphere: the sizes of all, and a map of one."""

from hardcontact.contact.contact import Contact
from hardcontact.contact.indents import indents_of_scans
from hardcontact.records.job import run_job
from hardcontact.surfaces.height_map import load_height_map

with run_job(snakemake) as job:
    params = job.parameters
    substrate_paths = zip(params["scan_numbers"], job.input.substrates, strict=True)
    sphere_paths = zip(params["sphere_scan_numbers"], job.input.spheres, strict=True)
    indents = indents_of_scans(
        {scan: load_height_map(path) for scan, path in substrate_paths},
        {scan: load_height_map(path) for scan, path in sphere_paths},
        Contact(**params["contact"]),
        params["preloads"],
    )
    indents.attrs |= {name: params[name] for name in ("surface", "label", "source")}
    job.write(indents, title=f"indents left in the sphere by contacts on {params['label']}")
