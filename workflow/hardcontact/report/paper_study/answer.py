"""The answer.json of the paper's study, from claims and datasets.

Of each edge of the band there are three kinds. Claims and numbers of the whole study name the first
two, the numbers of a surface the third:

    outermost_short_edge    the shortest of all coatings
    averaged_short_edge     of the change averaged over the coatings: `edge` of edges.nc,
                            group AVERAGED
    short_edge              of one coating: `edge` of edges.nc, with the coating as its group
"""

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.base.number import Number, NumberSource, NumberStatus, numbers_by_name
from hardcontact.base.statistics import interval_ends, percentile_interval
from hardcontact.config.configuration import numeric_configuration
from hardcontact.contact.contact import PLASTIC, RIGID
from hardcontact.contact.numerical_limits import SHORT_ADHESION_RANGE
from hardcontact.inference.edges import AVERAGED, EDGE_NAMES, EdgeStatus, edges_or_bounds
from hardcontact.inference.fit import WITHOUT_SURFACE
from hardcontact.inference.octaves import strongest_octaves
from hardcontact.paper.changed_inputs import changed_inputs, contact_inputs
from hardcontact.paper.claims.verdicts import count_verdicts, find_open_end, interval_with_samples
from hardcontact.report.paper_study.headline import headline_facts
from hardcontact.report.paper_study.tables import claim_facts
from hardcontact.report.quantities import all_quantities, number_of
from hardcontact.report.templates import render_note, render_paragraphs, substitutes_note

#: Claims with numbers in the answer, by the names of these numbers.
ANSWER_CLAIMS = {
    "averaged_short_edge": "averaged_short_edge",
    "averaged_long_edge": "averaged_long_edge",
    "outermost_short_edge": "outermost_short_edge",
    "outermost_long_edge": "outermost_long_edge",
    "range_of_adhesion": "range_of_adhesion",
    "work_of_adhesion": "work_of_adhesion",
    "fit_error": "plastic_fits",
    "rigid_over_plastic_error": "plasticity_is_crucial",
    "range_on_whole_surfaces": "range_on_whole_surfaces",
    "work_on_whole_surfaces": "work_on_whole_surfaces",
    "band_force_ratio": "band_is_sufficient",
    "plasticity_shift": "plasticity_moves_short_edge",
    "range_shift": "range_moves_short_edge",
}
#: Status of an edge that no cutoff reaches, by its side.
OPEN_STATUSES = {"short": EdgeStatus.OPEN_ABOVE, "long": EdgeStatus.OPEN_BELOW}
#: Where edge_shifts.nc has the edge without the cause of each shift: contact model, and index among
#: its ascending ranges of adhesion.
EDGES_WITHOUT_CAUSE = {"plasticity_shift": (RIGID, -1), "range_shift": (PLASTIC, 0)}
#: Units of the parameters that are fitted to the forces of each set of scans.
PAIR_UNITS = {"range_of_adhesion": "nm", "work_of_adhesion": "J/m2"}
#: Units of the statistics of forces on surfaces with features.
FORCE_UNITS = {"mean_force_at_pair": "N", "median_force_at_pair": "N", "log_force_std": "1"}


def paper_answer(
    claims: pd.DataFrame,
    datasets: Mapping[str, xr.Dataset],
    *,
    constants: pd.DataFrame,
    table1: pd.DataFrame,
    configuration: Mapping[str, Any],
    version: str,
) -> dict[str, Any]:
    """Return the content of answer.json.

    `claims` comes from `read_judged_claims`, `constants` and `table1` from `base.published`. The
    datasets are `topography`, `filtered_forces`, `edges`, `edge_shifts`, `sensitivity`,
    `band_forces`, `sets`, `features`, `fit`, and `scan_size` from resources/validation.
    """
    labels = datasets["topography"]["label"].to_series()
    sources = datasets["topography"]["source"].to_series()
    numbers = numbers_by_name(*_study_numbers(claims, datasets, constants))
    substrates = [str(name) for name in datasets["edges"]["surface"].values]
    coating_numbers = {name: _surface_numbers(name, datasets) for name in substrates}
    contact = contact_inputs(numeric_configuration(configuration))
    changed = changed_inputs(contact, substrates, table1)
    sets = datasets["sets"]
    facts = claim_facts(claims, sets.sizes["set"], sets.attrs["confidence"]) | {
        "numbers": numbers,
        "substitutes": labels[sources == "substitute"].tolist(),
        "featured": datasets["features"].attrs["label"],
        "is_coarse": any(
            numbers[name].value < numbers[f"{name}_published"].value
            for name in ("scan_pixels", "contacts_per_row")
        ),
        "changed": changed,
    }
    headline = headline_facts(
        numbers,
        {labels[name]: coating_numbers[name] for name in substrates},
        {} if changed else facts["claims"],
        facts["set_count"],
    )
    notes = substitutes_note(facts["substitutes"])
    if facts["featured"]:
        notes.append(render_note("paper_features.txt", "features", **facts))
    verdict_numbers = [] if changed else _verdict_numbers(claims)
    return {
        "study": configuration["study"],
        "version": version,
        "effort": "quick" if facts["is_coarse"] else configuration["effort"],
        "kind": "paper",
        "headline": render_paragraphs("paper_headline.txt", **facts, **headline),
        "verdicts": [] if changed else render_paragraphs("paper_verdicts.txt", **facts),
        "contact": contact,
        "changed": changed,
        "assumed": [],
        "chosen": [],
        "surfaces": [
            {"name": name, "label": labels[name], "source": sources[name]}
            for name in (*substrates, datasets["topography"].attrs["sphere_surface"])
        ],
        "notes": notes,
        "quantities": all_quantities(
            [*numbers.values(), *verdict_numbers],
            {name: coating_numbers[name].values() for name in substrates},
        ),
    }


