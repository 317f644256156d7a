"""How far indents overlap if one part of the sphere meets many positions on a surface."""

from hardcontact.base.job import job
from hardcontact.base.random import generator
from hardcontact.contact.contact import Contact
from hardcontact.contact.geometry import bodies
from hardcontact.contact.repeated_contact import (
    indented_area_ratio,
    large_surface,
    mean_over_surfaces,
)
from hardcontact.surfaces.height_map import read_height_map
from hardcontact.surfaces.spectrum import read_spectrum

with job(snakemake) as job:
    params = job.parameters
    spectrum = read_spectrum(job.input.spectrum)
    ratios = []
    paths = zip(job.input.substrates, job.input.spheres, strict=True)
    for (scan, _), (substrate_path, sphere_path) in zip(params["pairs"], paths, strict=True):
        sphere = read_height_map(sphere_path)
        pixel_size = min(read_height_map(substrate_path).pixel_size, sphere.pixel_size)
        rng = generator(params["seed"], params["surface"], scan, "places")
        surface = large_surface(rng, spectrum, params["size"], pixel_size)
        # The window holds the whole surface, each point once.
        contact = Contact(radius=params["radius"], window=surface.size, count=1, **params["load"])
        contact_bodies = bodies(surface, sphere, contact)
        contact_pixel_count = contact.pixel_count(contact_bodies.geometry.pixel_size)
        ratios.append(
            indented_area_ratio(contact_bodies, contact_pixel_count, rng, params["contacts"])
        )
    names = ("surface", "label", "basis", "contacts")
    job.write(
        mean_over_surfaces(ratios, params["confidence"]).assign_attrs(
            params["load"] | {name: params[name] for name in names}
        ),
        title=f"overlap of the indents of {params['contacts']} contacts on {params['label']}",
    )
