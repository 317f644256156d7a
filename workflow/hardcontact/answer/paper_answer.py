"""What the study of the paper answers: numbers of claims and datasets, and the page of them."""

import math
from collections.abc import Mapping
from itertools import groupby
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.answer.captions import Caption
from hardcontact.answer.facts import number_of, on_scans
from hardcontact.answer.report_pages import chapter, claim_facts, plain_rows
from hardcontact.answer.templates import rendered
from hardcontact.claims.verdicts import summary, with_open_ends
from hardcontact.figures.catalogue import OF_PAPER
from hardcontact.numbers.number import Number, plain
from hardcontact.numbers.printing import DIGITS, print_as_paper
from hardcontact.numbers.statistics import bounds
from hardcontact.scales.critical_band import POOLED

#: The claims that the answer is made of, by what the answer calls them.
ANSWERS = {
    "shortest_wavelength": "edge_small_pooled",
    "longest_wavelength": "edge_large_pooled",
    "range_of_adhesion": "range_of_adhesion",
    "work_of_adhesion": "work_of_adhesion",
    "fit_error": "plastic_fits",
    "rigid_over_plastic_error": "plasticity_is_crucial",
    "range_exceeds": "range_exceeds_5_nm",
}
#: The findings that matter most, by their claims, in the order of the page.
MAIN_FINDINGS = (
    "edge_small_pooled",
    "edge_large_pooled",
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
#: Level of the headings within the departures, which are one section of the page.
WITHIN_SECTION = 3


class PaperAnswer(NamedTuple):
    """What the page, and its numbers for machines, are made of."""

    #: As from `verdicts.with_open_ends`.
    claims: pd.DataFrame
    #: By name in `ANSWERS`: that an edge beyond the cutoffs is "at least" or "at most" its number.
    open_edges: dict[str, str]
    #: Best `FITTED` (nm, J/m2) of each set of scans, with plastic contact.
    fits: pd.DataFrame
    #: Mean force on mirrored scans over that on the largest surfaces, by substrate.
    forces_on_scans: dict[str, Number]
    #: Sides (nm) of these scans and surfaces.
    size_of_scans: float
    size_of_surfaces: float
    #: As from `cutoff_curves`.
    curves: dict[str, Any]
    #: Columns label and basis, indexed by name: the substrates, then the sphere.
    surfaces: pd.DataFrame
    #: `rho`, the range of adhesion (nm) that the band is computed at; `tolerance`, the relative
    #: change of the force that ends it; `confidence` of the intervals; `sets`, the number of sets
    #: of scans that frequencies are shares of; `realizations` of each surface; the `GRIDS`.
    settings: dict[str, float]
    #: The `GRIDS` of the paper, sizes in nm.
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
    def fit_groups(self) -> dict[bool, dict[Any, dict[str, float]]]:
        """Fits of the sets whose range exceeds that of the paper's statement, and of the others.

        Count, median, min and max of each column of `fits`, of groups that have a set. Empty where
        the study does not have that statement.
        """
        row = self.numbers.get("range_exceeds")
        if row is None or math.isnan(row.frequency):
            return {}
        exceeds = self.fits["range_of_adhesion"] > row.published
        groups = self.fits.groupby(exceeds)
        return {bool(group): of_group.agg([*SUMMARY]).to_dict() for group, of_group in groups}


def paper_answer(
    claims: pd.DataFrame, datasets: Mapping[str, xr.Dataset], constants: pd.DataFrame
) -> PaperAnswer:
    """Gather what the page shows, in the units of the claims.

    Claims are as from `verdicts.read_verdicts`, constants as from `published.constants`; datasets
    are `topography`, `scales`, `band`, `sets` and `scan_size`, as in the final netCDF files.
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
            name: number_of(of_scans.sel(surface=name), "force_over_largest", name=name)
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
    """Return the mean force ratio of band.nc against the cutoff, for curves that show their values.

    By side these are `cutoffs` (nm), `limits` of the axis of ratios, and `surfaces`, each with
    `name`, `label`, `basis`, `colour`, and at every cutoff `ratios`, `low` and `high`, None of what
    is unknown.
    """
    # Imported here: matplotlib is loaded where colours are needed, and not by the rules.
    from hardcontact.figures.style import BEYOND, colours

    curves = {}
    for side in band["side"].values.tolist():
        of_side = band.sel(side=side).dropna("cutoff_wavelength", how="all", subset=["scale_ratio"])
        ratio, (low, high) = of_side["scale_ratio"], bounds(of_side, "scale_ratio")
        values = {"ratios": ratio, "low": low, "high": high}
        curves[side] = {
            "cutoffs": of_side["cutoff_wavelength"].values.tolist(),
            # An interval of few realizations spans many decades, and curves would be flat lines.
            "limits": [
                float(np.fmax(low.min(), ratio.min() / BEYOND)),
                float(np.fmin(high.max(), ratio.max() * BEYOND)),
            ],
            "surfaces": [
                {"name": name, "colour": colour}
                | {text: str(of_side[text].sel(surface=name).item()) for text in ("label", "basis")}
                | {key: plain(one.sel(surface=name).values.tolist()) for key, one in values.items()}
                for name, colour in colours(band["surface"].values).items()
            ],
        }
    return curves


def as_plain(answer: PaperAnswer) -> dict[str, Any]:
    """Return the answer for JSON, as answer_paper.schema.json describes it."""
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


def paper_page(
    answer: PaperAnswer,
    figures: Mapping[str, bytes],
    captions: Mapping[str, Caption],
    departures: str,
    citation: Mapping[str, Any],
) -> str:
    """Return the page, HTML.

    Figures are PNG and captions by their names in the catalogue; departures are the chapter of that
    name in Markdown, as `report_pages.chapter` takes it; the citation is CITATION.cff.
    """
    return rendered(
        "paper.html",
        answer=answer,
        said={name: _said(row) for name, row in answer.numbers.items()},
        main=[name for name in MAIN_FINDINGS if name in set(answer.claims["id"])],
        chapters=[
            (heading, [name for name, _ in members])
            for heading, members in groupby(OF_PAPER.items(), key=lambda pair: pair[1].chapter)
        ],
        catalogue=OF_PAPER,
        figures=figures,
        captions=captions,
        departures=chapter(departures, level=WITHIN_SECTION),
        citation=citation,
        **claim_facts(answer.claims),
    )


def _said(row: Any) -> dict[str, str]:
    """Return the numbers of a claim with as many digits as its interval gives reason for."""
    interval = row.low, row.high
    return {
        "alone": print_as_paper(row.computed, row.unit, digits=DIGITS),
        "computed": print_as_paper(row.computed, row.unit, interval, DIGITS, row.open_end),
        "published": print_as_paper(row.published, row.unit),
    }
