"""The dataset of classical models."""

from typing import Any

import numpy as np
import xarray as xr
from paper_numbers import MEAN_FORCE

from figure_inputs.building import bounded, generator, named

CLASSICAL_MODELS = ["rumpf", "rabinovich", "fuller"]


def classical() -> xr.Dataset:
    """Return classical models, one of which predicts no force."""
    tabor = np.geomspace(0.01, 10, 11)
    curves = 1.75 - 0.25 * np.tanh(np.log(tabor)) * np.array([[1], [1.05]])
    return (
        named()
        .assign_coords(
            metrics=["afm", "all_scales"],
            model=CLASSICAL_MODELS,
            against=["published", "computed"],
            rms_parameter=["height", "slope", "curvature"],
            tabor=["printed", "computed", "self_consistent"],
            transition=["fit", "maugis_dugdale"],
            tabor_axis=tabor,
        )
        .assign(_classical_forces_and_works() | _classical_fits())
        .assign(
            transition_coefficient=(("transition", "tabor_axis"), curves, {"units": "1"}),
            tabor_parameter=((), 0.62, {"units": "1"}),
            printed_tabor_parameter=((), 0.81, {"units": "1"}),
            model_label=("model", [name.title() for name in CLASSICAL_MODELS]),
            model_roughness=("model", ["hemispheres"] * 3),
            model_verified=("model", ["unverified"] * 3),
        )
        .assign_attrs(error_threshold=0.1)
    )


def _classical_forces_and_works() -> dict[str, Any]:
    """Return what the models predict and what forces mean, by surface."""
    rng, energy = generator(), "J m-2"
    dims = ("against", "tabor", "surface")
    forces = MEAN_FORCE * np.array([0.1, 3, 1e-9])[:, None] * np.ones((2, 1, 1))
    works, printed = 800 * MEAN_FORCE * np.ones((2, 3, 1)), 812 * MEAN_FORCE
    return (
        bounded("pull_off_force", ("metrics", "model", "surface"), forces, 0.9, 1.1, "N")
        | bounded("published_mean_force", "surface", MEAN_FORCE, 0.9, 1.1, "N")
        | bounded("computed_mean_force", "surface", 1.1 * MEAN_FORCE, 0.9, 1.1, "N")
        | bounded("effective_work_of_adhesion", dims, works, 0.9, 1.1, energy)
        | bounded("published_effective_work_of_adhesion", "surface", printed, 0.9, 1.1, energy)
        | bounded("implied_pull_off_coefficient", "surface", np.full(4, 1.57), 0.9, 1.1)
        | bounded("adhesion_index", ("metrics", "surface"), rng.uniform(1, 9, (2, 4)))
    )


def _classical_fits() -> dict[str, Any]:
    """Return errors of the models and of power laws."""
    rng = generator()
    by_model, by_law = ("metrics", "model", "against"), ("metrics", "rms_parameter", "against")
    variables = bounded(
        "fitted_work_of_adhesion", by_model, rng.uniform(0.01, 0.1, (2, 3, 2)), unit="J m-2"
    )
    variables |= bounded("mean_relative_error", by_model, rng.uniform(0.3, 1, (2, 3, 2)))
    return variables | bounded("power_law_error", by_law, rng.uniform(0, 1, (2, 3, 2)))
