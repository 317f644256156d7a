"""Where the bearing area is wrong, in sentences of plain text."""

from collections.abc import Iterator

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from hardcontact.answer.part_text import DIGITS, NEAR_ONE, listed, print_each, print_percent
from hardcontact.statistics import bounds

__all__ = ["amounts", "disputed", "elastic_limit_sentences"]

#: Of contacts that yield: by the index of all, and by the pressure of those that were solved.
SHARES = ["plastic_share", "solved_plastic_share"]


def elastic_limit_sentences(elastic_limit: xr.Dataset) -> list[str]:
    """Return for which contacts the bearing area holds, and by how much forces are wrong.

    Parameters
    ----------
    elastic_limit : xarray.Dataset
        As from `elastic_limit.elastic_limit`.

    Returns
    -------
    list of str
        The answer first.
    """
    return [
        _answer(elastic_limit),
        _shares(elastic_limit),
        _largest(elastic_limit),
        *_forces(elastic_limit),
        *_left_open(elastic_limit),
        _areas(elastic_limit),
    ]


def amounts(share: xr.DataArray) -> NDArray[np.str_]:
    """Return how many contacts of every surface yield: "none", "all", "some", or not known."""
    words = np.where(share == 0, "none", np.where(share == 1, "all", "some"))
    return np.where(np.isnan(share), "", words)


def disputed(limit: xr.Dataset) -> NDArray[np.bool_]:
    """Return for every surface whether index and solved pressure say different things."""
    by_index, solved = (amounts(limit[name]) for name in SHARES)
    return np.asarray((by_index != solved) & (solved != ""))


def _answer(limit: xr.Dataset) -> str:
    open_, yielding = disputed(limit), amounts(limit["plastic_share"])
    names = limit["label"].values
    said = {
        f"{amount} on {listed(names[chosen])}": amount
        for amount in ("none", "some", "all")
        if (chosen := (yielding == amount) & ~open_).any()
    }
    if open_.any():
        said[f"not decided on {listed(names[open_])}, where both disagree"] = ""
    if set(said.values()) & {"none", "some"}:
        answer = "No"
    else:
        answer = "Not decided" if open_.any() else "Yes"
    return (
        f"{answer}. By the rms slope of the gap and by solved elastic pressures these contacts "
        f"yield: {'; '.join(said)}."
    )


def _shares(limit: xr.Dataset) -> str:
    return (
        "The bearing area takes every contact as plastic. By the rms slope of the gap, this share "
        f"of contacts yields: {print_each(limit, 'plastic_share')}; of the contacts whose elastic "
        f"pressure was solved: {print_each(limit, 'solved_plastic_share')}."
    )


def _largest(limit: xr.Dataset) -> str:
    """Return the most by which the mean force of any surface is wrong, up and down."""
    said = []
    for variant, sign, where in (("larger_area", 1, "above"), ("recovered", -1, "below")):
        of_variant = limit.sel(variant=variant)
        ratios = of_variant["force_ratio"].values
        farthest = of_variant.isel(surface=int(np.argmax(sign * ratios)))
        ends = sorted(sign * (end.item() - 1) for end in bounds(farthest, "force_ratio"))
        change = print_percent(sign * (farthest["force_ratio"].item() - 1), *ends)
        said.append(f"at most {change} {where} (on {farthest['label'].item()})")
    return (
        "If the slope tells which contacts yield, mean forces compare with those of the bearing "
        f"area thus: {' and '.join(said)}."
    )


def _forces(limit: xr.Dataset) -> list[str]:
    """Return both ends of the bracket, over the force of the bearing area."""
    ends = {
        "larger_area": "with the larger, elastic area flattened for good",
        "recovered": "with all that does not yield recovered before pull-off",
    }
    return [
        f"Mean force {words}, over that of the bearing area: "
        f"{print_each(limit.sel(variant=variant), 'force_ratio', NEAR_ONE)}."
        for variant, words in ends.items()
    ]


def _left_open(limit: xr.Dataset) -> Iterator[str]:
    """Yield what forces may be where the solved pressures contradict the index."""
    open_ = disputed(limit)
    if open_.any():
        where = limit.isel(surface=open_)
        rigid = print_each(where.sel(variant="rigid"), "force_ratio", NEAR_ONE)
        areas = where["solved_area"].max(["scan", "contact"]).values / limit.attrs["bearing_area"]
        larger = listed(f"{area:.{DIGITS}g}" for area in areas)
        yield (
            f"On {listed(where['label'].values)}, where the solved pressures contradict the slope, "
            f"forces over those of the bearing area may fall to {rigid}, where all contacts "
            f"recover as rigid bodies do, and may rise, as solved areas reach {larger} times the "
            "bearing area."
        )


def _areas(limit: xr.Dataset) -> str:
    factors = limit["estimated_area"].values / limit["solved_area"].values
    known = factors[np.isfinite(factors)]
    low, middle, high = np.quantile(known, [0.05, 0.5, 0.95])
    return (
        f"The elastic area estimated from the slope is {middle:.{DIGITS}g} times the solved one in "
        f"the median of {len(known)} contacts, {low:.{DIGITS}g} to {high:.{DIGITS}g} times in nine "
        "of ten."
    )
