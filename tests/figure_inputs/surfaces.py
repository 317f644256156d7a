"""The dataset of topography."""

import json

import numpy as np
import xarray as xr
from paper_numbers import LABELS, SUBSTRATES, TABLE1

from figure_inputs.building import named
from hardcontact.surfaces.height_map import table1_variables


def topography() -> xr.Dataset:
    """Return surfaces whose moments are the published ones, those of scans by construction."""
    printed = {name: values for name, (values, _) in TABLE1.items()}
    rms = np.array([*printed["afm_rms_height"], 0.7])
    data = named([*SUBSTRATES, "ruby"], [*LABELS, "ruby"])
    data["scan_size"] = "surface", np.full(5, 2500.0)
    slope = np.array([*printed["afm_rms_slope"], 0.01])
    curvature = np.array([*printed["afm_rms_curvature"], 5e-4])
    means = {
        "rms_height": rms,
        "rms_gradient": slope,
        "rms_profile_slope": slope / np.sqrt(2),
        "rms_half_laplacian": curvature,
        "rms_laplacian": curvature * 2,
    }
    for name, values in means.items():
        data[f"{name}_mean"] = "surface", values
        data[f"{name}_std"] = "surface", values * 0.1
    data["rms_height_std"] = "surface", [*TABLE1["afm_rms_height"][1], 0.07]
    data["all_scales_rms_height"] = "surface", [*printed["all_rms_height"], np.nan]
    data["all_scales_rms_gradient"] = "surface", [*printed["all_rms_slope"], np.nan]
    data["all_scales_rms_half_laplacian"] = "surface", [*printed["all_rms_curvature"], np.nan]
    data["all_scales_rms_profile_slope"] = data["all_scales_rms_gradient"] / np.sqrt(2)
    data["all_scales_rms_laplacian"] = data["all_scales_rms_half_laplacian"] * 2
    rows = "afm_rms_height,afm_rms_slope,afm_rms_curvature"
    data["calibrated_to_table1"] = "surface", [rows] * 4 + [""]
    return data.assign_attrs(
        sphere_surface="ruby",
        reference_surface="uncd",
        table1_variables=json.dumps(table1_variables("gradient", "half_laplacian")),
    )