def _study_numbers(
    claims: pd.DataFrame, datasets: Mapping[str, xr.Dataset], constants: pd.DataFrame
) -> Iterator[Number]:
    """Yield the numbers of the whole study."""
    rows: Any = {row.id: row for row in claims.dropna(subset="computed").itertuples()}
    for name, claim in ANSWER_CLAIMS.items():
        if claim in rows:
            yield from _claim_numbers(name, rows[claim], datasets)
    sensitivity = datasets["sensitivity"]
    yield from strongest_octaves(sensitivity[["octave_sensitivity"]].mean("surface"))
    yield Number("whole_surface_size", float(sensitivity["map_size"].max()), "nm", source="given")
    yield from _pairs_of_sets(datasets, constants)
    yield from _feature_numbers(datasets["features"], datasets["sets"].attrs["confidence"])
    yield from _settings(datasets, constants)


def _verdict_numbers(claims: pd.DataFrame) -> Iterator[Number]:
    """Yield the share of sets in which each claim holds, and how often each verdict was reached."""
    agreeing_shares = claims.dropna(subset="computed").set_index("id")["agreeing_share"]
    for name, claim in ANSWER_CLAIMS.items():
        if claim in agreeing_shares:
            yield Number(f"{name}_agreeing_share", agreeing_shares[claim])
    for row in count_verdicts(claims).to_dict("records"):
        name = "verdicts_" + row["verdict"].replace(" ", "_")
        yield Number(name, row["claims"])
        yield Number(f"{name}_independent", row["independent"])


def _edge_source(filtered_forces: xr.Dataset, side: str, edge: float) -> NumberSource:
    """Return the source of an edge (nm): whether the roughness at this wavelength is artificial."""
    transition = filtered_forces["transition"].sel(side=side).item()
    is_artificial = edge < transition if side == "short" else edge > transition
    return "artificial" if is_artificial else "computed"


def _interval_status(end: str) -> NumberStatus:
    """Return the status of a number whose interval is open at an end, "low" or "high", if any."""
    return NumberStatus(f"interval_open_{end}" if end else "")


def _claim_numbers(name: str, row: Any, datasets: Mapping[str, xr.Dataset]) -> list[Number]:
    """Return the computed and the published number of a claim."""
    source: NumberSource = "computed"
    status: NumberStatus | EdgeStatus = _interval_status(row.open_end)
    averaged_edges = datasets["edges"]["edge"].sel(group=AVERAGED)
    for side, edge_name in EDGE_NAMES.items():
        if name in (f"outermost_{edge_name}", f"averaged_{edge_name}"):
            source = _edge_source(datasets["filtered_forces"], side, row.computed)
        if name == f"averaged_{edge_name}" and np.isnan(averaged_edges.sel(side=side).item()):
            status = OPEN_STATUSES[side]
    if name in EDGES_WITHOUT_CAUSE:  # A shift is artificial if this edge is.
        edge = _edge_without_cause(name, datasets["edge_shifts"])
        source = _edge_source(datasets["filtered_forces"], "short", edge)
    return [
        Number(name, row.computed, row.unit, row.low, row.high, status, source),
        Number(f"{name}_published", row.published, row.unit, source="published"),
    ]


def _edge_without_cause(shift: str, edge_shifts: xr.Dataset) -> float:
    """Return the averaged short edge (nm) without the cause of a shift, by the shift's name."""
    model, index = EDGES_WITHOUT_CAUSE[shift]
    edges = edge_shifts["edge"].sel(side="short", group=AVERAGED, contact_model=model)
    return float(edges.sortby("rho").isel(rho=index))


