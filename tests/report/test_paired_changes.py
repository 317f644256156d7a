"""Changes between two studies: the scatter that their sets of scans share cancels."""

import json

import numpy as np
import pytest
import xarray as xr

from hardcontact.base.number import Number
from hardcontact.report.paper_study.answer import FORCE_UNITS
from hardcontact.report.study_comparison import ComparedNumber, add_paired_intervals, pairing
from hardcontact.surfaces.metrics import TABLE1_METRICS

#: Number of sets: so many that the quantiles of a normal distribution are met to 0.05 %.
SETS = 20_000
#: Standard deviation of the logarithm of the change over sets.
SCATTER = 0.01
#: Parameters of sets.nc: all but `loading` and `tolerance` decide which scans and masters it has.
PARAMETERS = {
    "pool_chunks": [["uncd", 1, 15]], "candidate_chunks": [],
    "master_surfaces": ["uncd"], "master_pool_size": 20, "loading": "H25GPa-F10uN",
    "settings": {"seed": 2021, "master_count": 5, "tolerance": 0.1},
}  # fmt: skip


def study(factor=1.0, scatter=0.0, rms=11.0, **settings):
    """A study of one coating, whose numbers scatter over sets of scans that all studies share.

    The numbers are multiplied by a factor, whose logarithm scatters, too, but in this study alone.
    """
    shared, unshared = np.random.default_rng(1).standard_normal((2, SETS))
    numbers = factor * np.exp(0.3 * shared + scatter * unshared)
    fits = (("set", "contact_model"), np.stack([numbers, numbers], axis=1))
    edges = (("set", "side", "group"), np.tile(numbers[:, None, None], (1, 2, 1)))
    sets = xr.Dataset(
        {
            "value": (("set", "claim"), np.stack([numbers, numbers], axis=1)),
            "range_of_adhesion": fits, "work_of_adhesion": fits, "edge": edges,
        },
        {
            "claim": ["averaged_short_edge", "mean_force_uncd"],
            "contact_model": ["rigid", "plastic"], "side": ["short", "long"], "group": ["uncd"],
            "surface": ["uncd"],
        },
        {
            "confidence": 0.95,
            "parameters": json.dumps(PARAMETERS | {"settings": PARAMETERS["settings"] | settings}),
        },
    )  # fmt: skip
    metrics = {name: (("surface", "scan"), [[rms, rms + 1]]) for name in TABLE1_METRICS.values()}
    labels = {"label": ("surface", ["UNCD"])}
    masters = {"spectrum_end": ("surface", [5.0]), "transition": ("side", [20.0, 2500.0])}
    coordinates = {"surface": ["uncd"]}
    return {
        "sets": sets,
        "topography": xr.Dataset(metrics | labels, coordinates),
        "filtered_forces": xr.Dataset(masters, coordinates),
        "features": xr.Dataset(
            {name: (("features", "candidate"), numbers[None]) for name in FORCE_UNITS},
            {"features": ["bumps"]},
        ),
    }


def compared_numbers(factor):
    """Numbers that change by a factor within their intervals; sets lack the first, an octave."""
    names = [
        ("", "octave_1"), ("", "averaged_short_edge"), ("", "bumps_mean_force"),
        ("UNCD", "long_edge"), ("UNCD", "mean_force"),
    ]  # fmt: skip
    return [
        ComparedNumber(surface, name, Number(name, 1, "", 0.5, 2), Number(name, factor, "", 0.5, 2))
        for surface, name in names
    ]


def test_shared_scatter_cancels_from_the_change():
    """Quantiles of the normal distribution: 95 % lie within 1.96 deviations."""
    # Another tolerance leaves the scans of the sets the same.
    first, second = study(), study(1.05, SCATTER, tolerance=0.2)
    assert pairing(first, second) == "paired"
    numbers = add_paired_intervals(compared_numbers(1.05), first, second)
    assert [number.agreement for number in numbers] == ["same"] + ["changed"] * 4
    ends = 1.05 * np.exp(1.96 * SCATTER * np.array([-1, 1]))
    for number in numbers[1:]:
        assert number.change.value == 1.05
        assert (number.change.low, number.change.high) == pytest.approx(ends, rel=5e-4)


@pytest.mark.parametrize(
    ("other", "reason"),
    [
        ({}, "no_sets"),
        (study(seed=2022), "other_scans"),
        (study(master_count=4), "other_scans"),
        (study(rms=11.1), "other_scans"),
    ],
)
def test_studies_of_other_scans_are_not_paired(other, reason):
    assert pairing(study(), other) == pairing(other, study()) == reason
