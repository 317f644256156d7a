"""Each statement of the paper against what was computed.

A claim names a number by dataset, quantity and selection, and a rule that turns the number, its
95 % interval and the published limits into a verdict. Numbers travel as datasets of three
variables, `value`, `low` and `high`; `low` and `high` are NaN where no interval is known.
"""

from itertools import chain, pairwise
from pathlib import Path

import numpy as np
import pandas as pd
import xarray as xr
from scipy import stats

__all__ = [
    "VERDICTS",
    "accepted_range",
    "change_outside_band",
    "critical_over_interaction_radius",
    "evaluate",
    "flat_limit_fraction",
    "force_at_plastic_fit",
    "force_decades",
    "force_slope",
    "interaction_radius",
    "lognormal_misfit",
    "mean_over_median",
    "ratio_at_fit",
    "read_claims",
    "smoothest_ratio",
    "summary",
    "verdict",
]

UNTESTABLE = "not testable on substitutes"
VERDICTS = ("reproduced", "consistent", "not reproduced", UNTESTABLE)
ONE_SIDED = ("below", "above", "order")
COLUMNS = (
    "id", "section", "statement", "published", "computed", "low", "high", "unit", "rule",
    "verdict", "basis", "note",
)  # fmt: skip
NUMBERS = ("published", "published_low", "published_high")

# Topography variable -> the row of Table 1 a substitute scan may have been calibrated to.
TABLE1_ROWS = {
    "rms_height_mean": "afm_rms_height",
    "rms_gradient_mean": "afm_rms_slope",
    "rms_half_laplacian_mean": "afm_rms_curvature",
    "all_scales_rms_height": "all_rms_height",
    "all_scales_rms_gradient": "all_rms_slope",
    "all_scales_rms_half_laplacian": "all_rms_curvature",
}
CRITICAL_BAND = (43.0, 1800.0)  # nm, Fig. 6


# --- the claims -----------------------------------------------------------------------------


def read_claims(path: str | Path) -> pd.DataFrame:
    """Read a table of claims: numbers as float (NaN where blank), everything else as text."""
    table = pd.read_csv(path, dtype=str, keep_default_na=False)
    return table.assign(**{name: pd.to_numeric(table[name]) for name in NUMBERS})


def evaluate(claims: pd.DataFrame, datasets: dict[str, xr.Dataset]) -> pd.DataFrame:
    """Set every claim against the computed number.

    claims: as from `read_claims`. datasets: `topography` (always needed, it says which scans are
    substitutes) and whichever else the claims name, each as in the final netCDF files. A claim
    about a surface or contact model that the study does not have is left out. Returns one row
    a claim with the columns `COLUMNS`; raises ValueError naming the claim and what is missing.
    """
    rows = [_evaluate_claim(claim, datasets) for claim in claims.itertuples(index=False)]
    return pd.DataFrame([row for row in rows if row is not None], columns=list(COLUMNS))


def summary(evaluated: pd.DataFrame) -> pd.DataFrame:
    """Count the claims of each verdict: columns `verdict` and `claims`, every verdict listed."""
    counts = evaluated["verdict"].value_counts().reindex(VERDICTS, fill_value=0)
    return counts.rename_axis("verdict").rename("claims").reset_index()


def accepted_range(rule: str, published_low: float, published_high: float) -> tuple[float, float]:
    """Limits between which a number agrees with the paper, in the unit of the claim.

    Raises ValueError for an unknown rule and for a limit that the rule needs and is blank.
    """
    name, _, factor = rule.partition(" ")
    if rule == "interval":
        limits = published_low, published_high
    elif name == "factor" and factor:
        limits = published_low / float(factor), published_high * float(factor)
    elif rule == "below":
        limits = -np.inf, published_high
    elif rule in ("above", "order"):
        limits = published_low, np.inf
    else:
        raise ValueError(f"unknown rule {rule!r}")
    if np.isnan(limits).any():
        raise ValueError(f"rule {rule!r} lacks a published limit")
    return limits


def verdict(
    rule: str,
    computed: float,
    low: float,
    high: float,
    published_low: float,
    published_high: float,
) -> str:
    """Judge one number and its 95 % interval [low, high]; NaN low and high mean no interval.

    Rules with two limits (`interval`, `factor`): reproduced when the number lies between them,
    consistent when only its interval reaches them. Rules with one (`below`, `above`, `order`):
    reproduced when the whole interval keeps the limit, consistent when only the number does.
    A number that is NaN is not reproduced.
    """
    lower, upper = accepted_range(rule, published_low, published_high)
    if np.isnan(computed):
        return "not reproduced"
    low = computed if np.isnan(low) else low
    high = computed if np.isnan(high) else high
    if rule in ONE_SIDED:
        weakly = lower < computed < upper
        strongly = weakly and lower < low and high < upper
    else:
        strongly = lower <= computed <= upper
        weakly = strongly or (low <= upper and high >= lower)
    return "reproduced" if strongly else "consistent" if weakly else "not reproduced"


