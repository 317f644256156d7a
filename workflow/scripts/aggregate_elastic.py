"""Elastic contacts of all surfaces and scans."""

import json

from hardcontact import dataset, log

log.start(snakemake.log[0])
parameters = json.loads(snakemake.params.canonical)
keys = [tuple(key) for key in parameters["scans"]]
surfaces = list(dict.fromkeys(surface for surface, _ in keys))
scans = {key: dataset.read(path) for key, path in zip(keys, snakemake.input.scans, strict=True)}
first = {}
for (surface, _), scan in scans.items():
    first.setdefault((surface,), scan)

contacts = dataset.stack(
    {key: scan.drop_vars(["pressure", "y", "x"]) for key, scan in scans.items()},
    ["surface", "scan"],
).drop_encoding()  # whole numbers are missing where a scan is
examples = dataset.stack({key: scan[["pressure"]] for key, scan in first.items()}, ["surface"])
dataset.write(
    contacts.assign(
        pressure=examples.pressure,
        label=("surface", [parameters["labels"][surface] for surface in surfaces]),
        basis=("surface", [parameters["basis"][surface] for surface in surfaces]),
    ),
    snakemake.output[0],
    title="elastic contacts: pressure at the preload, and pull-off beside that of rigid bodies",
    parameters=snakemake.params.canonical,
    inputs=snakemake.input,
    code=snakemake.input.code,
)
