"""Forces on whole substitute surfaces with a part of their roughness, by the limits of a band."""

from hardcontact.base import published
from hardcontact.base.dataset import read, stack
from hardcontact.base.job import run_job
from hardcontact.base.progress import progress
from hardcontact.contact.contact import Contact
from hardcontact.inference.band_forces import band_force_dataset
from hardcontact.inference.edges import pooled_band
from hardcontact.inference.octaves import make_force_function
from hardcontact.surfaces.conditioning import read_substitute
from hardcontact.surfaces.featured_scans import whole_surfaces

with run_job(snakemake) as job:
    params = job.parameters
    compute_forces = make_force_function(Contact(**params["contact"]))
    substitute = read_substitute(job)
    make_surface = whole_surfaces(substitute, job.input.description, params["has_features"])
    grid = params["grid"]
    constants = published.read_constants(job.input.published_constants)["value"]
    bands = {
        "published": (constants["short_edge"], constants["long_edge"]),
        "found": pooled_band(read(job.input.edges)),
    }
    realizations = params["realizations"]
    surfaces = {}
    for number in progress(realizations, len(realizations), "surfaces"):
        surface = make_surface(number, grid["pixels"], grid["pixel_size"])
        surfaces[(number,)] = band_force_dataset(surface, bands, compute_forces)
    job.write(
        stack(surfaces, ["map"]).assign_attrs(map_size=surface.size),
        title=f"pull-off forces of {params['surface']} with a part of the roughness",
    )
