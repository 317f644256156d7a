"""The dataset of many sets of substitutes."""

import numpy as np
import xarray as xr
from paper_numbers import SUBSTRATES, TABLE1

from figure_inputs.building import generator
from figure_inputs.forces import (
    APPROACH,
    CONTACT_MODELS,
    FINE,
    RHO,
    least_errors,
    mean_forces,
    minima,
)
from figure_inputs.scales import (
    CHANGE_DIMS,
    CUTOFFS,
    EDGES,
    RATIO_DIMS,
    SIDES,
    changes,
    critical_wavelengths,
    ratios,
)

SETS = 100
NEWTON, NANOMETRE, ONE = {"units": "N"}, {"units": "nm"}, {"units": "1"}


def sets() -> xr.Dataset:
    """Return sets whose height of closest approach over polished UNCD goes with its curvature."""
    rng = generator()
    deviation = rng.normal(size=(SETS, len(SUBSTRATES)))
    approach = APPROACH * np.exp(0.08 * deviation)[:, None]
    force = mean_forces(RHO, approach)
    by_range = ("set", "contact_model", "surface", "rho")
    ratio = ratios(EDGES * rng.lognormal(0, 0.25, (SETS, *EDGES.shape)))
    change = changes(ratio)
    return (
        xr.Dataset(coords={"surface": SUBSTRATES})
        .assign_coords(
            set=np.arange(1, SETS + 1),
            contact_model=CONTACT_MODELS,
            rho=RHO,
            minimum=[1, 2, 3],
            side=SIDES,
            group=[*SUBSTRATES, "pooled"],
            cutoff_wavelength=CUTOFFS,
        )
        .assign(_fits(mean_forces(FINE, approach)) | _facts(rng, deviation))
        .assign(
            mean_force=(by_range, force, NEWTON),
            ratio=(by_range, force / force[:, :, [1]], ONE),
            scale_ratio=(("set", *RATIO_DIMS), ratio, ONE),
            scale_change=(("set", *CHANGE_DIMS), change, ONE),
            critical_wavelength=(("set", "side", "group"), critical_wavelengths(change), NANOMETRE),
        )
        .isel(cutoff_wavelength=slice(1, -1))  # fewer cutoffs than the study
    )


def _fits(forces: np.ndarray) -> dict[str, tuple]:
    """Return the minima of the error of forces (set, contact_model, surface, rho) on FINE."""
    found = minima(*least_errors(forces))
    variables = {}
    for row, (name, best, unit) in enumerate(
        (
            ("range", "range_of_adhesion", "nm"),
            ("work", "work_of_adhesion", "J m-2"),
            ("error", "best_error", "1"),
        )
    ):
        values, attributes = found[:, :, row], {"units": unit}
        variables[f"minimum_{name}"] = ("set", "contact_model", "minimum"), values, attributes
        variables[best] = ("set", "contact_model"), values[..., 0], attributes
    return variables


def _facts(rng: np.random.Generator, deviation: np.ndarray) -> dict[str, tuple]:
    """Return facts (set, surface): the height as published in each set, the others scattered."""
    dims, variables = ("set", "surface"), {}
    for name, quantity, unit, scatters, follows in (
        ("rms_height", "afm_rms_height", "nm", 0, 0),
        ("rms_gradient", "afm_rms_slope", "1", 0.05, 0),
        ("rms_half_laplacian", "afm_rms_curvature", "nm-1", 0.05, 0.05),
    ):
        value, spread = map(np.array, TABLE1[quantity])
        scatter = scatters * rng.normal(size=deviation.shape)
        variables[name] = dims, value * np.exp(scatter + follows * deviation), {"units": unit}
        variables[f"{name}_std"] = dims, spread * np.exp(2 * scatter), {"units": unit}
    return variables
