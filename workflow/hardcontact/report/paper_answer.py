"""The numbers of the answer of the paper's study, from claims and datasets."""

import math
from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.base.number import Number
from hardcontact.base.statistics import bounds
from hardcontact.contact.contact import PLASTIC
from hardcontact.inference.edges import POOLED, edges_or_bounds
from hardcontact.inference.fit import WITHOUT_SURFACE
from hardcontact.paper.verdicts import add_open_ends, interval_with_sets, open_end, summary
from hardcontact.report.quantities import QuantityMapping, number_of, quantity_mapping
from hardcontact.report.table1 import table1_rows

#: Claims with numbers in the answer, by the names of these numbers.
ANSWER_CLAIMS = {
    "short_edge": "edge_small_pooled",
    "long_edge": "edge_large_pooled",
    "first_short_edge": "edge_small_first",
    "first_long_edge": "edge_large_first",
    "range_of_adhesion": "range_of_adhesion",
    "work_of_adhesion": "work_of_adhesion",
    "fit_error": "plastic_fits",
    "rigid_over_plastic_error": "plasticity_is_crucial",
    "range_exceeds": "range_exceeds_5_nm",
}
#: Side of each edge of the band in the datasets, and its status if it lies beyond the cutoffs.
EDGE_SIDES = {
    "short_edge": ("small", "open_above"),
    "long_edge": ("large", "open_below"),
}
#: Parameters that are fitted to the forces of each set of scans, with units.
FITTED_UNITS = {"range_of_adhesion": "nm", "work_of_adhesion": "J/m2"}
#: Names of groups of sets: those whose range exceeds that of the paper's statement, and others.
FIT_GROUPS = {True: "long_range_sets", False: "short_range_sets"}
#: Sizes in the study that the paper also prints, with units.
GRID_UNITS = {"scan_pixels": "1", "scan_size": "nm", "contacts_per_side": "1"}


class PaperAnswer(NamedTuple):
    """The numbers and labels from which the paper's page and answer.json are made."""

    claims: pd.DataFrame  #: The table from `verdicts.add_open_ends`.
    numbers: dict[str, Number]  #: Numbers of the whole study, by their names in answer.json.
    #: For each substrate: label, basis, both edges, and force on scans relative to large surfaces.
    surfaces: dict[str, dict[str, Any]]
    sphere: dict[str, Any]  #: Label and basis of the sphere.
    decisive: str  #: Label of the surface that decides range and work of adhesion most.
    protruded: str  #: Label of the surface that has protrusions in some sets.
    table1: list[list[str]]

    @property
    def coarse(self) -> bool:
        """Whether the study has fewer pixels or contacts than the paper."""
        sizes = ("scan_pixels", "contacts_per_side")
        return any(self.numbers[name].value < self.numbers[f"{name}_published"].value
                   for name in sizes)  # fmt: skip


def paper_answer(
    claims: pd.DataFrame,
    datasets: Mapping[str, xr.Dataset],
    constants: pd.DataFrame,
    published_table1: pd.DataFrame,
) -> PaperAnswer:
    """Return the answer, in the units of the claims.

    claims: the table that `verdicts.read_verdicts` returns.
    datasets: final datasets: `topography`, `scales`, `edges`, `sets`, `protruded` and
        `protruded_sphere`; `scan_size`, the table resources/validation/scan_size.nc.
    constants, published_table1: the tables that `published.constants` and `published.table1`
        return.
    """
    topography = datasets["topography"]
    band = datasets["edges"]
    sets = datasets["sets"]
    transitions = datasets["scales"]["transition"]
    claims = add_open_ends(claims, [band, sets])
    rows = {str(row.id): row for row in claims.dropna(subset="computed").itertuples()}
    numbers: list[Number] = []
    for name, claim in ANSWER_CLAIMS.items():
        if claim in rows:
            numbers += _numbers_of_claim(name, rows[claim], band, transitions)
    numbers += _fit_numbers(sets, rows.get(ANSWER_CLAIMS["range_exceeds"]))
    protruded = {name: datasets[name] for name in ("protruded", "protruded_sphere")}
    decisive = _decisive_surface(sets)
    numbers += _decisive_numbers(sets, protruded, decisive, sets.attrs["confidence"])
    numbers += _settings(datasets, constants)
    for row in summary(claims).to_dict("records"):
        name = "verdicts_" + row["verdict"].replace(" ", "_")
        numbers += [Number(name, row["claims"]), Number(f"{name}_independent", row["independent"])]
    sphere = topography.attrs["sphere_surface"]
    descriptions: Any = topography[["label", "basis"]].to_dataframe()[["label", "basis"]]
    surface_descriptions = descriptions.to_dict("index")
    forces = _forces_on_scans(datasets)
    return PaperAnswer(
        claims,
        {number.name: number for number in numbers},
        {
            name: surface_descriptions[name]
            | _numbers_of_surface(name, band, sets, forces, transitions)
            for name in map(str, band["surface"].values)
        },
        surface_descriptions[sphere],
        str(surface_descriptions[decisive]["label"]),
        datasets["protruded"].attrs["label"],
        table1_rows(topography, published_table1),
    )


