"""Plastic pull-off at every contact of a master without the scales beyond one cutoff."""

import json

import xarray as xr

from hardcontact import adhesion, contact, dataset, fourier, log, sphere

log.start(snakemake.log[0])
parameters = json.loads(snakemake.params.canonical)
settings, radius, rho = parameters["contact"], parameters["radius"], parameters["rho"]
pixels, cutoff, work = parameters["pixels"], parameters["cutoff"], 1.0

master = dataset.read(snakemake.input.master)
heights, master_pixel = master.heights.values, dataset.pixel_size(master)
heights, pixel_size = fourier.filtered(heights, master_pixel, parameters["side"], cutoff, pixels)

roughness = None
if snakemake.input.sphere:
    rough = dataset.read(snakemake.input.sphere)
    heights, roughness, pixel_size, _ = sphere.common_pixels(
        heights, pixel_size, rough.heights.values, dataset.pixel_size(rough)
    )
positions = sphere.contact_positions(heights.shape[0], settings["count"])
window = sphere.window_pixels(settings["window"], pixel_size)
touching = contact.contact_pixel_count(settings["preload"], settings["hardness"], pixel_size)
total = adhesion.plastic_totals(
    heights,
    roughness,
    positions,
    pixel_size,
    radius,
    window,
    [touching],
    rho,
    snakemake.threads,
)[0]

dataset.write(
    xr.Dataset(
        {
            "pull_off_force": (
                ("contact_y", "contact_x"),
                adhesion.pull_off_force(total, rho, pixel_size, work),
                {"units": "N", "long_name": "pull-off force at W = 1 J/m2"},
            )
        },
        {
            axis: (axis, positions * pixel_size, {"units": "nm"})
            for axis in ("contact_y", "contact_x")
        },
        {
            "work_of_adhesion": work,
            "rho": rho,
            "touching_pixels": touching,
            "shortest_wavelength": 2 * pixel_size,
            "longest_wavelength": heights.shape[0] * pixel_size,
        },
    ),
    snakemake.output[0],
    title=f"plastic pull-off of a {parameters['side']}-scale master, cutoff {cutoff} nm",
    parameters=snakemake.params.canonical,
    inputs=snakemake.input,
    code=snakemake.input.code,
)
