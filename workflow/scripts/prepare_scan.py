"""A scan, measured or substitute: the plane removed, and the sphere if there is one; stitched."""

import json

from hardcontact import dataset, log, reading, topography

log.start(snakemake.log[0])
parameters = json.loads(snakemake.params.canonical)
radius, basis = parameters["sphere_radius"], parameters["source"]

heights, pixel_size = reading.read_scan(
    snakemake.input.scan, parameters["dataset"], parameters["undefined_pixels"]
)
if radius is None:
    heights = topography.level(heights, pixel_size)
else:
    heights = topography.subtract_sphere(heights, pixel_size, radius)

for output, surface, title in (
    (
        "scan",
        dataset.height_map(heights, pixel_size, periodic=False, basis=basis),
        "levelled scan" if radius is None else "roughness of a scan of the sphere",
    ),
    (
        "stitched",
        dataset.height_map(
            topography.mirror_stitch(heights), pixel_size, periodic=True, basis=basis
        ),
        "scan and its mirror images, periodic",
    ),
):
    dataset.write(
        surface,
        snakemake.output[output],
        title=title,
        parameters=snakemake.params.canonical,
        inputs=snakemake.input,
        code=snakemake.input.code,
    )
