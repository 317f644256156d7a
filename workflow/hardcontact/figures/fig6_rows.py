"""The rows of Fig. 6: ratios, changes and critical wavelengths of one side of the band."""

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.figures.tables import bounded, over_sets
from hardcontact.scales.critical_band import POOLED

__all__ = [
    "closed_form_rows",
    "critical_rows",
    "curve_rows",
    "computed_cutoffs",
    "last_cutoff",
    "published_row",
    "realization_rows",
    "without_open_ends",
]


def published_row(side: str, cutoff: float) -> pd.DataFrame:
    """Return the row of a published critical wavelength (nm)."""
    return pd.DataFrame(
        {
            "side": [side],
            "group": POOLED,
            "origin": "published",
            "unit": "nm",
            "quantity": "critical_wavelength",
            "value": cutoff,
        }
    )


def curve_rows(of_side: xr.Dataset, of_sets: xr.Dataset) -> list[pd.DataFrame]:
    """Return ratio and change against the cutoff, of the study and over the sets."""
    return [
        values.to_dataframe()[["value", "low", "high"]]
        .dropna(subset="value")
        .reset_index()
        .rename(columns={"surface": "group"})
        .assign(origin="computed", over=over, quantity=quantity, unit="1")
        .assign(side=str(of_side["side"].item()))
        for quantity in ("ratio", "change")
        for over, values in (
            ("realizations", bounded(of_side, f"scale_{quantity}")),
            ("sets", over_sets(of_sets[f"scale_{quantity}"])),
        )
    ]


def realization_rows(of_side: xr.Dataset) -> list[pd.DataFrame]:
    """Return the ratio of single realizations against the cutoff."""
    frame = of_side["ratio"].to_dataframe("value").dropna(subset="value").reset_index()
    named = frame.rename(columns={"surface": "group"})
    over = "realization " + named["realization"].astype(str)
    return [named.assign(origin="computed", quantity="ratio", unit="1", over=over)]


def closed_form_rows(of_side: xr.Dataset) -> pd.DataFrame:
    """Return the ratio of the closed form against the cutoff."""
    frame = of_side["filtered_ratio"].to_dataframe("value").dropna(subset="value").reset_index()
    named = frame.rename(columns={"surface": "group"})
    return named.assign(origin="computed", quantity="closed_form_ratio", unit="1", over="spectrum")


def computed_cutoffs(of_side: xr.Dataset) -> np.ndarray:
    """Return the cutoffs (nm) of one side, of the study or of the sets."""
    ratio = of_side["scale_ratio"]
    known = ratio.notnull().any([dim for dim in ratio.dims if dim != "cutoff_wavelength"])
    cutoffs: np.ndarray = of_side["cutoff_wavelength"].values[known.values]
    return cutoffs


def last_cutoff(of_side: xr.Dataset) -> float:
    """Return the cutoff (nm) that removes most, which stands for all beyond it."""
    cutoffs = computed_cutoffs(of_side)
    return float(cutoffs[-1] if of_side["side"].item() == "small" else cutoffs[0])


def critical_rows(of_side: xr.Dataset, of_sets: xr.Dataset) -> pd.DataFrame:
    """Return the critical wavelength (nm) of each group, of the study and over the sets."""
    last = last_cutoff(of_side)
    of_study = bounded(of_side, "critical_wavelength")
    of_study["value"] = of_study["value"].fillna(last)
    spread = over_sets(of_sets["critical_wavelength"].fillna(last))
    frames = [
        values.to_dataframe()[["value", "low", "high"]].reset_index().assign(over=over)
        for over, values in (("realizations", of_study), ("sets", spread))
    ]
    return pd.concat(frames, ignore_index=True)


def without_open_ends(critical: pd.DataFrame, band: xr.Dataset, side: str) -> pd.DataFrame:
    """Return critical wavelengths without numbers that stand for all beyond the last cutoff."""
    ends = critical[["value", "low", "high"]]
    beyond = np.isclose(ends, last_cutoff(band.sel(side=side)))
    names = [", ".join(ends.columns[row]) for row in beyond]
    known = critical.assign(**ends.mask(beyond), beyond=names, side=side)
    return known.assign(origin="computed", quantity="critical_wavelength", unit="nm")
