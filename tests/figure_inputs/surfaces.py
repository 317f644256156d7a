"""The dataset of topography."""

import json

import numpy as np
import xarray as xr
from paper_numbers import LABELS, SUBSTRATES, TABLE1

from figure_inputs.building import RADIUS, generator, named
from hardcontact.surfaces.height_map import table1_variables


def _rough(rng: np.random.Generator, rms: float, pixels: int = 48) -> np.ndarray:
    """Return a random map (nm) of the given rms whose waves grow with their length."""
    q = np.hypot(np.fft.fftfreq(pixels)[:, None], np.fft.rfftfreq(pixels))
    q[0, 0] = np.inf
    heights = np.fft.irfft2(np.fft.rfft2(rng.normal(size=(pixels, pixels))) * q**-1.6)
    return heights * rms / heights.std()


def topography() -> xr.Dataset:
    """Return surfaces whose moments are the published ones, those of scans by construction."""
    rng = generator()
    printed = {name: values for name, (values, _) in TABLE1.items()}
    rms = np.array([*printed["afm_rms_height"], 0.7])
    data = named([*SUBSTRATES, "ruby"], [*LABELS, "ruby"])
    maps = np.stack([_rough(rng, height) for height in rms])
    data["example_heights"] = ("surface", "row", "column"), maps
    place = np.linspace(-1250, 1250, maps.shape[-1])
    cap = -(place[:, None] ** 2 + place**2) / (2 * RADIUS)
    data["sphere_as_scanned"] = data["example_heights"].sel(surface="ruby", drop=True) + cap
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
