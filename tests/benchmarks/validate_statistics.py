"""The distributions of predicted and computed forces on designed surfaces: statistics.nc, .csv.

    nice python tests/benchmarks/validate_statistics.py [--surfaces 80] [--dataset FILE]

Forces are computed as the study computes them, in rigid and plastic contact of a smooth sphere, on
random surfaces of the kinds of `validate_prediction`. Every fifth surface is skewed: the heights of
a Gaussian surface are mapped through a growing exponential or its mirror image. Existing surfaces
of the dataset are kept, so that a run continues an earlier one. The table compares the law with all
of them. resources/validation/README.md describes both.
"""

import argparse
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr
from scipy import special, stats
from validate_prediction import HARDNESS, sample_inputs, spectrum_of

from hardcontact.base import dataset
from hardcontact.base.random import generator
from hardcontact.contact.contact import Contact, contact_of_area
from hardcontact.contact.geometry import bodies
from hardcontact.contact.pull_off import pull_off_of_pair
from hardcontact.contact.smooth_sphere import dmt_pull_off
from hardcontact.surfaces.height_map import HeightMap
from hardcontact.surfaces.synthesis import random_surface
from hardcontact.theory.closed_form_errors import spectrum_of_grid
from hardcontact.theory.pull_off_statistics import predict_statistics

#: Shares of places at which quantiles are compared.
SHARES = (0.01, 0.05, 0.25, 0.5, 0.75, 0.95, 0.99)

DATASET = Path(__file__).parents[2] / "resources/validation/statistics.nc"
SEED, PLACES = 20261124, 400
#: Smallest and largest value of each input, as in `validate_prediction`.
BOUNDS = {
    "rolloff": (300.0, 4000.0),
    "steepness": (1 / 400, 1 / 20),
    "hurst": (0.4, 0.95),
    "radius": (5e3, 5e5),
    "weibull_modulus": (0.1, 10.0),  # rho/sigma of it at the level LEVEL
    "area": (50.0, 5000.0),
    "kind": (0.0, 1.0),
}
#: Level of closest approach that the design expects, and ranges (nm) that it keeps to.
LEVEL, RANGES = 3.3, (0.3, 40.0)
#: Every how many surfaces are skewed, and how: exp(SKEWED z) of normal z has the skewness 0.61.
EVERY, SKEWED = 5, 0.2
#: Pixels and places along a side; the cheapest that resolve the contact are taken.
PIXELS, COUNTS = (512, 1024, 2048), (10, 8, 6, 5, 4)


def design(surfaces: int) -> list[dict[str, Any]]:
    """Return the inputs of the first surfaces of the design."""
    rows = []
    for row in sample_inputs(BOUNDS, SEED, surfaces):
        row["rho"] = float(np.clip(row.pop("weibull_modulus") * row["rms_height"] / LEVEL, *RANGES))
        skewed = row["surface"] % EVERY == EVERY - 1
        row["skewed"] = (SKEWED if row["surface"] % 2 else -SKEWED) if skewed else 0.0
        rows.append(row | grid(row))
    return rows