def _surface_numbers(surface: str, datasets: Mapping[str, xr.Dataset]) -> dict[str, Number]:
    """Return the edges, the mean force and the ratios of forces of one substrate."""
    edges, sets = datasets["edges"], datasets["sets"]
    numbers = {}
    for side, name in EDGE_NAMES.items():
        selection = {"side": side, "group": surface}
        edge = edges_or_bounds(edges).sel(selection).item()
        set_edges = edges_or_bounds(sets).sel(selection).values
        interval = interval_ends(edges.sel(selection), "edge")
        low, high = interval_with_samples(edge, interval, set_edges, edges.attrs["confidence"])
        status = _interval_status(find_open_end(side, edge, low, high, [edges, sets]))
        source = _edge_source(datasets["filtered_forces"], side, edge)
        numbers[name] = Number(name, edge, "nm", low, high, status, source)
    fit = datasets["fit"].sel(contact_model=PLASTIC, pair="published", surface=surface)
    numbers["mean_force"] = number_of(fit, "mean_force_at_pair", name="mean_force")
    band_forces = datasets["band_forces"].sel(band="published", band_part="only the band")
    numbers["band_force_ratio"] = number_of(band_forces.sel(surface=surface), "band_force_ratio")
    small_scans = _small_scan_forces(datasets)
    if surface in small_scans["surface"].values:
        scan = small_scans.sel(surface=surface)
        numbers["small_scan_ratio"] = number_of(scan, "force_over_largest", name="small_scan_ratio")
    return numbers


def _small_scan_forces(datasets: Mapping[str, xr.Dataset]) -> xr.Dataset:
    """Return the forces of scan_size.nc on mirrored scans nearest in size to the study's scans."""
    table = datasets["scan_size"]
    scans = table.sel(map_size=table["mirrored"] == 1)
    return scans.sel(map_size=datasets["topography"]["scan_size"].min(), method="nearest")


def _pairs_of_sets(datasets: Mapping[str, xr.Dataset], constants: pd.DataFrame) -> Iterator[Number]:
    """Yield the median range and work of the sets, with and without the decisive surface.

    Their standard deviation over the sets and their printed uncertainty follow.
    """
    confidence = datasets["sets"].attrs["confidence"]
    sets = datasets["sets"].sel(contact_model=PLASTIC)
    log_ranges = np.log(sets["range_without_surface"].transpose("left_out", "set").values)
    # Without the decisive surface the best ranges scatter least.
    reduced_sets = sets.isel(left_out=log_ranges.std(axis=1).argmin())
    for name, unit in PAIR_UNITS.items():
        yield _median_number(f"all_surfaces_{name}", unit, sets[name].values, confidence)
        sample = reduced_sets[WITHOUT_SURFACE[name]].values
        yield _median_number(f"without_decisive_{name}", unit, sample, confidence)
        yield Number(f"{name}_scatter", float(sets[name].std(ddof=1)), unit)
        uncertainty = constants["uncertainty"][name]
        yield Number(f"{name}_uncertainty", uncertainty, unit, source="published")


def _feature_numbers(features: xr.Dataset, confidence: float) -> Iterator[Number]:
    """Yield the share of candidates of each kind that agree, their forces, and published forces."""
    if features.sizes["candidate"] == 0:
        return
    for feature_kind, candidates in features.groupby("features"):
        yield Number(f"{feature_kind}_candidates_that_agree", candidates["agrees"].mean().item())
        for variable, unit in FORCE_UNITS.items():
            name = f"{feature_kind}_{variable.removesuffix('_at_pair')}"
            yield _median_number(name, unit, candidates[variable].values.ravel(), confidence)
    for variable, unit in FORCE_UNITS.items():
        name = variable.removesuffix("_at_pair")
        value = features.attrs[f"published_{name}"]
        yield Number(f"featured_{name}_published", value, unit, source="published")


def _median_number(name: str, unit: str, sample: np.ndarray, confidence: float) -> Number:
    """Return the median of a number over sets or candidates, with its percentile interval."""
    return Number(name, np.quantile(sample, 0.5), unit, *percentile_interval(sample, confidence))


def _settings(datasets: Mapping[str, xr.Dataset], constants: pd.DataFrame) -> Iterator[Number]:
    """Yield the settings of the study, and the sizes of its grids and of the paper's grids."""
    topography = datasets["topography"]
    filtered_forces = datasets["filtered_forces"]
    sizes = {
        "scan_pixels": (topography.sizes["row"], "1"),
        "scan_size": (topography["scan_size"].min().item(), "nm"),
        "contacts_per_row": (filtered_forces.sizes["contact_y"], "1"),
    }
    for name, (size, unit) in sizes.items():
        yield Number(name, size, unit, source="given")
        yield Number(f"{name}_published", constants["value"][name], unit, source="published")
    yield Number("range_of_band", float(filtered_forces.attrs["rho"]), "nm", source="given")
    yield Number("short_range", SHORT_ADHESION_RANGE, "nm", source="given")
    for name in ("tolerance", "confidence"):
        yield Number(name, float(datasets["edges"].attrs[name]), source="given")
    yield Number("sets", datasets["sets"].sizes["set"], source="given")
    yield Number("masters", filtered_forces.sizes["realization"], source="given")
    map_size = datasets["scan_size"]["map_size"]
    mirrored_size = _small_scan_forces(datasets)["map_size"]
    yield Number("mirrored_scan_size", float(mirrored_size), "nm", source="given")
    yield Number("large_surface_size", float(map_size[-1]), "nm", source="given")
