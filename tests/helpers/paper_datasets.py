"""Small datasets and Table 1 for the page of the paper's study."""

import numpy as np
import pandas as pd
import xarray as xr
from intervals import between_multiples
from paper_numbers import LABELS, SUBSTRATES, TABLE1

#: Cutoffs of both sides in nm.
CUTOFFS = {
    "short": [20.0, 30, 36, 43, 52, 62, 80, 120, 250],
    "long": [500.0, 800, 1100, 1400, 1600, 1800, 2000, 2300, 2700, 3500],
}
SET_COUNT = 100


def published_table1() -> pd.DataFrame:
    """Return Table 1."""
    return pd.DataFrame(
        {"surface": surface, "quantity": quantity, "value": value, "uncertainty": uncertainty}
        for quantity, columns in TABLE1.items()
        for surface, value, uncertainty in zip(SUBSTRATES, *columns, strict=True)
    )


def topography(pixels: int = 512) -> xr.Dataset:
    """Return surfaces with the published rms values; scans have them by construction."""
    names = [*SUBSTRATES, "ruby"]
    printed = {name: np.array(values) for name, (values, _) in TABLE1.items()}
    scan_rms, all_scales = (
        {
            "rms_height": printed[f"{source}_rms_height"],
            "rms_gradient": printed[f"{source}_rms_slope"],
            "rms_profile_slope": printed[f"{source}_rms_slope"] / np.sqrt(2),
            "rms_half_laplacian": printed[f"{source}_rms_curvature"],
            "rms_laplacian": printed[f"{source}_rms_curvature"] * 2,
        }
        for source in ("afm", "all")
    )
    rms_values = {f"{name}_mean": [*values, 0.7] for name, values in scan_rms.items()}
    rms_values |= {f"{name}_std": [*(0.1 * values), 0.07] for name, values in scan_rms.items()}
    rms_values |= {f"all_scales_{name}": [*values, np.nan] for name, values in all_scales.items()}
    constructed = "afm_rms_height,afm_rms_slope,afm_rms_curvature"
    return xr.Dataset(
        {name: ("surface", values) for name, values in rms_values.items()}
        | {
            "label": ("surface", [*LABELS, "ruby"]),
            "source": ("surface", ["substitute"] * len(names)),
            "scan_size": ("surface", [2500.0] * len(names)),
            "table1_rows_met": ("surface", [constructed] * len(SUBSTRATES) + [""]),
            "example_heights": (("surface", "row"), np.zeros((len(names), pixels))),
        },
        {"surface": names},
        {"sphere_surface": "ruby"},
    )


def band() -> xr.Dataset:
    """Return both edges of each group, and changes of 0.1 at the cutoffs of each side."""
    cutoffs = np.concatenate(list(CUTOFFS.values()))
    is_computed = np.array([np.isin(cutoffs, side_cutoffs) for side_cutoffs in CUTOFFS.values()])
    groups = [*SUBSTRATES, "averaged"]
    change = xr.DataArray(np.where(is_computed, 0.1, np.nan), dims=("side", "cutoff_wavelength"))
    edges = [[60.0] * 5, [1667.0] * 5]
    return xr.Dataset(
        {
            "filtered_force_change": change.expand_dims(group=groups),
            "edge_bound": (("side", "group"), np.full((2, 5), np.nan)),
        }
        | between_multiples("edge", ("side", "group"), edges, (0.9, 1.15)),
        {"side": list(CUTOFFS), "cutoff_wavelength": cutoffs, "surface": SUBSTRATES},
        {"tolerance": 0.1, "confidence": 0.9},
    )


def sensitivity() -> xr.Dataset:
    """Return how the force follows each octave; the strongest octave begins at 640 nm."""
    octaves = np.array([80.0, 160.0, 320.0, 640.0, 1280.0])
    values = np.tile([-0.1, -0.4, -0.6, -0.8, -0.2], (len(SUBSTRATES), 1))
    return xr.Dataset(
        {
            "octave_sensitivity": (("surface", "octave"), values),
            "map_size": ("surface", [20_000.0] * len(SUBSTRATES)),
        },
        {"surface": SUBSTRATES, "octave": octaves},
    )


def band_forces() -> xr.Dataset:
    """Return the forces with a part of the roughness, 1.05 times those with all of it."""
    parts = ["only the band", "no shorter waves", "no longer waves"]
    ratio = np.full((len(SUBSTRATES), 2, len(parts)), 1.05)
    axes = ("surface", "band", "band_part")
    return xr.Dataset(
        between_multiples("band_force_ratio", axes, ratio, (0.95, 1.05)),
        {"surface": SUBSTRATES, "band": ["published", "computed"], "band_part": parts},
    )


