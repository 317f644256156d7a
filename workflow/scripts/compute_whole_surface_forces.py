"""Forces on whole substitute surfaces: at several ranges, and with each octave changed."""

from hardcontact.base.dataset import stack
from hardcontact.contact.contact import Contact
from hardcontact.inference.octaves import whole_surface_forces
from hardcontact.records.job import run_job
from hardcontact.surfaces.features import whole_surfaces
from hardcontact.surfaces.substitutes import read_substitute

with run_job(snakemake) as job:
    params = job.parameters
    contact = Contact(**params["contact"])
    substitute = read_substitute(
        params["surface"], job.input.substitute, params["scan_grid"], params["seed"]
    )
    forces = {}
    for number, height_map in whole_surfaces(substitute, job.input.description, params):
        forces[(number,)] = whole_surface_forces(height_map, contact, params["ranges"])
    title = f"pull-off forces on whole surfaces of {params['surface']}"
    job.write(stack(forces, ["map"]), title)
