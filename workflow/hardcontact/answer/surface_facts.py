"""The facts of the answer of own surfaces: its edges, its forces, and what they were made from."""

from collections import Counter
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from hardcontact.answer.artificial import artificial_bands, measurements, place_of_edge, single
from hardcontact.answer.datasets import Datasets, Setting, at_range, model_of
from hardcontact.answer.facts import Fact, fact_of, known
from hardcontact.numbers.statistics import bounds
from hardcontact.surfaces.synthesis import SIDES

EDGES = dict(zip(SIDES, ("short_edge", "long_edge"), strict=True))
#: What an edge comes from, by its place among artificial wavelengths.
SOURCES = {"inside": "artificial", "partly": "partly_artificial", "outside": "measured"}
#: The upper end of an interval is called open where it lies this many times farther, in the
#: logarithm, than the lower one: the scatter of few tests may be much larger than it appears.
LOPSIDED = 2.0
#: J/m², to part diamond along (111): no known solids adhere more strongly. Source: J. E. Field, The
#: Properties of Diamond (Academic Press, 1979).
STRONGEST = 10.6


class Row(NamedTuple):
    """A row of the table of an answer.

    Attributes
    ----------
    surface : str
        Its label; empty for all surfaces together.
    fact : Fact
        The number, whose name and source are codes.
    about : dict
        What else is known of it: `reason` of an open edge, `side`, `start` and `end` of continued
        roughness, `tests` of a measured force.
    """

    surface: str
    fact: Fact
    about: dict[str, Any]


def edge_fact(of_side: xr.Dataset, name: str, source: str, prefix: str = "") -> Fact:
    """Return the edge at one side, or the bound of an open one, with the ends that are known.

    Parameters
    ----------
    of_side : xarray.Dataset
        Part of edges.nc at one side, of one surface or, with the prefix "pooled_", of all.
    name, source : str
        Of the fact.
    prefix : str
        Of the variables.

    Returns
    -------
    Fact
        In nm. An interval without ends is "not_bounded" if the force ratios have intervals.
    """
    edge, bound = (of_side[f"{prefix}{part}"].item() for part in ("edge", "edge_bound"))
    low, high = (known(end.item()) for end in bounds(of_side, f"{prefix}edge"))
    if np.isnan(edge):
        status = "open_above" if of_side[f"{prefix}edge_at_least"].item() else "open_below"
        return Fact(name, known(bound), "nm", low, high, status, source)
    scatter = of_side["pooled_change_interval" if prefix else "scale_ratio_interval"]
    endless = low is None and high is None and bool(np.isfinite(scatter).any())
    return Fact(name, known(edge), "nm", low, high, "not_bounded" if endless else "known", source)


def edge_facts(of: Datasets) -> dict[str, Fact]:
    """Return the edge at each side of one surface, with its place among artificial wavelengths."""
    bands = artificial_bands(of.spectra)
    sides = {side: of.edges.sel(side=side) for side in SIDES}
    return {
        side: edge_fact(part, EDGES[side], SOURCES[place_of_edge(part, bands)])
        for side, part in sides.items()
    }


def differing_sides(data: xr.Dataset) -> list[str]:
    """Return the sides on which continued roughness changes the force beyond its interval."""
    return [side for side in SIDES if data["continued_differs"].sel(side=side).item() == 1]


def continuation(force: xr.Dataset, side: str) -> dict[str, Any]:
    """Return between which wavelengths roughness continues that of the scans at one side."""
    names = {"start": "transition", "end": "continued_end"}
    of_side = force.sel(side=side)
    return {"side": side} | {
        name: fact_of(of_side, of, name, unit="nm") for name, of in names.items()
    }


def continued_fact(force: xr.Dataset, side: str) -> Fact:
    """Return the force with roughness continued at one side."""
    return fact_of(force.sel(side=side), "continued_force", "force_continued", "extrapolated")


