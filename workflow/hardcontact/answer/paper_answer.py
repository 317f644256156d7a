"""What the study of the paper answers: its numbers, as they stand in claims and datasets."""

import math
from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.claims.verdicts import summary, with_open_ends
from hardcontact.scales.critical_band import POOLED, last_cutoff

#: The claims that the answer is made of, by what the answer calls them.
ANSWERS = {
    "shortest_wavelength": "critical_wavelength_small_pooled",
    "longest_wavelength": "critical_wavelength_large_pooled",
    "range_of_adhesion": "range_of_adhesion",
    "work_of_adhesion": "work_of_adhesion",
    "fit_error": "plastic_fits",
    "rigid_over_plastic_error": "plasticity_is_crucial",
    "range_exceeds": "range_exceeds_5_nm",
}
#: Side of each edge of the band in the datasets, and what is known of one beyond the cutoffs.
EDGES = {
    "shortest_wavelength": ("small", "at least"),
    "longest_wavelength": ("large", "at most"),
}
#: What is fitted to the forces of each set of scans.
FITTED = ("range_of_adhesion", "work_of_adhesion")
#: What is said of a group of fits.
SUMMARY = ("count", "median", "min", "max")
#: Sizes of the study that the paper prints too.
GRIDS = ("scan_pixels", "scan_size", "contacts_per_side")


class PaperAnswer(NamedTuple):
    """What the page, and its numbers for machines, are made of.

    Attributes
    ----------
    claims : pandas.DataFrame
        As from `open_ends.with_open_ends`.
    open_edges : dict of str to str
        What the number of an edge is, "at least" or "at most", where the edge of the band lies
        beyond the cutoffs; by its name in `ANSWERS`.
    edges : pandas.DataFrame
        Edges of the band of each substrate by itself (nm), NaN where they lie beyond the cutoffs;
        columns are the same names, the index is the label.
    last_cutoffs : dict of str to float
        The cutoff of each side that removes most (nm), by the same names.
    fits : pandas.DataFrame
        Best `range_of_adhesion` (nm) and `work_of_adhesion` (J/m2) of each set of scans, with
        plastic contact.
    scan_size : xarray.Dataset
        As `fig_scan_size.draw` takes it.
    surfaces : pandas.DataFrame
        Columns label and basis, indexed by name: the substrates, then the sphere.
    settings : dict of str to float
        `rho`, the range of adhesion (nm) that the band is computed at; `tolerance`, the relative
        change of the force that ends it; `confidence` of the intervals; `sets`, the number of sets
        of scans that frequencies are shares of; `realizations` of each surface; the `GRIDS`.
    printed : dict of str to float
        The `GRIDS` of the paper, sizes in nm.
    """

    claims: pd.DataFrame
    open_edges: dict[str, str]
    edges: pd.DataFrame
    last_cutoffs: dict[str, float]
    fits: pd.DataFrame
    scan_size: xr.Dataset
    surfaces: pd.DataFrame
    settings: dict[str, float]
    printed: dict[str, float]

    @property
    def numbers(self) -> dict[str, Any]:
        """Rows of those claims of `ANSWERS` that have a number, by what the answer calls them."""
        known = self.claims.dropna(subset="computed")
        rows: dict[Any, Any] = {row.id: row for row in known.itertuples()}
        return {name: rows[claim] for name, claim in ANSWERS.items() if claim in rows}

    @property
    def fit_groups(self) -> dict[bool, dict[str, dict[str, float]]]:
        """Fits of the sets whose range exceeds that of the paper's statement, and of the others.

        Count, median, min and max of each column of `fits`, of groups that have a set. Empty where
        the study does not have that statement.
        """
        row = self.numbers.get("range_exceeds")
        if row is None or math.isnan(row.frequency):
            return {}
        exceeds = self.fits["range_of_adhesion"] > row.published
        return {
            bool(group): {
                name: {said: float(of_group[name].agg(said)) for said in SUMMARY} for name in FITTED
            }
            for group, of_group in self.fits.groupby(exceeds)
        }


