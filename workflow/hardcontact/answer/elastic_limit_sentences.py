"""Where the bearing area is wrong, in sentences of plain text."""

import numpy as np
import xarray as xr

from hardcontact.answer.part_text import DIGITS, print_each, print_percent

__all__ = ["elastic_limit_sentences"]


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
        _shares(elastic_limit),
        _largest(elastic_limit),
        *_forces(elastic_limit),
        _areas(elastic_limit),
    ]


def _shares(limit: xr.Dataset) -> str:
    return (
        "The bearing area takes every contact as plastic. By the rms slope of the gap, this share "
        f"of contacts yields: {print_each(limit, 'plastic_share')}; of the contacts whose elastic "
        f"pressure was solved: {print_each(limit, 'solved_plastic_share')}."
    )


def _largest(limit: xr.Dataset) -> str:
    """Return the most by which the mean force of any surface is wrong, up and down."""
    ratio = limit["force_ratio"].sel(variant=["larger_area", "recovered"])
    up, down = max(float(ratio.max()) - 1, 0.0), max(1 - float(ratio.min()), 0.0)
    return (
        "The mean force of no surface is wrong by more than "
        f"{print_percent(up)} up or {print_percent(down)} down for that."
    )


def _forces(limit: xr.Dataset) -> list[str]:
    """Return both ends of the bracket, over the force of the bearing area."""
    ends = {
        "larger_area": "with the larger, elastic area flattened for good",
        "recovered": "with all that does not yield recovered before pull-off",
    }
    return [
        f"Mean force {words}, over that of the bearing area: "
        f"{print_each(limit.sel(variant=variant), 'force_ratio')}."
        for variant, words in ends.items()
    ]


def _areas(limit: xr.Dataset) -> str:
    factors = limit["estimated_area"].values / limit["solved_area"].values
    known = factors[np.isfinite(factors)]
    low, middle, high = np.quantile(known, [0.05, 0.5, 0.95])
    return (
        f"The elastic area estimated from the slope is {middle:.{DIGITS}g} times the solved one in "
        f"the median of {len(known)} contacts, {low:.{DIGITS}g} to {high:.{DIGITS}g} times in nine "
        "of ten."
    )
