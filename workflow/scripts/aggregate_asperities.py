"""Asperities that carry the force, of all surfaces and scans."""

import json

from hardcontact import dataset, log

log.start(snakemake.log[0])
parameters = json.loads(snakemake.params.canonical)
keys = [tuple(key) for key in parameters["scans"]]
surfaces = list(dict.fromkeys(surface for surface, _ in keys))

scans = {key: dataset.read(path) for key, path in zip(keys, snakemake.input.scans, strict=True)}
dataset.write(
    dataset.stack(scans, ["surface", "scan"]).assign(
        label=("surface", [parameters["labels"][surface] for surface in surfaces]),
        basis=("surface", [parameters["basis"][surface] for surface in surfaces]),
    ),
    snakemake.output[0],
    title="asperities that carry the pull-off force of plastic contacts",
    parameters=snakemake.params.canonical,
    inputs=snakemake.input,
    code=snakemake.input.code,
)