def force_rows(label: str, force: xr.Dataset) -> list[Row]:
    """Return the predicted forces of one surface at the range asked for, and the smooth limit."""
    here = at_range(force)
    quantiles = here["force_quantile"]
    least, median, most = (
        known(quantiles.sel(quantile=share, method="nearest").item()) for share in (0, 0.5, 1)
    )
    radius, work = (force.attrs[name] for name in ("sphere_radius", "work_of_adhesion"))
    smooth = 2 * np.pi * 1e-9 * radius * work
    continued = [
        Row(label, continued_fact(force, side), continuation(force, side))
        for side in differing_sides(force)
    ]
    share = Fact("share", float(np.ptp(quantiles["quantile"].values)), "1")
    return [
        Row(label, fact_of(here, "force", "force_mean"), {"model": model_of(force)}),
        *continued,
        Row(label, Fact("force_median", median, "N"), {}),
        Row(label, Fact("force_middle", None, "N", least, most, "between"), {"share": share}),
        Row(label, Fact("smooth_sphere", float(smooth), "N"), {}),
    ]


def of_answer(fit: xr.Dataset) -> xr.Dataset:
    """Return the fit of the contact model of the answer."""
    return fit.sel(contact_model=model_of(fit))


def measured_rows(label: str, fit: xr.Dataset) -> list[Row]:
    """Return the force measured on one surface, and what works of adhesion it means."""
    here = fit.sel(rho=fit.attrs["range_of_adhesion"], method="nearest")
    force = fact_of(fit, "measured_force", "measured_force", "measured")
    about = {"tests": int(fit["tests"].item()), "lopsided": _is_lopsided(force)}
    work = fact_of(here, "work_of_adhesion", "measured_work", "from_measured")
    strong = work.value is not None and work.value > STRONGEST
    continued = [
        Row(
            label,
            fact_of(fit.sel(side=side), "continued_work", "continued_work", "extrapolated"),
            {"side": side, "start": fact_of(fit.sel(side=side), "transition", "start")},
        )
        for side in differing_sides(fit)
    ]
    return [Row(label, force, about), Row(label, work, {"beyond_solids": strong}), *continued]


def _is_lopsided(fact: Fact) -> bool:
    """Return whether the upper end of an interval lies much farther than the lower one."""
    if fact.value is None or fact.low is None or fact.high is None:
        return False
    return bool(np.log(fact.high / fact.value) > LOPSIDED * np.log(fact.value / fact.low))


def answer_rows(label: str, of: Datasets, fit: xr.Dataset | None) -> list[Row]:
    """Return the rows of one surface: its edges, its forces and, if it has any, its own forces.

    Parameters
    ----------
    label : str
        Of the surface.
    of : Datasets
        Its parts.
    fit : xarray.Dataset or None
        As fit.nc, of all surfaces with forces.

    Returns
    -------
    list of Row
        In the order of the table.
    """
    edges = [
        Row(label, fact, {"reason": str(of.edges["edge_status"].sel(side=side).item())})
        for side, fact in edge_facts(of).items()
    ]
    surface = str(of.edges["surface"].item())
    own = []
    if fit is not None and surface in fit["surface"].values:
        own = measured_rows(label, of_answer(fit).sel(surface=surface))
    return [*edges, *force_rows(label, of.force), *own]


def pooled_rows(edges: xr.Dataset) -> list[Row]:
    """Return the edges of the mean change over several surfaces, none of a single one."""
    if "pooled_edge" not in edges:
        return []
    sides = {side: edges.sel(side=side) for side in SIDES}
    return [
        Row("", edge_fact(part, f"pooled_{EDGES[side]}", "computed", "pooled_"), {})
        for side, part in sides.items()
    ]


class Verdict(NamedTuple):
    """The answer of a surface at a glance, without intervals."""

    label: str  #: Of the surface.
    edges: tuple[Fact, Fact]  #: Short and long.
    forces: tuple[Fact, Fact]  #: Least and greatest, the same where the scans say all.


