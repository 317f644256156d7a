"""Measured pull-off forces on one surface: their mean, and its uncertainty.

Forces scatter between sites of a surface, so that sites, not forces, are the independent samples.
"""

from statistics import NormalDist
from typing import NamedTuple

import numpy as np
import pandas as pd

from hardcontact.base.statistics import MAX_LOG_DEVIATION, log_std_of_lognormal

#: Chance that forces at different sites are mistaken for forces at repeated sites.
REPEATED_BY_CHANCE = 1e-3


class ForceSummary(NamedTuple):
    """Mean and scatter of the forces measured on one surface, log-normal between sites."""

    mean: float  #: Mean over sites in N.
    log_std: float  #: Standard deviation of ln F between sites; NaN for a single site.
    site_count: int  #: Number of sites, each an independent sample.
    force_count: int  #: Number of forces.
    look_repeated: bool = False  #: Whether forces without sites look as if several share a site.


def summarize_forces(forces: pd.DataFrame) -> ForceSummary:
    """Return mean and scatter of one surface's rows of the table of measured forces.

    Forces at one site are one sample, their mean; a force without a site has its own.
    """
    force_count = int(forces["count"].sum())
    if len(forces) == 1:
        mean, median = float(forces["mean"].iloc[0]), forces["median"].iloc[0]
        log_std = float(log_std_of_lognormal(mean, median)) if force_count > 1 else np.nan
        # A row does not tell the sites of its forces.
        return ForceSummary(mean, log_std, site_count=force_count, force_count=force_count)
    has_site = forces["site"] != ""
    sites = forces["site"].where(has_site, forces.index)
    means = forces["mean"].groupby(sites, sort=False).mean()
    log_std = float(np.log(means).std(ddof=1))
    mean, site_count = float(means.mean()), len(means)
    return ForceSummary(mean, log_std, site_count, force_count, look_repeated(forces))


def look_repeated(forces: pd.DataFrame) -> bool:
    """Return whether forces on one surface without sites look as if several share a site.

    Then few values are distinct, or von Neumann's ratio at some lag of rows is below one, its value
    for independent forces: half the mean squared difference of ln F, over the variance of ln F.
    """
    logs = np.log(forces["mean"].to_numpy(float))
    if (forces["site"] != "").any() or len(logs) < 3:
        return False
    if 2 * len(np.unique(logs)) <= len(logs):
        return True
    lags = np.arange(1, len(logs) // 2 + 1)
    ratios = [np.mean((logs[lag:] - logs[:-lag]) ** 2) / (2 * logs.var(ddof=1)) for lag in lags]
    # For independent forces the ratio scatters about 1 by 1/sqrt(n - lag). The lags share a chance.
    quantile = NormalDist().inv_cdf(REPEATED_BY_CHANCE / len(lags))
    return bool((ratios < 1 + quantile / np.sqrt(len(logs) - lags)).any())


def sample_measured_mean(
    rng: np.random.Generator, summary: ForceSummary, sample_count: int
) -> np.ndarray:
    """Return the mean force in N, then samples of the true mean (1 + sample,), NaN for one site.

    Samples deviate as the mean of ln F plus half its variance does for a log-normal F
    (Krishnamoorthy and Mathew, J. Stat. Plan. Inference 115 (2003) 103).
    """
    if summary.site_count < 2:
        return np.append(summary.mean, np.full(sample_count, np.nan))
    degrees_of_freedom = summary.site_count - 1
    variance = summary.log_std**2
    chi_squared = rng.chisquare(degrees_of_freedom, sample_count)
    sampled_variance = variance * degrees_of_freedom / chi_squared
    errors = rng.standard_normal(sample_count) * np.sqrt(sampled_variance / summary.site_count)
    deviation = (sampled_variance - variance) / 2 - errors
    deviation = np.clip(deviation, -MAX_LOG_DEVIATION, MAX_LOG_DEVIATION)
    return np.append(summary.mean, summary.mean * np.exp(deviation))
