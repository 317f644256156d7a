"""What the study of the paper answers: its numbers, as they stand in claims and datasets."""

import math
from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.answer.facts import Fact, bounded, known, on_scans
from hardcontact.claims.verdicts import summary, with_open_ends
from hardcontact.numbers.statistics import bounds
from hardcontact.scales.critical_band import POOLED

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
#: The findings that matter most, by their claims, in the order of the page.
MAIN_FINDINGS = (
    "critical_wavelength_small_pooled",
    "critical_wavelength_large_pooled",
    "interaction_radius_is_critical",
    "range_of_adhesion",
    "work_of_adhesion",
    "plastic_fits",
    "plasticity_is_crucial",
    "elastic_pressure_exceeds_hardness",
    "numerical_beats_classical",
    "few_asperities_ncd",
)
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
        As from `verdicts.with_open_ends`.
    open_edges : dict of str to str
        What the number of an edge is, "at least" or "at most", where the edge of the band lies
        beyond the cutoffs; by its name in `ANSWERS`.
    fits : pandas.DataFrame
        Best `range_of_adhesion` (nm) and `work_of_adhesion` (J/m2) of each set of scans, with
        plastic contact.
    forces_on_scans : dict of str to Fact
        Mean force on mirrored scans over that on the largest surfaces, by substrate.
    size_of_scans, size_of_surfaces : float
        Sides (nm) of these scans and surfaces.
    curves : dict
        As from `cutoff_curves`.
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
    fits: pd.DataFrame
    forces_on_scans: dict[str, Fact]
    size_of_scans: float
    size_of_surfaces: float
    curves: dict[str, Any]
    surfaces: pd.DataFrame
    settings: dict[str, float]
    printed: dict[str, float]

    @property
    def numbers(self) -> dict[str, Any]:
        """Rows of those claims of `ANSWERS` that have a number, by what the answer calls them."""
        computed = self.claims.dropna(subset="computed")
        rows: dict[Any, Any] = {row.id: row for row in computed.itertuples()}
        return {name: rows[claim] for name, claim in ANSWERS.items() if claim in rows}

    @property
    def coarse(self) -> bool:
        """Whether the study has fewer pixels or contacts than the paper."""
        sizes = ("scan_pixels", "contacts_per_side")
        return any(self.settings[name] < self.printed[name] for name in sizes)

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
    scan_size = datasets["scan_size"]
    of_scans = on_scans(scan_size)
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
        fits[list(FITTED)].to_dataframe()[list(FITTED)],
        {
            name: bounded(of_scans.sel(surface=name), "force_over_largest")._replace(name=name)
            for name in of_scans["surface"].values.tolist()
        },
        float(of_scans["edge_size"]),
        float(scan_size["edge_size"][-1]),
        cutoff_curves(band),
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


def cutoff_curves(band: xr.Dataset) -> dict[str, Any]:
    """Return the mean force ratio against the cutoff, for curves that show their values.

    Parameters
    ----------
    band : xarray.Dataset
        As in band.nc.

    Returns
    -------
    dict
        By side: `cutoffs` (nm), `limits` of the axis of ratios, and `surfaces`, each with `name`,
        `label`, `basis`, `colour`, and at every cutoff `ratios`, `low` and `high`, None of what is
        unknown.
    """
    # Imported here: matplotlib is loaded where colours are needed, and not by the rules.
    from hardcontact.figures.style import BEYOND, colours

    curves = {}
    names = band["surface"].values
    for side in band["side"].values.tolist():
        of_side = band.sel(side=side).dropna("cutoff_wavelength", how="all", subset=["scale_ratio"])
        ratio = of_side["scale_ratio"]
        ends = bounds(of_side, "scale_ratio")
        low, high = ends[0].min().item(), ends[1].max().item()
        curves[side] = {
            "cutoffs": of_side["cutoff_wavelength"].values.tolist(),
            # An interval of few realizations spans many decades, and curves would be flat lines.
            "limits": [
                float(np.fmax(low, ratio.min().item() / BEYOND)),
                float(np.fmin(high, ratio.max().item() * BEYOND)),
            ],
            "surfaces": [
                {
                    "name": str(name),
                    "label": str(of_side["label"].sel(surface=name).item()),
                    "basis": str(of_side["basis"].sel(surface=name).item()),
                    "colour": colour,
                }
                | {
                    key: [known(one) for one in values.sel(surface=name).values]
                    for key, values in zip(("ratios", "low", "high"), (ratio, *ends), strict=True)
                }
                for name, colour in colours(names).items()
            ],
        }
    return curves


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
    rows = plain_rows(answer.claims.drop(columns="open_end"))
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


def plain_rows(table: pd.DataFrame) -> list[dict[str, Any]]:
    """Return the rows of a table as plain values, None for NaN, which JSON lacks."""
    return [
        {
            str(name): None if isinstance(value, float) and math.isnan(value) else value
            for name, value in row.items()
        }
        for row in table.to_dict("records")
    ]
