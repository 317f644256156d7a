"""A substitute scan, written as a file that scan readers know."""

import json

import numpy as np
import xarray as xr

from hardcontact import dataset, log, spectrum, synthesis

log.start(snakemake.log[0])
parameters = json.loads(snakemake.params.canonical)
scan, radius = parameters["scan"], parameters["sphere_radius"]
pixel_size = scan["size"] / scan["pixels"]
description = dataset.read(snakemake.input.spectrum)

rng = synthesis.generator(parameters["seed"], parameters["surface"], parameters["number"], "scan")
heights = synthesis.substitute_scan(
    rng,
    scan["pixels"],
    pixel_size,
    scan["realization_pixels"],
    lambda q: spectrum.at(q, description.wavevector.values, description.spectrum.values),
    description.attrs["skewness"],
    description.attrs["spread"],
)
if radius is not None:
    heights = synthesis.sphere_scan(rng, heights, pixel_size, radius)

# The classic format and the names that SurfaceTopography reads; its first axis is x.
position = (np.arange(scan["pixels"]) + 0.5) * pixel_size
axis = {"length": scan["size"], "unit": "nm", "units": "nm", "periodic": np.int32(0)}
dataset.write(
    xr.Dataset(
        {"heights": (("x", "y"), heights.T, {"unit": "nm", "units": "nm"})},
        {"x": ("x", position, axis), "y": ("y", position, axis)},
        {"basis": "substitute: synthesised, not measured"},
    ),
    snakemake.output[0],
    title=f"substitute scan {parameters['number']} of {parameters['surface']}",
    parameters=snakemake.params.canonical,
    inputs=snakemake.input,
    code=snakemake.input.code,
    file_format="NETCDF3_64BIT",
)