def _forces_on_scans(datasets: Mapping[str, xr.Dataset]) -> xr.Dataset:
    """Return the validated forces on mirrored windows of the size of the study's scans."""
    table = datasets["scan_size"]
    windows = table.sel(map_size=table["mirrored"] == 1)
    return windows.sel(map_size=datasets["topography"]["scan_size"].min(), method="nearest")


def _edge_source(transitions: xr.DataArray, side: str, edge: float) -> str:
    """Return the source of an edge (nm): whether the roughness beyond it is artificial.

    `transitions` (side) are the wavelengths in nm from which masters have artificial roughness.
    """
    transition = transitions.sel(side=side).item()
    is_artificial = edge < transition if side == "small" else edge > transition
    return "artificial" if is_artificial else "computed"


def _numbers_of_claim(
    name: str, row: Any, band: xr.Dataset, transitions: xr.DataArray
) -> list[Number]:
    """Return the computed and the published number of a claim, and its frequency over sets."""
    edge = name.removeprefix("first_")
    source = "computed"
    if edge in EDGE_SIDES:
        source = _edge_source(transitions, EDGE_SIDES[edge][0], row.computed)
    status = f"interval_open_{row.open_end}" if row.open_end else ""
    if name in EDGE_SIDES:
        side, open_status = EDGE_SIDES[name]
        if np.isnan(band["edge"].sel(side=side, group=POOLED).item()):
            status = open_status
    return [
        Number(name, row.computed, row.unit, row.low, row.high, status, source),
        Number(f"{name}_published", row.published, row.unit, source="published"),
        Number(f"{name}_frequency", row.frequency),
    ]


def _numbers_of_surface(
    name: str,
    band: xr.Dataset,
    sets: xr.Dataset,
    forces: xr.Dataset,
    transitions: xr.DataArray,
) -> dict[str, Number]:
    """Return both edges of one substrate, and its force on scans relative to large surfaces."""
    numbers = {}
    for edge, (side, _) in EDGE_SIDES.items():
        labels = {"side": side, "group": name}
        value = edges_or_bounds(band).sel(labels).item()
        replicas = edges_or_bounds(sets).sel(labels).values
        interval = bounds(band.sel(labels), "edge")
        low, high = interval_with_sets(value, interval, replicas, band.attrs["confidence"])
        end = open_end(side, value, low, high, [band, sets])
        status = f"interval_open_{end}" if end else ""
        source = _edge_source(transitions, side, value)
        numbers[edge] = Number(edge, value, "nm", low, high, status, source)
    if name in forces["surface"].values:
        force = number_of(forces.sel(surface=name), "force_over_largest")
        numbers["force_on_scans"] = force._replace(name="force_on_scans")
    return numbers


