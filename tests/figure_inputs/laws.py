"""Fits, ratios and edges of every law of attraction, as numbers that differ by law and case."""

import numpy as np
import xarray as xr
from paper_numbers import SUBSTRATES

from figure_inputs.building import bounded, named
from figure_inputs.scales import CRITICAL, SIDES, TOLERANCE
from hardcontact.insight.interaction_laws import LAWS
from hardcontact.insight.law_comparison import CASES

BY_LAW = ("law", "case")
WORK = 0.05
LENGTHS = np.geomspace(0.1, 40, 50)


def laws() -> xr.Dataset:
    """Return them at the lengths that are tried."""
    factor = 1 + 0.1 * np.arange(12.0).reshape(4, 3)
    ratio = factor[..., None] * np.array([22, 1, 0.4, 0.275])
    edges = factor[..., None, None] * CRITICAL
    error = 0.2 + abs(np.log(LENGTHS / 5.6)) * np.ones((4, 2, 1))
    named_laws = {"law": [law.name for law in LAWS], "case": CASES, "side": SIDES}
    return (
        named()
        .assign_coords(
            **named_laws,
            group=[*SUBSTRATES, "pooled"],
            length=LENGTHS,
            target=["Eq. 1", "published"],
        )
        .assign(
            bounded("range_of_law", BY_LAW, 5.6 * factor, unit="nm")
            | bounded("work_of_adhesion", BY_LAW, WORK * factor, unit="J m-2")
            | bounded("fit_error", BY_LAW, 0.1 * factor)
            | bounded("ratio", (*BY_LAW, "surface"), ratio)
            | bounded("critical_wavelength", (*BY_LAW, "side", "group"), edges, unit="nm")
        )
        .assign(
            implied_over_known=(BY_LAW, 10 * factor),
            error=(("law", "target", "length"), error),
            published_ratio=("surface", [22.0, 1, 0.4, 0.275]),
            law_label=("law", [law.label for law in LAWS]),
        )
        .assign_attrs(
            reference_label="UNCD",
            scale_tolerance=TOLERANCE,
            atomic_spacing=0.3,
            confidence=0.9,
            scans=3,
            contacts=64,
        )
    )