def _evaluate_claim(claim, datasets: dict[str, xr.Dataset]) -> dict | None:
    """One row of the result, or None when the study lacks what the claim is about."""
    try:
        dataset = _dataset(datasets, claim.dataset)
        topography = _dataset(datasets, "topography")
        selection = _parse_selection(claim.select)
        if not _has_labels(dataset, selection):
            return None
        estimate = _worst(_pick(_estimate(dataset, claim.quantity), selection), claim.rule)
        computed, low, high = (float(estimate[name]) for name in ("value", "low", "high"))
        limits = claim.published_low, claim.published_high
        judged = verdict(claim.rule, computed, low, high, *limits)
        substitutes = _substitutes(claim.dataset, dataset, selection, topography)
        reason = _untestable(claim, substitutes, topography)
    except (KeyError, ValueError) as error:
        raise ValueError(f"claim {claim.id}: {_first_sentence(error)}") from error
    no_value = "No value exists." if np.isnan(computed) else ""
    result = claim._asdict() | {
        "computed": computed,
        "low": low,
        "high": high,
        "verdict": UNTESTABLE if reason else judged,
        "basis": "substitute scans" if substitutes else "measured",
        "note": " ".join(filter(None, (claim.note, reason, no_value))),
    }
    return {name: result[name] for name in COLUMNS}


def _first_sentence(error: Exception) -> str:
    return str(error.args[0]).partition(". ")[0].splitlines()[0]


# --- which surfaces a claim touches -----------------------------------------------------------


def _substitutes(
    name: str, dataset: xr.Dataset, selection: dict, topography: xr.Dataset
) -> list[str]:
    """Substitute surfaces the claim touches.

    These are the surfaces it selects, or all of the dataset when it selects none; whatever is
    not topography touches the sphere as well.
    """
    known = set(topography["surface"].values)
    selected = [label for groups in selection.values() for label in chain.from_iterable(groups)]
    touched = [label for label in selected if label in known] or list(dataset["surface"].values)
    if name != "topography":
        touched.append(_attribute(topography, "sphere_surface"))
    basis = topography["basis"].sel(surface=touched)
    return [str(surface) for surface in basis["surface"].values[basis.values == "substitute"]]


def _untestable(claim, substitutes: list[str], topography: xr.Dataset) -> str:
    """Why substitute scans cannot test the claim; empty when they can."""
    if claim.needs == "measured" and substitutes:
        return "The substitute scans assume this."
    row = TABLE1_ROWS.get(claim.quantity) if claim.dataset == "topography" else None
    for surface in substitutes:
        calibrated = str(topography["calibrated_to_table1"].sel(surface=surface).item())
        if row in [name.strip() for name in calibrated.split(",")]:
            return "The substitute scans are calibrated to this."
    return ""


# --- from a claim to a number -----------------------------------------------------------------


def _dataset(datasets: dict[str, xr.Dataset], name: str) -> xr.Dataset:
    if name not in datasets:
        raise KeyError(f"no dataset named {name!r}")
    return datasets[name]


def _attribute(dataset: xr.Dataset, name: str):
    if name not in dataset.attrs:
        raise KeyError(f"no attribute named {name!r}")
    return dataset.attrs[name]


def _parse_selection(select: str) -> dict[str, list[list[str]]]:
    """Labels by dimension: `a=x;b=y,z>w` is {a: [[x]], b: [[y, z], [w]]}."""
    pairs = (item.split("=", 1) for item in select.split(";") if item)
    return {dim: [group.split(",") for group in labels.split(">")] for dim, labels in pairs}


def _has_labels(dataset: xr.Dataset, selection: dict[str, list[list[str]]]) -> bool:
    """Whether every selected label exists. Raises KeyError for a dimension that does not."""
    return all(
        set(chain.from_iterable(groups)) <= set(dataset[dim].values)
        for dim, groups in selection.items()
    )