def grid(row: dict[str, Any]) -> dict[str, Any]:
    """Return the cheapest grid that has three pixels along the contact and 16 a roll-off.

    The spacing of places exceeds the roll-off and twice the distance in which the sphere finds its
    summits or attracts. If no grid has this resolution, the finest is returned.
    """
    reach = 2 * np.sqrt(2 * row["radius"] * max(row["rms_height"] / LEVEL, row["rho"]))
    spacing, finest = max(row["rolloff"], reach), min(np.sqrt(row["area"]) / 3, row["rolloff"] / 16)
    grids = [
        (-(-PLACES // count**2) * pixels**2, count, pixels)
        for count in COUNTS
        for pixels in PIXELS
        if count * spacing / pixels <= finest
    ]
    _, count, pixels = min(grids, default=(0, COUNTS[-1], PIXELS[-1]))
    size = count * spacing
    preload = row["area"] * HARDNESS * 1e-18
    contact = Contact(radius=row["radius"], preload=preload, hardness=HARDNESS)
    return {
        "size": size,
        "pixels": pixels,
        "places_along_edge": count,
        "shortest": 4 * size / pixels,
        "area": contact.pixel_count(size / pixels) * (size / pixels) ** 2,
    }


def skew_heights(surface: HeightMap, row: dict[str, Any]) -> HeightMap:
    """Return a surface with skewed heights of the same mean and rms height."""
    if not row["skewed"]:
        return surface
    z, steep = surface.heights / row["rms_height"], row["skewed"]
    grown = np.expm1(steep * z) - np.expm1(steep**2 / 2)
    rms = np.sqrt(np.expm1(steep**2)) * np.exp(steep**2 / 2)
    surface.heights[...] = np.sign(steep) * row["rms_height"] * grown / rms
    return surface


def compute_forces(row: dict[str, Any]) -> xr.Dataset:
    """Return the inputs, and forces and closest approach (contact model, place) of a surface."""
    spectrum, pixels = spectrum_of(row), row["pixels"]
    wide = 12 * np.sqrt(row["radius"] * max(row["rho"], row["rms_height"]))
    contact = Contact(
        radius=row["radius"],
        preload=row["area"] * HARDNESS * 1e-18,
        hardness=HARDNESS,
        window=max(wide, 32 * row["size"] / pixels),
        count=row["places_along_edge"],
    )
    pair_forces = []
    for realization in range(-(-PLACES // row["places_along_edge"] ** 2)):
        rng = generator(SEED, row["surface"], realization, "statistics")
        surface = skew_heights(random_surface(rng, pixels, row["size"] / pixels, spectrum), row)
        pair = bodies(surface, None, contact)
        pair_forces.append(pull_off_of_pair(pair, contact, [row["rho"]]).squeeze("rho", drop=True))
    axes = ["realization", "contact_y", "contact_x"]
    all_contacts = xr.concat(pair_forces, "realization").stack(place=axes).isel(place=slice(PLACES))
    axis_names, smooth = ("contact_model", "place"), float(dmt_pull_off(1.0, row["radius"]))
    relative = all_contacts["pull_off_force"].transpose(*axis_names).values / smooth
    level = all_contacts["apex_height"].transpose(*axis_names).values / row["rms_height"]
    return xr.Dataset(
        {
            "log_force": (
                axis_names,
                np.log(relative),
                {"units": "1", "long_name": "ln(F/2 pi R W)"},
            ),
            "level": (
                axis_names,
                level,
                {"units": "1", "long_name": "closest approach, rms heights"},
            ),
            **{name: value for name, value in row.items() if name != "surface"},
        },
        {"contact_model": ["rigid", "plastic"], "surface": row["surface"]},
    )


def compare_distributions(surface_forces: xr.Dataset) -> Iterator[dict[str, Any]]:
    """Yield the inputs of a surface, the law and its distances, in rigid and plastic contact.

    Distances are Kolmogorov-Smirnov statistics. Distributions have the mean of the forces; the
    fitted log-normal has their mean and deviation of ln F.
    """
    row = {name: value.item() for name, value in surface_forces.variables.items() if not value.ndim}
    waves = spectrum_of_grid(spectrum_of(row), row["size"], row["pixels"])
    for model, area in (("rigid", 0.0), ("plastic", row["area"])):
        law = predict_statistics(waves, contact_of_area(row["radius"], row["rho"], 1.0, area))
        logs = surface_forces["log_force"].sel(contact_model=model).values
        forces = np.exp(logs) / np.exp(logs).mean()
        k = law.modulus or np.nan  # no law of Weibull below the mean plane
        weibull = stats.weibull_min(k, scale=1 / special.gamma(1 + 1 / k))
        fitted = stats.norm(np.log(forces).mean(), logs.std())
        narrow = stats.norm(-(law.spread**2) / 2, law.spread)
        quantiles = np.quantile(forces, SHARES) / (law.quantile(SHARES) / law.force)
        yield row | {
            "contact_model": model,
            "area": area,
            "level": surface_forces["level"].sel(contact_model=model).values.mean(),
            "log_force_std": logs.std(),
            "predicted_log_force_std": law.spread,
            "weibull_modulus": law.modulus,
            "clumps": law.clumps,
            "force_over_predicted": np.exp(logs).mean() * 2e-9 * np.pi * row["radius"] / law.force,
            "distance_law": stats.kstest(forces * law.force, law.probability).statistic,
            "distance_weibull": stats.kstest(forces, weibull.cdf).statistic,
            "distance_lognormal_fitted": stats.kstest(np.log(forces), fitted.cdf).statistic,
            "distance_lognormal_of_law": stats.kstest(np.log(forces), narrow.cdf).statistic,
            **{f"quantile_{100 * share:g}": q for share, q in zip(SHARES, quantiles, strict=True)},
        }


def main() -> None:
    """Compute the surfaces that the dataset lacks, and write it after each; then the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--surfaces", type=int, default=80, help="of the design")
    parser.add_argument("--dataset", type=Path, default=DATASET)
    arguments = parser.parse_args()
    path: Path = arguments.dataset
    done = [dataset.read(str(path))] if path.exists() else []
    for row in design(arguments.surfaces)[len(done and done[0]["surface"]) :]:
        done = [xr.concat([*done, compute_forces(row).expand_dims("surface")], "surface")]
        rounded = {"dtype": "int16", "scale_factor": 1e-3, "zlib": True, "_FillValue": -32768}
        done[0].to_netcdf(path, encoding=dict.fromkeys(("log_force", "level"), rounded))
    surfaces = (done[0].isel(surface=index) for index in range(done[0].sizes["surface"]))
    table = pd.DataFrame(
        [row for surface_forces in surfaces for row in compare_distributions(surface_forces)]
    )
    table.to_csv(path.with_suffix(".csv"), index=False, float_format="%.4g", lineterminator="\n")


if __name__ == "__main__":
    main()
