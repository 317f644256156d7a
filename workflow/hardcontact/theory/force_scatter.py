"""The scatter of the pull-off force over positions and scans, by the law and as it is measured.

The law is that of `pull_off_statistics`. Measured are published and computed forces, and the forces
on designed surfaces.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
import pandas as pd
import xarray as xr
from scipy import special

from hardcontact.base.statistics import lognormal_shape
from hardcontact.contact.contact import Contact
from hardcontact.surfaces.spectrum import Spectrum
from hardcontact.theory.pull_off_statistics import over_scans, predict_statistics
from hardcontact.theory.summits import search_size

#: Relative error of a mean force, for which contacts and scans are counted.
MEAN_ERROR = 0.05
#: Level of closest approach, in rms heights, above which the clumps that touch are rare. Below it
#: waves longer than the sphere reaches lift it with the surface.
MIN_TESTED_LEVEL = 2.0
#: Distance that samples of 400 from a distribution exceed once in twenty, 1.36/sqrt(400).
CHANCE = 0.068


def force_scatter(
    spectra: Mapping[str, Spectrum],
    contact: Contact,
    ranges: Sequence[float],
    deviations: Mapping[str, float],
    *,
    tolerance: float,
    confidence: float,
) -> xr.Dataset:
    """Return how the force on each surface scatters, by range of adhesion.

    spectra, deviations: by surface; the deviations are as of `over_scans`.
    contact: its range is replaced.
    ranges: in nm.
    tolerance, confidence: relative error of a mean, and the probability that it is not larger.
    Returns over (surface, rho) ``weibull_modulus``; the standard deviation of ln F over places,
        ``log_force_std``, and over places and scans, ``total_log_force_std``, and the latter from
        mean and median as of published forces (`lognormal_shape`), ``total_lognormal_shape``;
        ``contacts_needed`` for the mean of a surface, and ``scans_needed``, of one contact each,
        for that of all. Over surface ``search_size`` (nm) between independent places.
    """
    quantile = special.ndtri((1 + confidence) / 2)
    rows = []
    for surface, spectrum in spectra.items():
        deviation = deviations[surface]
        for rho in ranges:
            places = predict_statistics(spectrum, replace(contact, range=rho))
            scans = places
            if deviation:
                scans = over_scans(spectrum, replace(contact, range=rho), deviation)
            # A median above the mean is no log-normal's.
            total_shape = float(lognormal_shape(1, min(scans.median_over_mean, 1)))
            rows.append(
                {
                    "weibull_modulus": places.modulus,
                    "log_force_std": places.spread,
                    "total_log_force_std": scans.spread,
                    "total_lognormal_shape": total_shape,
                    "contacts_needed": (quantile * places.variation / tolerance) ** 2,
                    "scans_needed": (quantile * scans.variation / tolerance) ** 2,
                }
            )
    table = pd.DataFrame(rows)
    shape = (len(spectra), len(ranges))
    sizes = [search_size(spectrum, contact.radius, contact.area) for spectrum in spectra.values()]
    return xr.Dataset(
        {
            name: (("surface", "rho"), table[name].to_numpy().reshape(shape), {"units": "1"})
            for name in table
        }
        | {"search_size": ("surface", sizes, {"units": "nm"})},
        {
            "surface": list(spectra),
            "rho": ("rho", list(ranges), {"units": "nm", "long_name": "range of adhesion"}),
        },
        {"tolerance": tolerance, "confidence": confidence},
    )


def with_comparison(
    scatter: xr.Dataset, fit: xr.Dataset, pull_off: pd.DataFrame, table: pd.DataFrame
) -> xr.Dataset:
    """Return the predicted scatter of forces beside published and computed scatter.

    scatter: from `force_scatter`.
    pull_off: from `published.pull_off`.
    table: designed surfaces of `resources/validation/statistics.csv`.
    Returns `scatter` with ``published_log_force_std`` (surface) and ``computed_log_force_std``
        (surface) with its interval, NaN if there is none; ``designed_<column>`` (case) for the
        columns that give the error of the law, of which ``skewed`` is ``designed_skew_parameter``.
    """
    plastic = {"contact_model": "plastic", "pair": "published"}
    name = "lognormal_shape"
    names = {name: "computed_log_force_std", f"{name}_interval": "computed_log_force_std_interval"}
    computed = fit[list(names)].sel(plastic, drop=True).rename(names)
    published = pull_off.reindex(scatter["surface"].values)
    shapes = lognormal_shape(published["mean_force"], published["median_force"])
    columns = [
        "surface", "held_out", "skewed", "level", "weibull_modulus", "log_force_std",
        "predicted_log_force_std",
        *table.columns[table.columns.str.startswith("distance_")],
    ]  # fmt: skip
    designed = (
        table[columns]
        .rename(columns={"skewed": "skew_parameter"})
        .add_prefix("designed_")
        .rename_axis("case")
        .to_xarray()
    )
    for column in designed.data_vars.values():
        if column.dtype.kind == "f":
            column.attrs["units"] = "1"
    return (
        scatter.merge(computed.drop_vars(["label", "basis"], errors="ignore"), join="left")
        .merge(designed)
        .assign(published_log_force_std=("surface", shapes, {"units": "1"}))
    )


def held_out_surfaces(statistics: xr.Dataset) -> xr.Dataset:
    """Return the designed surfaces that tell the error of the law.

    They are Gaussian, were not looked at while it was made, and are touched above MIN_TESTED_LEVEL.
    """
    fair = (statistics["designed_held_out"] == 1) & (statistics["designed_skew_parameter"] == 0)
    high = statistics["designed_level"] >= MIN_TESTED_LEVEL
    return statistics.isel(case=np.flatnonzero(fair & high))