def _estimate(dataset: xr.Dataset, quantity: str) -> xr.Dataset:
    """Value, low and high of a variable of the dataset or of a derived quantity."""
    if quantity in DERIVED:
        return DERIVED[quantity](dataset)
    value = dataset[quantity]
    if f"{quantity}_low" in dataset:
        return _interval(value, dataset[f"{quantity}_low"], dataset[f"{quantity}_high"])
    metric = quantity.removesuffix("_mean")
    if quantity.endswith("_mean") and f"{metric}_std" in dataset:
        return _student(value, dataset[f"{metric}_std"], dataset[metric].count("scan"))
    return _interval(value, np.nan, np.nan)


def _pick(estimate: xr.Dataset, selection: dict[str, list[list[str]]]) -> xr.Dataset:
    """Apply the selection; a chain of groups becomes its weakest link."""
    for dim, groups in selection.items():
        members = [estimate.sel({dim: group}) for group in groups]
        estimate = _weakest_link(members, dim) if len(members) > 1 else members[0]
    return estimate


def _weakest_link(groups: list[xr.Dataset], dim: str) -> xr.Dataset:
    """Smallest ratio of a member of a group to one of the next; the numbers are positive.

    The interval divides the ends of the members' intervals: it is wider than 95 %.
    """
    links = []
    for upper, lower in pairwise(groups):
        upper, lower = upper.min(dim, skipna=False), lower.max(dim, skipna=False)
        links.append(
            _interval(
                upper["value"] / lower["value"],
                upper["low"] / lower["high"],
                upper["high"] / lower["low"],
            )
        )
    return xr.concat(links, dim="link").min("link", skipna=False)


def _worst(estimate: xr.Dataset, rule: str) -> xr.Dataset:
    """Reduce what the selection leaves open to the value that keeps the rule least."""
    if estimate["value"].size == 1:
        return estimate.squeeze(drop=True)
    if rule == "below":
        return estimate.max()
    if rule in ONE_SIDED:
        return estimate.min()
    raise ValueError(f"rule {rule!r} needs one number, open: {', '.join(estimate['value'].dims)}")


def _interval(value: xr.DataArray, low, high) -> xr.Dataset:
    """Bundle a value with the ends of its interval: arrays of its shape, or NaN for none."""
    broadcast = xr.zeros_like(value)
    return xr.Dataset({"value": value, "low": low + broadcast, "high": high + broadcast})


def _student(mean: xr.DataArray, std: xr.DataArray, count: xr.DataArray) -> xr.Dataset:
    """95 % interval of a mean by Student's t; NaN for fewer than two samples."""
    half = xr.apply_ufunc(stats.t.ppf, 0.975, count - 1) * std / np.sqrt(count)
    return _interval(mean, mean - half, mean + half)


# --- derived quantities -----------------------------------------------------------------------


def mean_over_median(inference: xr.Dataset) -> xr.Dataset:
    """Mean over median of the fitted pull-off forces (contact_model, surface)."""
    mean, median = "force_mean", "force_median"
    return _interval(
        inference[mean] / inference[median],
        inference[f"{mean}_low"] / inference[f"{median}_high"],
        inference[f"{mean}_high"] / inference[f"{median}_low"],
    )


def ratio_at_fit(inference: xr.Dataset) -> xr.Dataset:
    """Force relative to the reference surface at the fitted range (contact_model, surface)."""
    return _at_range(inference, "ratio", inference["range_of_adhesion"])


def force_at_plastic_fit(inference: xr.Dataset) -> xr.Dataset:
    """Mean force in N of each contact model at the plastic fit (contact_model, surface)."""
    plastic = inference.sel(contact_model="plastic", drop=True)
    force = _at_range(inference, "mean_force", plastic["range_of_adhesion"])
    return plastic["work_of_adhesion"] * force


def _at_range(inference: xr.Dataset, name: str, rho: xr.DataArray) -> xr.Dataset:
    """A variable of `rho` and its interval, linearly interpolated to the range rho in nm."""
    names = {name: "value", f"{name}_low": "low", f"{name}_high": "high"}
    return inference[list(names)].interp(rho=rho).drop_vars("rho").rename(names)


def interaction_radius(inference: xr.Dataset) -> xr.Dataset:
    """Radius sqrt(D rho) in nm of the disk a sphere interacts with (contact_model)."""
    diameter = 2 * _attribute(inference, "sphere_radius")
    return np.sqrt(diameter * _estimate(inference, "range_of_adhesion"))


def critical_over_interaction_radius(inference: xr.Dataset) -> xr.Dataset:
    """Critical wavelength over the interaction radius (side, group, contact_model)."""
    critical = _estimate(inference, "critical_wavelength")
    radius = interaction_radius(inference)
    return _interval(
        critical["value"] / radius["value"],
        critical["low"] / radius["high"],
        critical["high"] / radius["low"],
    )