def verdict(rows: Sequence[Row]) -> Verdict:
    """Return the verdict of one surface from its rows."""
    bare = {row.fact.name: row.fact._replace(low=None, high=None) for row in rows}
    forces = sorted(
        (row.fact for row in rows if row.fact.name in ("force_mean", "force_continued")),
        key=lambda fact: fact.value or 0.0,
    )
    least, most = (
        one._replace(low=None, high=None, status="known") for one in (forces[0], forces[-1])
    )
    short, long = (
        bare[name]._replace(status="known") if bare[name].status == "not_bounded" else bare[name]
        for name in EDGES.values()
    )
    return Verdict(rows[0].surface, (short, long), (least, most))


def contact_inputs(setting: Setting) -> list[dict[str, str]]:
    """Return what contacts were computed for, as printed, and whether the user gave it."""
    return [
        {"name": name, "text": text, "source": _source(name, text, setting.of_paper)}
        for name, text in setting.contact.items()
    ]


def _source(name: str, text: str, of_paper: Sequence[str]) -> str:
    if name == "sphere":
        return "assumed" if text == "smooth" else "file"
    return "assumed" if name in of_paper else "given"


def scan_inputs(label: str, spectra: xr.Dataset) -> list[dict[str, Any]]:
    """Return the measurements of one surface: those alike are counted together."""
    names = ("size", "pixel_size", "tip_radius")
    alike = Counter(
        (str(one["kind"].item()), tuple(known(one[name].item()) for name in names))
        for one in single(measurements(spectra))
    )
    return [
        {"surface": label, "kind": kind, "count": count}
        | {
            name: Fact(name, value, "nm", status="known" if value else "not_known", source="file")
            for name, value in zip(names, values, strict=True)
        }
        for (kind, values), count in alike.items()
    ]


def fit_facts(fit: xr.Dataset) -> dict[str, Any]:
    """Return what the forces measured on several surfaces allow together, as a status and facts.

    Parameters
    ----------
    fit : xarray.Dataset
        Part of fit.nc of one contact model: `work_of_adhesion` (surface, rho) with its interval,
        `region` (rho, bound), its extent and, of several surfaces, the best fit.

    Returns
    -------
    dict
        ``status``: "one_surface", "no_interval" (of a surface, so that there is no region), "none"
        (no pair agrees with all forces) or "region"; ``best_range``, ``best_work``, ``best_error``,
        ``region_range`` and ``region_work`` (Fact), and ``gaps``, pairs of ranges (nm) between
        which the region has none.
    """
    allowed = np.isfinite(fit["region"].values).all(axis=-1)
    status = "region" if allowed.any() else "none"
    if fit["work_of_adhesion_interval"].isnull().any():
        status = "no_interval"
    if fit.sizes["surface"] == 1:
        status = "one_surface"
    units = {"best_range": "nm", "best_work": "J m-2", "best_error": "1"}
    extents = {"region_range": "nm", "region_work": "J m-2"}
    spans: dict[str, Any] = {}
    for name, unit in extents.items():
        low, high = map(known, fit[name].values.tolist())
        spans[name] = Fact(name, None, unit, low, high, "between")
    return (
        {"status": status, "gaps": _gaps(fit["rho"].values, allowed)}
        | {name: Fact(name, known(fit[name].item()), unit) for name, unit in units.items()}
        | spans
    )


def _gaps(rho: np.ndarray, allowed: np.ndarray) -> list[list[float]]:
    """Return the pairs of ranges between which a region has gaps."""
    change = np.diff(allowed.astype(int))
    ends, begins = np.flatnonzero(change == -1), np.flatnonzero(change == 1) + 1
    begins = begins[begins > ends[0]] if len(ends) else begins[:0]
    return [[float(rho[end]), float(rho[begin])] for end, begin in zip(ends, begins, strict=False)]
