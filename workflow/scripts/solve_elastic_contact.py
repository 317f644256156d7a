"""Elastic contact of one pair of scans at some contacts: pressure at the preload, and pull-off."""

import json

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact import contact, dataset, elastic, hertz, log, sphere, synthesis

log.start(snakemake.log[0])
parameters = json.loads(snakemake.params.canonical)
settings, solved, radius = parameters["contact"], parameters["elastic"], parameters["radius"]
published = pd.read_csv(snakemake.input.published).set_index("quantity").value
rho, work = published["range_of_adhesion"], published["work_of_adhesion"]
modulus = hertz.effective_modulus(
    *(solved[body][key] for body in ("sphere", "substrate") for key in ("modulus", "poisson_ratio"))
)

pair = sphere.pair(
    dataset.read(snakemake.input.substrate),
    dataset.read(snakemake.input.sphere),
    settings["window"],
    settings["count"],
)
rng = synthesis.generator(
    parameters["seed"], parameters["surface"], parameters["scan"], "elastic contacts"
)
places = sphere.sampled_contacts(rng, settings["count"], solved["contacts"])
period = min(pair.substrate.shape[0], pair.window)
narrow = min(sphere.window_pixels(solved["window"], pair.pixel_size), period)


def contact_of(place):
    """Numbers of one contact, and the pressure about its peak."""
    gap = contact.gap_map(
        pair.substrate, pair.positions[place], pair.pixel_size, radius, pair.window, pair.roughness
    )
    pressure, iterations = elastic.contact_at_load(
        contact.around_lowest(gap, period), pair.pixel_size, modulus, settings["preload"]
    )
    pressing = pressure[pressure > 0]
    rigid, pull_off, more = elastic.adhesive_pull_off(
        contact.around_lowest(gap, narrow), pair.pixel_size, modulus, work, rho
    )
    numbers = {
        "contact_area": (pressing.size * pair.pixel_size**2, "nm2"),
        "hard_share": (np.mean(pressing > settings["hardness"]), "1"),
        "peak_pressure": (pressing.max(), "Pa"),
        "mean_pressure": (pressing.mean(), "Pa"),
        "rigid_pull_off_force": (rigid, "N"),
        "elastic_pull_off_force": (pull_off, "N"),
        "iterations": (iterations + more, "1"),
    }
    return numbers, contact.around_lowest(-pressure, min(64, period))


found = [contact_of(place) for place in log.progress(places, len(places), "elastic contacts")]
example = -found[0][1]
position = (np.arange(example.shape[0]) - example.shape[0] // 2) * pair.pixel_size
dataset.write(
    xr.Dataset(
        {
            name: ("contact", [numbers[name][0] for numbers, _ in found], {"units": unit})
            for name, (_, unit) in found[0][0].items()
        }
        | {
            "pressure": (("y", "x"), example, {"units": "Pa", "long_name": "pressure, one contact"})
        },
        {
            "contact_y": ("contact", places[:, 0]),
            "contact_x": ("contact", places[:, 1]),
            "y": ("y", position, {"units": "nm", "long_name": "position from the peak"}),
            "x": ("x", position, {"units": "nm", "long_name": "position from the peak"}),
        },
        {
            "hardness": settings["hardness"],
            "preload": settings["preload"],
            "effective_modulus": modulus,
            "rho": rho,
            "work_of_adhesion": work,
            "window": narrow * pair.pixel_size,
            "sphere_radius": radius,
            "hertz_peak_pressure": hertz.contact(settings["preload"], radius, modulus)[1],
        },
    ),
    snakemake.output[0],
    title=f"elastic contacts of scan {parameters['scan']} of {parameters['surface']}",
    parameters=snakemake.params.canonical,
    inputs=snakemake.input,
    code=snakemake.input.code,
)
