"""Forces on whole substitute surfaces: at all ranges, and with each octave amplified."""

from hardcontact.base.dataset import stack
from hardcontact.base.job import run_job
from hardcontact.base.progress import progress
from hardcontact.contact.contact import Contact
from hardcontact.contact.geometry import join_bodies
from hardcontact.contact.pull_off import mean_pull_off_dataset
from hardcontact.inference.octaves import make_force_function, octave_force_dataset, octave_limits
from hardcontact.surfaces.conditioning import read_substitute
from hardcontact.surfaces.featured_scans import whole_surfaces

with run_job(snakemake) as job:
    params = job.parameters
    contact = Contact(**params["contact"])
    substitute = read_substitute(job)
    make_surface = whole_surfaces(substitute, job.input.description, params["has_features"])
    grid = params["grid"]
    realizations = params["realizations"]
    surfaces = {}
    for number in progress(realizations, len(realizations), "surfaces"):
        surface = make_surface(number, grid["pixels"], grid["pixel_size"])
        limits = octave_limits(2 * surface.pixel_size, 2 * surface.size)
        means = mean_pull_off_dataset(
            join_bodies(surface, None, contact), contact, params["ranges"]
        )
        octave_forces = octave_force_dataset(surface, limits, make_force_function(contact))
        surfaces[(number,)] = octave_forces.merge(means)
    job.write(
        stack(surfaces, ["map"]).assign_attrs(map_size=surface.size),
        title=f"pull-off forces on whole surfaces of {params['surface']}",
    )