def edge_shifts() -> xr.Dataset:
    """Return short edges of 50 nm, of each contact model and range."""
    return xr.Dataset(
        {"edge": (("contact_model", "rho", "side", "group"), np.full((2, 2, 1, 5), 50.0))},
        {"contact_model": ["rigid", "plastic"], "rho": [1.0, 5.6], "side": ["short"],
         "group": [*SUBSTRATES, "averaged"]},
    )  # fmt: skip


def sets() -> xr.Dataset:
    """Return sets with fewer cutoffs than the study; 58 % have ranges above 5 nm, others below."""
    scatter = np.random.default_rng(1).lognormal(0, 0.1, (SET_COUNT, 2))
    ranges = np.where(np.arange(SET_COUNT) < 58, 9.0, 1.3)[:, None] * scatter
    fits = ("set", "contact_model")
    # The standard deviation of ln(range) without each surface is least without the first.
    spread = np.array([0.3, 0.9, 0.9, 0.9])[:, None, None]
    scatter_without = np.random.default_rng(2).lognormal(0, spread, (len(SUBSTRATES), SET_COUNT, 2))
    edge_factor = xr.DataArray(np.linspace(0.9, 1.3, SET_COUNT), dims="set")
    return xr.Dataset(
        {
            "range_of_adhesion": (fits, ranges),
            "work_of_adhesion": (fits, 0.12 / ranges),
            "filtered_force_change": band()["filtered_force_change"].isel(
                cutoff_wavelength=slice(1, -1)
            ),
            "edge": edge_factor * band()["edge"],
            "edge_bound": edge_factor * band()["edge_bound"],
            "range_without_surface": (("left_out", *fits), 5.6 * scatter_without),
            "work_without_surface": (("left_out", *fits), 0.046 / scatter_without),
        },
        {"contact_model": ["rigid", "plastic"], "left_out": SUBSTRATES},
        {"confidence": 0.9},
    )


def filtered_forces(contacts: int = 20) -> xr.Dataset:
    """Return forces on filtered surfaces, with a number of contacts and realizations."""
    forces = ("contact_y", "realization"), np.ones((contacts, 5))
    transitions = ("side", [20.0, 1000.0])
    return xr.Dataset(
        {"pull_off_force": forces, "transition": transitions},
        {"side": ["short", "long"]},
        attrs={"rho": 5.6},
    )


def fit() -> xr.Dataset:
    """Return the mean forces of the coatings, 1 µN to 4 µN, at the published pair."""
    mean = 1e-6 * np.arange(1.0, len(SUBSTRATES) + 1)[None, None]
    axes = ("contact_model", "pair", "surface")
    return xr.Dataset(
        between_multiples("mean_force_at_pair", axes, mean, (0.9, 1.1), units="N"),
        {"surface": SUBSTRATES, "pair": ["published"], "contact_model": ["plastic"]},
    )


def scan_size() -> xr.Dataset:
    """Return force ratios on mirrored scans of three sizes, and on whole surfaces of two sizes."""
    ratio = 2 - np.arange(4 * 5.0).reshape(4, 5) / 20
    forces = between_multiples(
        "force_over_largest", ("surface", "map_size"), ratio, (0.8, 1.2), 0.9, units="1"
    )
    return xr.Dataset(
        forces | {"mirrored": ("map_size", [1, 1, 1, 0, 0])},
        {"surface": SUBSTRATES, "map_size": [1250.0, 2500.0, 5000.0, 20e3, 40e3]},
    )


def features() -> xr.Dataset:
    """Return forces on candidates with features; one of two with bumps agrees with the paper."""
    axes = ("features", "candidate")
    forces = np.array([[8e-6, 20e-6], [30e-6, 40e-6], [20e-6, 25e-6]])
    return xr.Dataset(
        {
            "mean_force_at_pair": (axes, forces),
            "median_force_at_pair": (axes, 0.2 * forces),
            "log_force_std": (axes, [[1.8, 2.0], [0.2, 0.3], [0.4, 0.4]]),
            "agrees": (axes, [[1.0, 0.0], [0.0, 0.0], [0.0, 0.0]]),
        },
        {"features": ["bumps", "pits", "gaussian"], "candidate": [1, 2]},
        {
            "surface": SUBSTRATES[0],
            "label": LABELS[0],
            "published_mean_force": 8.8e-6,
            "published_median_force": 1.75e-6,
            "published_log_force_std": 1.8,
        },
    )
