"""How the pull-off forces of surfaces scatter: places, scans, and what is left of the published.

Forces on one surface differ from place to place by the law of `pull_off_statistics`, and from scan
to scan with its rms height. How many contacts and scans a mean needs follows.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
import pandas as pd
import xarray as xr
from numpy.polynomial.hermite_e import hermegauss
from scipy import stats

from hardcontact.insight.closed_form import Contact
from hardcontact.insight.pull_off_statistics import ForceStatistics, force_statistics
from hardcontact.insight.summits import draw_size
from hardcontact.numbers.statistics import lognormal_shape
from hardcontact.surfaces.spectrum import Spectrum

#: Relative error of a mean force, for which contacts and scans are counted.
MEAN_ERROR = 0.05
#: Shares of places at which quantiles are compared.
SHARES = (0.01, 0.05, 0.25, 0.5, 0.75, 0.95, 0.99)
#: Level of closest approach, in rms heights, above which the clumps that touch are rare. Below it
#: waves longer than the sphere reaches lift it with the surface.
LEAST_LEVEL = 2.0
#: Distance that samples of 400 from a distribution exceed once in twenty, 1.36/sqrt(400).
CHANCE = 0.068
#: Normal deviations of the rms height of a scan and their weights: with a deviation of half the
#: height, the variance of F is within 1 % of that by 61 of them.
NODES, WEIGHTS = hermegauss(15)
WEIGHTS /= WEIGHTS.sum()


def over_scans(spectrum: Spectrum, contact: Contact, deviation: float) -> ForceStatistics:
    """Return the distribution of the force over places of scans whose rms heights differ.

    The rms height of scans is normal; the deviation is its standard deviation over its mean.
    """
    scaled = [
        Spectrum(spectrum.wavevector, spectrum.density * max(1 + deviation * node, 0.0) ** 2)
        for node in NODES
    ]
    found = [force_statistics(one, contact) for one in scaled]
    weights = [weight * one.weights for weight, one in zip(WEIGHTS, found, strict=True)]
    return replace(
        found[len(NODES) // 2],
        means=np.concatenate([one.means for one in found]),
        weights=np.concatenate(weights),
        spreads=np.concatenate([one.spreads for one in found]),
    )


def force_scatter(
    spectra: Mapping[str, Spectrum],
    contact: Contact,
    ranges: Sequence[float],
    deviations: Mapping[str, float],
    settings: Mapping[str, float],
) -> xr.Dataset:
    """Return how the force on each surface scatters, by range of adhesion (nm).

    The deviations are those of `over_scans`, the settings ``tolerance`` and ``confidence`` of a
    mean. Over (surface, rho) ``modulus``, ``clumps``, ``summits``; the standard deviation of ln F
    over places, ``spread``, and over places and scans, ``total_spread``, and the latter as
    `lognormal_shape` tells it from mean and median, ``total_shape``, as of published forces;
    ``contacts_needed`` for the mean of a surface, and ``scans_needed``, of one contact each, for
    that of all. Over surface ``distance`` (nm) between independent places.
    """
    quantile = stats.norm.ppf((1 + settings["confidence"]) / 2)
    names = ("modulus", "clumps", "summits", "spread", "total_spread", "total_shape")
    needed = ("contacts_needed", "scans_needed")
    rows: dict[str, list[list[float]]] = {name: [] for name in (*names, *needed)}
    for surface, spectrum in spectra.items():
        of_surface: list[list[float]] = []
        for rho in ranges:
            there = replace(contact, rho=rho)
            one = force_statistics(spectrum, there)
            deviation = deviations[surface]
            scans = over_scans(spectrum, there, deviation) if deviation else one
            counts = [
                (quantile * law.variation / settings["tolerance"]) ** 2 for law in (one, scans)
            ]
            # A median above the mean is no log-normal's.
            shape = float(lognormal_shape(1, min(scans.median_over_mean, 1)))
            spreads = [one.spread, scans.spread, shape]
            of_surface.append([one.modulus, one.clumps, one.summits, *spreads, *counts])
        for name, column in zip(rows, zip(*of_surface, strict=True), strict=True):
            rows[name].append(list(column))
    sizes = [draw_size(one, contact.radius, contact.area) for one in spectra.values()]
    return xr.Dataset(
        {name: (("surface", "rho"), values, {"units": "1"}) for name, values in rows.items()}
        | {"distance": ("surface", sizes, {"units": "nm"})},
        {
            "surface": list(spectra),
            "rho": ("rho", list(ranges), {"units": "nm", "long_name": "range of adhesion"}),
        },
        dict(settings),
    )


def with_comparison(
    scatter: xr.Dataset, inference: xr.Dataset, pull_off: pd.DataFrame, table: pd.DataFrame
) -> xr.Dataset:
    """Return `force_scatter` beside published and computed spreads, and the errors of the law.

    Inference and published statistics are those of the paper's study: ``published_spread`` and
    ``computed_spread`` with its interval (surface), NaN where there is none. The table is that of
    designed surfaces in `resources/validation`: ``designed_<column>`` (case) and
    ``designed_quantile`` (case, share), computed over predicted.
    """
    at, name = {"contact_model": "plastic", "pair": "published"}, "lognormal_shape"
    names = {name: "computed_spread", f"{name}_interval": "computed_spread_interval"}
    computed = inference[list(names)].sel(at, drop=True).rename(names)
    known = pull_off.reindex(scatter["surface"].values)
    shapes = lognormal_shape(known["mean_force"], known["median_force"])
    quantiles = table[[f"quantile_{100 * share:g}" for share in SHARES]]
    others = table.drop(columns=quantiles.columns).add_prefix("designed_")
    return (
        scatter.merge(computed.drop_vars(["label", "basis"], errors="ignore"), join="left")
        .merge(others.rename_axis("case").to_xarray())
        .assign(
            published_spread=("surface", shapes, {"units": "1"}),
            designed_quantile=(("case", "share"), quantiles.to_numpy(), {"units": "1"}),
        )
        .assign_coords(share=list(SHARES))
    )


def held_back(statistics: xr.Dataset) -> xr.Dataset:
    """Return the designed surfaces that tell the error of the law.

    They are Gaussian, were not looked at while it was made, and are touched above LEAST_LEVEL.
    """
    fair = (statistics["designed_held_back"] == 1) & (statistics["designed_skewed"] == 0)
    high = statistics["designed_level"] >= LEAST_LEVEL
    return statistics.isel(case=np.flatnonzero(fair & high))
