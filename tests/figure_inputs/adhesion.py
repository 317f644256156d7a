"""Datasets of forces: adhesion, its inference, scales of roughness, robustness."""

import numpy as np
import xarray as xr
from paper_numbers import MEAN_FORCE, SUBSTRATES

from figure_inputs.building import SCANS, SPHERE_SCANS, bounded, generator, named

CONTACT_MODELS = ["rigid", "plastic"]
RHO = np.geomspace(0.3, 20, 13)
RANGE, WORK = 5.2, 0.0447
REALIZATIONS = 5
SMALL_CUTOFFS, LARGE_CUTOFFS = np.geomspace(5, 2000, 10), np.geomspace(150, 10000, 10)
VARIANTS = {  # group
    "baseline": "baseline",
    "laplacian": "curvature",
    "gaussian": "heights",
    "rough_sphere": "sphere",
    "preload-5uN": "preload",
    "preload-20uN": "preload",
}


def _mean_force() -> np.ndarray:
    """Return forces (surface, rho) in N at W = 1 J/m2, near the published ones at W = WORK."""
    steepness = np.array([1.6, 1.0, 0.35, 0.25])[:, None]
    factor = np.array([2.3, 1.3, 0.8, 1.3])[:, None]
    return MEAN_FORCE[:, None] / WORK * factor * (RHO / RANGE) ** steepness


def adhesion() -> xr.Dataset:
    """Return log-normal forces about `_mean_force`."""
    rng = generator()
    size = (SCANS, SPHERE_SCANS, 1, 6, 6)
    scatter = np.stack([rng.lognormal(-(s**2) / 2, s, size) for s in (1.0, 0.7, 0.8, 0.9)])
    force = np.einsum("asbcij,ar->asbcrij", scatter, _mean_force())
    data = named().assign_coords(contact_model=CONTACT_MODELS, rho=RHO)
    data["pull_off_force"] = (
        ("surface", "scan", "sphere_scan", "contact_model", "rho", "contact_y", "contact_x"),
        np.concatenate([0.3 * force, force], axis=3),
    )
    return data.assign_attrs(work_of_adhesion=1.0)


def inference() -> xr.Dataset:
    """Return an inference with a sharp error map about RANGE and WORK."""
    rng, model = generator(), "contact_model"
    rho_fine, work = np.geomspace(0.5, 15, 60), np.geomspace(0.01, 0.2, 50)
    force = np.stack([0.3 * _mean_force(), _mean_force()])
    fitted = force[:, :, 8] * WORK
    error = 0.03 + np.hypot(np.log(rho_fine / RANGE)[:, None], np.log(work / WORK))
    region = [[[np.nan] * 2] * 2, [[5.1, 5.3], [0.044, 0.046]]]
    return (
        named()
        .assign_coords(contact_model=CONTACT_MODELS, rho=RHO, rho_fine=rho_fine, work=work)
        .assign(
            bounded("mean_force", (model, "surface", "rho"), force, unit="N")
            | bounded("ratio", (model, "surface", "rho"), force / force[:, [1]])
            | bounded("range_from_ratios", model, [3.0, 4.9], unit="nm")
            | bounded("range_of_adhesion", model, [3.0, RANGE], unit="nm")
            | bounded("work_of_adhesion", model, [0.2, WORK], unit="J m-2")
            | bounded("lognormal_shape", (model, "surface"), np.full((2, 4), 0.8))
            | bounded("lognormal_median", (model, "surface"), 0.7 * fitted, unit="N")
            | bounded("force_mean", (model, "surface"), fitted, unit="N")
            | bounded("force_median", (model, "surface"), 0.7 * fitted, unit="N")
            | bounded("censored_fraction", (model, "surface"), np.full((2, 4), 0.1))
        )
        .assign(
            mean_relative_error=((model, "rho_fine", "work"), np.stack([error + 1, error])),
            best_error=(model, [1.03, 0.03]),
            region_range=((model, "bound"), np.array(region)[:, 0]),
            region_work=((model, "bound"), np.array(region)[:, 1]),
            bootstrap_range=((model, "sample"), RANGE * rng.lognormal(0, 0.15, (2, 300))),
            bootstrap_work=((model, "sample"), WORK * rng.lognormal(0, 0.2, (2, 300))),
        )
        .assign_attrs(error_threshold=0.1, force_floor=30e-9, confidence=0.9)
    )


def band() -> xr.Dataset:
    """Return ratio curves that leave the band but for one, NaN where a side has no cutoff."""
    cutoff = np.unique([*SMALL_CUTOFFS, *LARGE_CUTOFFS])
    reach = np.array([8.0, 2.0, 3.0, 3.5, 3.0])
    small = 1 + (cutoff / (20 * reach[:, None])) ** 1.2 / 10
    large = 1 + (8000 / reach[:, None] / cutoff) ** 1.2 / 20
    small[:, ~np.isin(cutoff, SMALL_CUTOFFS)] = np.nan
    large[:, ~np.isin(cutoff, LARGE_CUTOFFS)] = np.nan
    critical = np.stack([20 * reach, 5000 / reach])
    critical[1, 0] = np.nan
    ratio_dims = ("side", "group", "cutoff_wavelength")
    return (
        named()
        .assign_coords(
            side=["small", "large"], group=[*SUBSTRATES, "pooled"], cutoff_wavelength=cutoff
        )
        .assign(
            bounded("scale_ratio", ratio_dims, np.stack([small, large]))
            | bounded("critical_wavelength", ("side", "group"), critical, 0.7, 1.5, "nm")
        )
        .assign_attrs(scale_tolerance=0.1, confidence=0.9)
    )


def scales() -> xr.Dataset:
    """Return single realizations about the curves of `band`."""
    ratio = band()["scale_ratio"].sel(group=SUBSTRATES).rename(group="surface")
    scatter = xr.DataArray(generator().lognormal(0, 0.15, REALIZATIONS), dims="realization")
    realization = np.arange(1, REALIZATIONS + 1)
    return named().assign(ratio=ratio**scatter).assign_coords(realization=realization)


def robustness() -> xr.Dataset:
    """Return variants, one of which changes the critical wavelengths alone."""
    rng, count = generator(), len(VARIANTS)
    spread = rng.uniform(0.5, 1.5, count)
    spread[list(VARIANTS).index("rough_sphere")] = np.nan
    critical = np.array([43, 1800]) * rng.uniform(0.6, 1.4, (count, 2))
    return xr.Dataset(
        bounded("range_of_adhesion", "variant", 5.6 * spread, 0.7, 1.5, "nm")
        | bounded("work_of_adhesion", "variant", 0.046 / spread, 0.7, 1.5, "J m-2")
        | bounded("critical_wavelength", ("variant", "side"), critical, 0.7, 1.5, "nm"),
        coords={
            "variant": list(VARIANTS),
            "variant_label": ("variant", [f"with {name}" for name in VARIANTS]),
            "group": ("variant", list(VARIANTS.values())),
            "side": ["small", "large"],
        },
        attrs={"realizations": 3, "pixels_small": 4096, "pixels_large": 4096, "count": 10},
    )
