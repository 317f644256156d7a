"""Effective work of adhesion and classical models of rough adhesion, beside the pull-off forces."""

import json

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact import classical, dataset, hertz, log, rough_adhesion, synthesis

log.start(snakemake.log[0])
parameters = json.loads(snakemake.params.canonical)
confidence = parameters["confidence"]
inference = dataset.read(snakemake.input.inference)
constants = pd.read_csv(snakemake.input.parameters).set_index("quantity").value
table1 = pd.read_csv(snakemake.input.table1).pivot(index="surface", columns="quantity").dropna()
printed = pd.read_csv(snakemake.input.pull_off, dtype=str).pivot(
    index="surface", columns="quantity", values="value"
)
printed = printed.dropna(subset="mean_force")
surfaces = inference.surface.values.tolist()
known = [name for name in surfaces if name in printed.index and name in table1.index]
computed = inference.sel(contact_model="plastic", surface=known)
newton, one, energy = {"units": "N"}, {"units": "1"}, {"units": "J m-2"}

contact = rough_adhesion.Contact(
    inference.attrs["sphere_radius"],
    hertz.effective_modulus(
        constants["sphere_youngs_modulus"],
        constants["sphere_poisson_ratio"],
        constants["substrate_youngs_modulus"],
        constants["substrate_poisson_ratio"],
    ),
    constants["equilibrium_spacing"],
)
work = constants["work_of_adhesion"]
tabor = classical.tabor_parameter(work, *contact)
_, peak_pressure, _ = hertz.contact(constants["preload"], contact.radius, contact.modulus)


def rounded(quantity):
    """A printed number of each surface, and the ends of what is rounded to it."""
    value = printed.loc[known, quantity].astype(float).to_numpy()
    half = printed.loc[known, quantity].map(rough_adhesion.half_unit, na_action="ignore")
    half = half.astype(float).to_numpy()
    return {"": value, "_low": value - half, "_high": value + half}


def roughness(prefix, column):
    """Three rows of Table 1, "value" or "uncertainty" of each."""
    rows = table1.loc[known, column]
    names = rough_adhesion.Roughness._fields
    return rough_adhesion.Roughness(*(rows[f"{prefix}_rms_{name}"].to_numpy() for name in names))


forces = {
    "published": rounded("mean_force"),
    "computed": {end: computed[f"force_mean{end}"].values for end in ("", "_low", "_high")},
}
targets = {against: force[""] for against, force in forces.items()}
printed_work = rounded("effective_work_of_adhesion")
effective = dataset.stack(
    {
        (against,): rough_adhesion.effective_works(
            force, contact, constants["tabor_parameter"], work
        )
        for against, force in forces.items()
    },
    ["against"],
)
works = effective.effective_work_of_adhesion.sel(tabor="printed")
works = {against: works.sel(against=against).values for against in targets}
parts = {}
for metrics, prefix in (("afm", "afm"), ("all_scales", "all")):
    rng = synthesis.generator(parameters["seed"], "classical", metrics)
    mean, uncertainty = roughness(prefix, "value"), roughness(prefix, "uncertainty")
    samples = rough_adhesion.drawn(rng, mean, uncertainty, parameters["draws"])
    parts[(metrics,)] = rough_adhesion.compare(
        mean, samples, contact, work, targets, confidence
    ).merge(rough_adhesion.power_laws(mean, samples, works, confidence))

found = dataset.stack(parts, ["metrics"]).merge(effective).assign_coords(surface=known)
for end, other in (("", ""), ("_low", "_high"), ("_high", "_low")):
    implied = classical.effective_work_of_adhesion(
        forces["published"][end], contact.radius, printed_work[other]
    )
    found = found.assign(
        {
            f"implied_pull_off_coefficient{end}": ("surface", implied, one),
            f"published_effective_work_of_adhesion{end}": ("surface", printed_work[end], energy),
            f"published_mean_force{end}": ("surface", forces["published"][end], newton),
            f"computed_mean_force{end}": ("surface", forces["computed"][end], newton),
        }
    )
axis = np.geomspace(0.01, 10, 121)  # Tabor parameters from DMT to JKR
axis = xr.DataArray(axis, {"tabor_axis": ("tabor_axis", axis, one)})
models = rough_adhesion.MODELS.values()
dataset.write(
    found.reindex(surface=surfaces)
    .assign(
        transition_coefficient=rough_adhesion.transition(axis),
        tabor_parameter=((), tabor, one),
        maugis_parameter=((), classical.maugis_parameter(tabor), one),
        printed_tabor_parameter=((), constants["tabor_parameter"], one),
        effective_modulus=((), contact.modulus, {"units": "Pa"}),
        hertz_peak_pressure=((), peak_pressure, {"units": "Pa"}),
        model_label=("model", [model.label for model in models]),
        model_roughness=("model", [model.roughness for model in models]),
        model_verified=("model", [model.verified for model in models]),
        label=inference.label,
        basis=inference.basis,
    )
    .assign_attrs(
        sphere_radius=contact.radius,
        equilibrium_spacing=contact.spacing,
        published_work=work,
        error_threshold=inference.attrs["error_threshold"],
        preload=constants["preload"],
        confidence=confidence,
    ),
    snakemake.output[0],
    title="effective work of adhesion, and classical models of rough adhesion",
    parameters=snakemake.params.canonical,
    inputs=snakemake.input,
    code=snakemake.input.code,
)
