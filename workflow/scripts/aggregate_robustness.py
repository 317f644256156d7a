"""Range and work of adhesion and the critical band under every variant of the study's choices."""

import json

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact import dataset, inference, log, scales, synthesis

log.start(snakemake.log[0])
parameters = json.loads(snakemake.params.canonical)
samples, confidence = parameters["bootstrap_samples"], parameters["confidence"]
substrates, variants = parameters["substrates"], parameters["variants"]
published = pd.read_csv(snakemake.input.pull_off).pivot(
    index="surface", columns="quantity", values="value"
)
published = published.mean_force.reindex(substrates).to_numpy()
constants = pd.read_csv(snakemake.input.published).set_index("quantity")

pairs = {}
for (surface, *scans), path in zip(parameters["pairs"], snakemake.input.adhesion, strict=True):
    pairs.setdefault(surface, {})[tuple(scans)] = dataset.read(path)
forces = {
    surface: dataset.stack(parts, ["scan", "sphere_scan"]).pull_off_force
    for surface, parts in pairs.items()
}
masters = {
    tuple(key): dataset.read(path)
    for key, path in zip(parameters["masters"], snakemake.input.scales, strict=True)
}
realizations = sorted({realization for _, realization, _, _ in masters})


def generator(purpose):
    """The same random numbers for every variant, so that they differ by what they vary alone."""
    return synthesis.generator(parameters["seed"], "bootstrap", "robustness", purpose)


def fitted(variant):
    """Range and work of adhesion; missing where only Fig. 6 is another."""
    names = ("range_of_adhesion", "work_of_adhesion")
    wanted = [f"{name}{end}" for name in names for end in ("", "_low", "_high")] + ["best_error"]
    if variant["probe"] != parameters["probe"]:
        return xr.Dataset({name: np.nan for name in wanted})
    stacked = xr.concat(
        [forces[surface].isel(load=variant["load"]) for surface in variant["surfaces"]],
        pd.Index(substrates, name="surface"),
        join="outer",
    )
    found = inference.infer(
        stacked.expand_dims(["contact_y", "contact_x"], [-2, -1]),
        published,
        substrates.index(parameters["reference_surface"]),
        generator("adhesion"),
        samples,
        confidence,
        parameters["error_threshold"],
    )
    return found[wanted]


def band(variant):
    """Critical wavelengths (side) of all substrates pooled."""
    parts = {}
    for substrate, surface in zip(substrates, variant["surfaces"], strict=True):
        for realization in realizations:
            for side in ("small", "large"):
                master = masters[surface, realization, side, variant["probe"]]
                master = master.isel(load=variant["load"])
                ratio = master.pull_off_force / master.unfiltered_pull_off_force
                parts[substrate, realization, side] = master.assign(ratio=ratio)[
                    ["ratio", "unfiltered_wavelength"]
                ]
    curves = dataset.stack(parts, ["surface", "realization", "side"]).sortby("cutoff_wavelength")
    curves["unfiltered_wavelength"] = curves.unfiltered_wavelength.isel(realization=0, drop=True)
    found = scales.critical_band(
        curves, parameters["tolerance"], generator("scales"), samples, confidence
    )
    names = [f"critical_wavelength{end}" for end in ("", "_low", "_high")]
    return found[names].sel(group="pooled", drop=True)


found = xr.concat(
    [
        xr.merge([fitted(variant), band(variant)])
        for variant in log.progress(variants, len(variants), "variants")
    ],
    pd.Index([variant["name"] for variant in variants], name="variant"),
)
units = {"range_of_adhesion": "nm", "work_of_adhesion": "J m-2", "critical_wavelength": "nm"}
for name in found.data_vars:
    found[name].attrs["units"] = units.get(name.removesuffix("_low").removesuffix("_high"), "1")
dataset.write(
    found.assign_coords(
        variant_label=("variant", [variant["label"] for variant in variants]),
        group=("variant", [variant["group"] for variant in variants]),
    ).assign_attrs(
        {
            name: parameters[name]
            for name in (
                "sphere_radius",
                "tolerance",
                "range",
                "confidence",
                "count",
                "pixels_small",
                "pixels_large",
            )
        }
        | {
            "basis": ", ".join(f"{name}: {parameters['basis'][name]}" for name in substrates),
            "realizations": len(realizations),
            "published_range": constants.value["range_of_adhesion"],
            "published_range_uncertainty": constants.uncertainty["range_of_adhesion"],
            "published_work": constants.value["work_of_adhesion"],
            "published_work_uncertainty": constants.uncertainty["work_of_adhesion"],
            "published_cutoff_small": constants.value["critical_wavelength_small"],
            "published_cutoff_large": constants.value["critical_wavelength_large"],
        }
    ),
    snakemake.output[0],
    title="range and work of adhesion and critical band under other choices",
    parameters=snakemake.params.canonical,
    inputs=snakemake.input,
    code=snakemake.input.code,
)
