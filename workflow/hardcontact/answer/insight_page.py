"""The page on what decides the band: a question, its numbers and a figure for each part.

A new part takes a figure in `figures.listing.OF_INSIGHT`, with its module, the rule that
makes the dataset of that figure, an entry in `PARTS`, and its question and its words among the
templates, in ``insight.html`` and ``insight/<figure>.html``.
"""

from collections.abc import Callable, Mapping
from typing import Any

import pandas as pd
import xarray as xr

from hardcontact.answer import insight_facts as facts
from hardcontact.answer import insight_force_facts as force_facts
from hardcontact.answer.captions import Caption
from hardcontact.answer.facts import percent, surfaces
from hardcontact.answer.templates import rendered
from hardcontact.numbers.number import Number

#: What returns the numbers of each part, by its figure, from the dataset of that figure and the
#: band.
PARTS: dict[str, Callable[[xr.Dataset, xr.Dataset], dict[str, Any]]] = {
    "fig_scaling": lambda scaling, _: facts.scaling_facts(scaling),
    "fig_scan_size": lambda scan_size, _: facts.scan_size_facts(scan_size),
    "fig_closed_form": facts.closed_form_facts,
    "fig_laws": lambda laws, _: force_facts.law_facts(laws),
    "fig_statistics": lambda statistics, _: force_facts.statistics_facts(statistics),
    "fig_elastic_limit": lambda limit, _: force_facts.elastic_limit_facts(limit),
}


def insight_page(
    datasets: Mapping[str, xr.Dataset],
    band: xr.Dataset,
    figures: Mapping[str, tuple[bytes, Caption]],
    constants: pd.DataFrame,
    pixels: int,
    errors: Mapping[tuple[str, str], tuple[Number, int]],
) -> str:
    """Return the page, HTML.

    Datasets, and figures as SVG with their captions, are by the figures of the parts, in the order
    of the page. The band is as from `critical_band.critical_band`, with labels and bases; constants
    are as from `published.constants`, the scans have `pixels` along an edge, and the errors of the
    closed form are as from `prediction.validated_errors`.
    """
    of_surfaces = [one for one in (band, *datasets.values()) if "surface" in one.dims]
    bases: dict[Any, Any] = {}
    for dataset in of_surfaces:
        for row, _ in surfaces(dataset):
            # The first is the band, which knows the study's own scans; a validation table does not.
            bases.setdefault(row["surface"], row["basis"])
    return rendered(
        "insight.html",
        coarse=pixels < constants["value"]["scan_pixels"],
        parts={name: PARTS[name](datasets[name], band) for name in figures},
        figures=figures,
        band=facts.band_facts(band, constants),
        validated=[
            {"quantity": name, "regime": regime, "error": error, "surfaces": Number("n", count)}
            for (name, regime), (error, count) in errors.items()
        ],
        substitutes=[label for label, basis in bases.items() if basis == "substitute"],
        confidence=percent(Number("confidence", band.attrs["confidence"])),
    )
