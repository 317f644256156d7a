"""Which asperities carry the force of some plastic contacts on one scan, by range of adhesion."""

import json

import numpy as np
import xarray as xr

from hardcontact import contact, dataset, log, patches, sphere, synthesis

log.start(snakemake.log[0])
parameters = json.loads(snakemake.params.canonical)
settings, sought, radius = parameters["contact"], parameters["asperities"], parameters["radius"]

pair = sphere.pair(
    dataset.read(snakemake.input.substrate),
    dataset.read(snakemake.input.sphere),
    settings["window"],
    settings["count"],
)
rng = synthesis.generator(
    parameters["seed"], parameters["surface"], parameters["scan"], "contacts for asperities"
)
places = sphere.sampled_contacts(rng, settings["count"], sought["contacts"])
touching = contact.contact_pixel_count(settings["preload"], settings["hardness"], pair.pixel_size)


def carriers(place):
    """Asperities of one contact at every range of adhesion: (rho, 4)."""
    gap = contact.gap_map(
        pair.substrate, pair.positions[place], pair.pixel_size, radius, pair.window, pair.roughness
    )
    gap = np.maximum(gap - np.partition(gap.ravel(), touching - 1)[touching - 1], 0)
    return [
        patches.asperities(np.exp(-gap / rho), sought["share"], pair.pixel_size)
        for rho in sought["ranges"]
    ]


found = np.array([carriers(place) for place in log.progress(places, len(places), "contacts")])
units = {"largest_share": "1", "two_largest_share": "1", "patches": "1", "extent": "nm"}
dataset.write(
    xr.Dataset(
        {
            name: (("contact", "rho"), found[..., k], {"units": units[name]})
            for k, name in enumerate(patches.Asperities._fields)
        },
        {
            "rho": ("rho", sought["ranges"], {"units": "nm", "long_name": "range of adhesion"}),
            "contact_y": ("contact", places[:, 0]),
            "contact_x": ("contact", places[:, 1]),
        },
        {"share": sought["share"], "sphere_radius": radius},
    ),
    snakemake.output[0],
    title=f"asperities of scan {parameters['scan']} of {parameters['surface']}",
    parameters=snakemake.params.canonical,
    inputs=snakemake.input,
    code=snakemake.input.code,
)