def paper_answer(
    claims: pd.DataFrame, datasets: Mapping[str, xr.Dataset], constants: pd.DataFrame
) -> PaperAnswer:
    """Gather what the page shows.

    Parameters
    ----------
    claims : pandas.DataFrame
        As from `verdicts.read_verdicts`.
    datasets : mapping of str to xarray.Dataset
        `topography`, `scales`, `band`, `sets` and `scan_size`, as in the final netCDF files.
    constants : pandas.DataFrame
        As from `published.constants`.

    Returns
    -------
    PaperAnswer
        Numbers in the units of the claims.
    """
    topography, scales, band = (datasets[name] for name in ("topography", "scales", "band"))
    critical = band["critical_wavelength"]
    single = critical.sel(group=band["surface"].values)
    sphere = topography.attrs["sphere_surface"]
    fits = datasets["sets"].sel(contact_model="plastic", drop=True)
    surfaces = topography[["label", "basis"]].to_dataframe()[["label", "basis"]]
    return PaperAnswer(
        with_open_ends(claims, [band, datasets["sets"]]),
        {
            name: bound
            for name, (side, bound) in EDGES.items()
            if np.isnan(critical.sel(side=side, group=POOLED).item())
        },
        pd.DataFrame(
            {name: single.sel(side=side).values for name, (side, _) in EDGES.items()},
            index=band["label"].values,
        ),
        {
            name: last_cutoff(band["scale_change"].sel(side=side), side)
            for name, (side, _) in EDGES.items()
        },
        fits[list(FITTED)].to_dataframe()[list(FITTED)],
        datasets["scan_size"],
        surfaces.loc[[*surfaces.index.drop(sphere), sphere]],
        {
            "rho": float(scales.attrs["rho"]),
            "tolerance": float(band.attrs["scale_tolerance"]),
            "confidence": float(band.attrs["confidence"]),
            "sets": datasets["sets"].sizes["set"],
            "realizations": scales.sizes["realization"],
            "scan_pixels": topography.sizes["row"],
            "scan_size": float(topography["scan_size"].min()),
            "contacts_per_side": scales.sizes["contact_y"],
        },
        {name: float(constants["value"][name]) for name in GRIDS},
    )


def as_plain(answer: PaperAnswer) -> dict[str, Any]:
    """Return the answer in plain values, for JSON: None where there is no number.

    Parameters
    ----------
    answer : PaperAnswer
        Of the study.

    Returns
    -------
    dict
        `answer`: claims by what the answer calls them, each with its `bound` and `open_end`, None
        where its number and the ends of its interval are none; `fit_groups` of sets,
        whose range `exceeds` that of the statement `range_exceeds` or not; `verdicts`: independent
        findings and all statements by verdict; `claims`: every row of claims.csv;
        `open_ends` of their intervals by id; `surfaces`; `settings`.
    """
    rows = [_plain(row) for row in answer.claims.drop(columns="open_end").to_dict("records")]
    is_open = answer.claims["open_end"] != ""
    by_claim = {row["id"]: row for row in rows}
    return {
        "answer": {
            name: by_claim[row.id]
            | {"bound": answer.open_edges.get(name), "open_end": row.open_end or None}
            for name, row in answer.numbers.items()
        },
        "fit_groups": [
            {"exceeds": exceeds, **group} for exceeds, group in answer.fit_groups.items()
        ],
        "verdicts": summary(answer.claims).set_index("verdict").to_dict("index"),
        "claims": rows,
        "open_ends": answer.claims[is_open].set_index("id")["open_end"].to_dict(),
        "surfaces": answer.surfaces.to_dict("index"),
        "settings": answer.settings,
    }


def _plain(row: Mapping[Any, Any]) -> dict[str, Any]:
    """Return a row without NaN, which JSON does not have."""
    return {
        str(name): None if isinstance(value, float) and math.isnan(value) else value
        for name, value in row.items()
    }