def change_outside_band(inference: xr.Dataset) -> xr.Dataset:
    """Largest change of the force by cutoffs outside the published band (side, group).

    Cutoffs up to 43 nm count for the small side, from 1.8 µm for the large one.
    """
    shortest, longest = CRITICAL_BAND
    cutoff = inference["cutoff_wavelength"]
    outside = xr.where(inference["side"] == "small", cutoff <= shortest, cutoff >= longest)
    excess = (_estimate(inference, "scale_ratio") - 1).where(outside)
    nearest = np.maximum(np.maximum(excess["low"], -excess["high"]), 0)
    farthest = np.maximum(excess["high"], -excess["low"])
    return _interval(np.abs(excess["value"]), nearest, farthest).max("cutoff_wavelength")


def smoothest_ratio(inference: xr.Dataset) -> xr.Dataset:
    """Force over the unfiltered force at the largest short-wavelength cutoff (group)."""
    ratio = _estimate(inference, "scale_ratio").sel(side="small", drop=True)
    ratio = ratio.sortby("cutoff_wavelength").dropna("cutoff_wavelength", how="all")
    return ratio.isel(cutoff_wavelength=-1, drop=True)


def flat_limit_fraction(scales: xr.Dataset) -> xr.Dataset:
    """Force at the largest short-wavelength cutoff over 2 pi R W of a flat plane (surface)."""
    force = scales["pull_off_force"].sel(side="small").mean(["contact_y", "contact_x"])
    force = force.sortby("cutoff_wavelength").dropna("cutoff_wavelength", how="all")
    radius = 1e-9 * _attribute(scales, "sphere_radius")  # m; the forces are those at W = 1 J/m2
    return _over(force.isel(cutoff_wavelength=-1, drop=True) / (2 * np.pi * radius), "realization")


def force_slope(adhesion: xr.Dataset) -> xr.Dataset:
    """Slope d ln F / d ln rho of the mean force at the reference range (surface, contact_model).

    The slope is taken scan by scan, the interval is that of its mean over the scans.
    """
    mean = adhesion["pull_off_force"].mean(["sphere_scan", "contact_y", "contact_x"])
    logarithm = np.log(mean).assign_coords(rho=np.log(mean["rho"]))
    slope = logarithm.differentiate("rho")
    reference = np.log(_attribute(adhesion, "reference_rho"))
    return _over(slope.sel(rho=reference, method="nearest", drop=True), "scan")


def lognormal_misfit(adhesion: xr.Dataset) -> xr.Dataset:
    """Kolmogorov distance of the forces to their log-normal fit (surface, contact_model)."""
    return _interval(_over_forces(adhesion, _kolmogorov_distance), np.nan, np.nan)


def force_decades(adhesion: xr.Dataset) -> xr.Dataset:
    """Decades between the smallest and the largest force (surface, contact_model)."""
    decades = _over_forces(adhesion, lambda logarithms: np.ptp(logarithms) / np.log(10))
    return _interval(decades, np.nan, np.nan)


def _over(values: xr.DataArray, dim: str) -> xr.Dataset:
    """Mean along a dimension with its 95 % interval."""
    return _student(values.mean(dim), values.std(dim, ddof=1), values.count(dim))


def _over_forces(adhesion: xr.Dataset, statistic) -> xr.DataArray:
    """A statistic of the logarithms of all forces at the reference range of adhesion."""
    forces = adhesion["pull_off_force"].sel(
        rho=_attribute(adhesion, "reference_rho"), method="nearest", drop=True
    )
    samples = np.log(forces).stack(sample=["scan", "sphere_scan", "contact_y", "contact_x"])
    return xr.apply_ufunc(
        lambda row: statistic(row[np.isfinite(row)]),
        samples,
        input_core_dims=[["sample"]],
        vectorize=True,
    )


def _kolmogorov_distance(logarithms: np.ndarray) -> float:
    """Largest distance between the cumulative distribution and the normal one of its moments."""
    standardised = (logarithms - logarithms.mean()) / logarithms.std(ddof=1)
    return stats.kstest(standardised, "norm").statistic


DERIVED = {
    function.__name__: function
    for function in (
        mean_over_median,
        ratio_at_fit,
        force_at_plastic_fit,
        interaction_radius,
        critical_over_interaction_radius,
        change_outside_band,
        smoothest_ratio,
        flat_limit_fraction,
        force_slope,
        lognormal_misfit,
        force_decades,
    )
}