def _fit_numbers(sets: xr.Dataset, statement: Any) -> Iterator[Number]:
    """Yield median and extremes of the fits of sets with a long and with a short range.

    A range is long if it exceeds that of the paper's statement. Yields nothing if the study does
    not judge that statement.
    """
    fits = sets.sel(contact_model=PLASTIC, drop=True)[[*FITTED_UNITS]].to_dataframe()
    if statement is None or math.isnan(statement.frequency):
        return
    for exceeds, group in fits.groupby(fits["range_of_adhesion"] > statement.published):
        prefix = FIT_GROUPS[bool(exceeds)]
        yield Number(prefix, len(group))
        for name, unit in FITTED_UNITS.items():
            values = group[name]
            yield Number(f"{prefix}_{name}", values.median(), unit, values.min(), values.max())


def _decisive_surface(sets: xr.Dataset) -> str:
    """Return the surface without which the sets spread least over the range of adhesion."""
    ranges = sets["range_without_surface"].sel(contact_model=PLASTIC).transpose("left_out", "set")
    return str(ranges["left_out"].values[np.log(ranges.values).std(axis=1).argmin()])


def _decisive_numbers(
    sets: xr.Dataset, protruded: Mapping[str, xr.Dataset], decisive: str, confidence: float
) -> Iterator[Number]:
    """Yield range and work of adhesion without the decisive surface, and with protrusions.

    Each number is the median over the sets, with the interval of the claims. Among the sets with
    protrusions, only those are used whose forces agree with the published forces.
    """
    tail = (1 - confidence) / 2
    plastic_sets = sets.sel(contact_model=PLASTIC)
    reduced_sets = plastic_sets.sel(left_out=decisive)
    samples = {
        "all_surfaces": {name: plastic_sets[name].values for name in FITTED_UNITS},
        "without_decisive": {
            name: reduced_sets[WITHOUT_SURFACE[name]].values for name in FITTED_UNITS
        },
    }
    for prefix, dataset in protruded.items():
        agrees = dataset["agrees"].values == 1
        if agrees.size:
            yield Number(f"{prefix}_sets_that_agree", agrees.mean())
        if agrees.any():
            samples[prefix] = {name: dataset[name].values[agrees] for name in FITTED_UNITS}
    for prefix, values in samples.items():
        for name, sample in values.items():
            low, median, high = np.quantile(sample, [tail, 0.5, 1 - tail])
            yield Number(f"{prefix}_{name}", median, FITTED_UNITS[name], low, high)


def _settings(datasets: Mapping[str, xr.Dataset], constants: pd.DataFrame) -> Iterator[Number]:
    """Yield the settings of the study, and the sizes of its grids and of the paper's grids."""
    topography = datasets["topography"]
    scales = datasets["scales"]
    band = datasets["edges"]
    sizes = {
        "scan_pixels": topography.sizes["row"],
        "scan_size": topography["scan_size"].min().item(),
        "contacts_per_side": scales.sizes["contact_y"],
    }
    for name, unit in GRID_UNITS.items():
        yield Number(name, sizes[name], unit, source="given")
        published = float(constants["value"][name])
        yield Number(f"{name}_published", published, unit, source="published")
    yield Number("range_of_band", float(scales.attrs["rho"]), "nm", source="given")
    yield Number("tolerance", float(band.attrs["tolerance"]), source="given")
    yield Number("confidence", float(band.attrs["confidence"]), source="given")
    yield Number("sets", datasets["sets"].sizes["set"], source="given")
    yield Number("realizations", scales.sizes["realization"], source="given")
    map_sizes = {
        "mirrored_scan_size": _forces_on_scans(datasets)["map_size"],
        "large_surface_size": datasets["scan_size"]["map_size"][-1],
    }
    for name, map_size in map_sizes.items():
        yield Number(name, float(map_size), "nm", source="given")


def paper_quantities(answer: PaperAnswer) -> Iterator[QuantityMapping]:
    """Yield the numbers of the whole study, then the numbers of each substrate.

    answer: from `paper_answer`.
    Yields a number as a mapping for answer.json.
    """
    for number in answer.numbers.values():
        yield quantity_mapping(number)
    for name, surface in answer.surfaces.items():
        for number in surface.values():
            if isinstance(number, Number):
                yield quantity_mapping(number, name)
