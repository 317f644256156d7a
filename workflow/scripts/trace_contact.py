"""One contact: its gap, the adhesive pressure after plastic contact, and the force on parting."""

import json

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact import adhesion, contact, dataset, log, sphere

log.start(snakemake.log[0])
parameters = json.loads(snakemake.params.canonical)
settings, radius = parameters["contacts"], parameters["radius"]
published = pd.read_csv(snakemake.input.published).set_index("quantity").value
rho, work = published["range_of_adhesion"], published["work_of_adhesion"]

substrate, roughness, positions, pixel_size, window, _ = sphere.pair(
    dataset.read(snakemake.input.substrate),
    dataset.read(snakemake.input.sphere),
    settings["window"],
    settings["count"],
)
touching = contact.contact_pixel_count(settings["preload"], settings["hardness"], pixel_size)
position = positions[parameters["contact"]]
gap = contact.gap_map(substrate, position, pixel_size, radius, window, roughness)
approach = np.partition(gap.ravel(), touching - 1)[touching - 1]
gap -= approach
attraction = np.exp(-np.maximum(gap, 0) / rho)
pull_off = adhesion.pull_off_force(attraction.sum(), rho, pixel_size, work)
separation = np.linspace(0, 10 * rho, 201)

offset = (np.arange(window) - window // 2) * pixel_size
axis = {"units": "nm", "long_name": "position from the apex"}
dataset.write(
    xr.Dataset(
        {
            "gap": (
                ("y", "x"),
                gap.astype(np.float32),
                {"units": "nm", "long_name": "gap before flattening"},
            ),
            "adhesive_pressure": (
                ("y", "x"),
                (work / (rho * 1e-9) * attraction).astype(np.float32),
                {"units": "Pa"},
            ),
            "force": (
                "separation",
                adhesion.force_separation(pull_off, rho, separation),
                {"units": "N"},
            ),
        },
        {
            "y": ("y", offset, axis),
            "x": ("x", offset, axis),
            "separation": ("separation", separation, {"units": "nm"}),
        },
        {
            key: parameters[key]
            for key in ("surface", "scan", "sphere_scan", "contact", "label", "basis")
        }
        | {"rho": rho, "work_of_adhesion": work, "pull_off_force": float(pull_off)},
    ),
    snakemake.output[0],
    title=f"contact {parameters['contact']} on {parameters['label']}",
    parameters=snakemake.params.canonical,
    inputs=snakemake.input,
    code=snakemake.input.code,
)
