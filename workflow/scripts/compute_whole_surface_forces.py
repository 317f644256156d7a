"""Forces on whole substitute surfaces: at all ranges, and with each octave changed."""

from hardcontact.base.dataset import stack
from hardcontact.base.progress import progress
from hardcontact.contact.contact import CONTACT_AXES, Contact
from hardcontact.contact.geometry import join_bodies
from hardcontact.contact.pull_off import make_force_function, pull_off_dataset
from hardcontact.inference.octaves import octave_force_dataset, octave_limits
from hardcontact.records.job import run_job
from hardcontact.surfaces.featured_scans import whole_surface
from hardcontact.surfaces.substitutes import read_substitute

with run_job(snakemake) as job:
    params = job.parameters
    surface_numbers = params["surface_numbers"]
    contact = Contact(**params["contact"])
    substitute = read_substitute(
        params["surface"], job.input.substitute, params["scan_grid"], params["seed"]
    )
    description = None if params["has_features"] else job.input.description
    forces = {}
    for number in progress(surface_numbers, len(surface_numbers), "surfaces"):
        surface = whole_surface(substitute, description, number, **params["grid"])
        limits = octave_limits(2 * surface.pixel_size, 2 * surface.size)
        octave_forces = octave_force_dataset(surface, limits, make_force_function(contact))
        bodies = join_bodies(surface, None, contact)
        pull_off = pull_off_dataset(bodies, contact, params["ranges"])
        mean_force = pull_off["pull_off_force"].mean(CONTACT_AXES, keep_attrs=True)
        forces[(number,)] = octave_forces.assign(pull_off_force=mean_force)
    job.write(
        stack(forces, ["map"]).assign_attrs(map_size=surface.size),
        title=f"pull-off forces on whole surfaces of {params['surface']}",
    )
