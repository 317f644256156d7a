"""Range and work of adhesion, force statistics and the critical band, beside what is published."""

import json

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact import dataset, inference, log, scales, statistics, synthesis

log.start(snakemake.log[0])
parameters = json.loads(snakemake.params.canonical)
samples, confidence = parameters["bootstrap_samples"], parameters["confidence"]
adhesion, filtered = dataset.read(snakemake.input.adhesion), dataset.read(snakemake.input.scales)
surfaces = adhesion.surface.values.tolist()
published = pd.read_csv(snakemake.input.pull_off).pivot(
    index="surface", columns="quantity", values="value"
)
published = published.reindex(surfaces)
constants = pd.read_csv(snakemake.input.published).set_index("quantity")


def generator(*names):
    return synthesis.generator(parameters["seed"], "bootstrap", *names)


def inferred(model):
    forces = adhesion.pull_off_force.sel(contact_model=model)
    found = inference.infer(
        forces,
        published.mean_force.to_numpy(),
        surfaces.index(parameters["reference_surface"]),
        generator("adhesion"),
        samples,
        confidence,
        parameters["error_threshold"],
    )
    fitted = inference.at_range(forces, forces.rho.values, float(found.range_of_adhesion))
    fitted = (fitted * float(found.work_of_adhesion)).stack(contact=["contact_y", "contact_x"])
    summaries = [
        statistics.force_statistics(
            fitted.sel(surface=surface).values,
            parameters["force_floor"],
            generator("statistics", model, surface),
            samples // 10,
            confidence,
        )
        for surface in log.progress(surfaces, len(surfaces), f"force statistics, {model}")
    ]
    return found.merge(xr.concat(summaries, pd.Index(surfaces, name="surface")))


models = adhesion.contact_model.values.tolist()
adhesive = xr.concat([inferred(model) for model in models], pd.Index(models, name="contact_model"))
band = scales.critical_band(
    filtered, parameters["tolerance"], generator("scales"), samples, confidence
)
shape = statistics.lognormal_shape(published.mean_force, published.median_force)
attributes = {"units": "N", "basis": "published"}
dataset.write(
    adhesive.merge(band)
    .assign(
        published_mean_force=("surface", published.mean_force, attributes),
        published_median_force=("surface", published.median_force, attributes),
        published_ratio=(
            "surface",
            published.mean_force / published.mean_force[parameters["reference_surface"]],
            {"units": "1", "basis": "published"},
        ),
        published_lognormal_shape=("surface", np.asarray(shape), {"units": "1"}),
        published_lognormal_median=("surface", published.median_force, attributes),
        label=adhesion.label,
        basis=adhesion.basis,
    )
    .assign_attrs(
        error_threshold=parameters["error_threshold"],
        force_floor=parameters["force_floor"],
        scale_tolerance=parameters["tolerance"],
        confidence=confidence,
        sphere_radius=adhesion.attrs["sphere_radius"],
        published_range=constants.value["range_of_adhesion"],
        published_range_uncertainty=constants.uncertainty["range_of_adhesion"],
        published_work=constants.value["work_of_adhesion"],
        published_work_uncertainty=constants.uncertainty["work_of_adhesion"],
        published_cutoff_small=constants.value["critical_wavelength_small"],
        published_cutoff_large=constants.value["critical_wavelength_large"],
    ),
    snakemake.output[0],
    title="range and work of adhesion, force statistics and critical band",
    parameters=snakemake.params.canonical,
    inputs=snakemake.input,
    code=snakemake.input.code,
)
