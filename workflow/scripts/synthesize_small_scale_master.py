"""A scan with artificial roughness at small scales: the master that Fig. 6 filters."""

import json

from hardcontact import dataset, log, synthesis

log.start(snakemake.log[0])
parameters = json.loads(snakemake.params.canonical)

scan, description = dataset.read(snakemake.input.scan), dataset.read(snakemake.input.spectrum)
heights, pixel_size = synthesis.small_scale_master(
    synthesis.generator(
        parameters["seed"], parameters["surface"], parameters["realization"], "small-scale master"
    ),
    scan.heights.values,
    dataset.pixel_size(scan),
    parameters["pixels"],
    parameters["transition"],
    (description.wavevector.values, description.spectrum.values),
)

dataset.write(
    dataset.height_map(heights, pixel_size, periodic=True, basis=scan.attrs["basis"]),
    snakemake.output[0],
    title=f"small-scale master: realization {parameters['realization']} of {parameters['surface']}",
    parameters=snakemake.params.canonical,
    inputs=snakemake.input,
    code=snakemake.input.code,
)
