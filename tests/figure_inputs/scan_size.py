"""Excess of forces on small scans and their long edges, as numbers without meaning."""

import numpy as np
import xarray as xr

from figure_inputs.building import bounded, named

RATIOS = ["draw size / scan size", "roll-off / scan size", "rms height / range"]
SIZES, RHO, TRIALS = [1250.0, 2500.0, 5000.0], [1.4, 5.6], 5
#: The last two are whole surfaces.
EDGE_SIZES, CUTOFFS = [*SIZES, 20e3, 40e3], [500.0, 2000.0]
DIMENSIONS = ("surface", "scan_size", "rho")
ON_SIZES = ("surface", "edge_size")


def scan_size() -> xr.Dataset:
    """Return factors of the force and edges that differ by all they depend on."""
    excess = 1 + np.arange(4 * 3 * 2.0).reshape(4, 3, 2) / 10
    known = 1 + np.arange(TRIALS * 3 * 2.0).reshape(TRIALS, 3, 2) / 20
    data = named().assign_coords(
        scan_size=SIZES, rho=RHO, ratio=RATIOS,
        tested=["random surfaces", "surfaces"], kind=["corrected", "uncorrected"],
    )  # fmt: skip
    return data.assign(bounded("excess", DIMENSIONS, excess)).assign(
        predicted_excess=(DIMENSIONS, 1.1 * excess),
        known_excess=(("trial", *DIMENSIONS[1:]), known),
        predicted_known_excess=(("trial", *DIMENSIONS[1:]), 0.9 * known),
        strength=0.25,
        exponent=("ratio", [1.3, 0.1, -0.4]),
        error=(("tested", "kind"), np.log([[1.1, 1.5], [1.2, 2.0]])),
        size_needed=(("surface", "rho"), 1e3 * np.arange(1.0, 9).reshape(4, 2)),
    ).merge(_edges()).assign_attrs(
        sphere_radius=250e3, surface_size=20e3, allowed_excess=1.1, rho=5.6, scan_size=2500.0,
        tolerance=0.1, confidence=0.9,
    )  # fmt: skip


def _edges() -> xr.Dataset:
    """Return long edges, two of them open: one is longer than its bound, one shorter."""
    edge = 1000 + 10 * np.arange(4 * 5.0).reshape(4, 5)
    over = 2 - np.arange(4 * 5.0).reshape(4, 5) / 20
    data = named().drop_vars(["label", "basis"]).assign_coords(
        edge_size=EDGE_SIZES, cutoff_wavelength=CUTOFFS
    ).assign(bounded("long_edge", ON_SIZES, edge, unit="nm"))  # fmt: skip
    data = data.assign(bounded("force_over_largest", ON_SIZES, over)).assign(
        long_edge_bound=(ON_SIZES, np.full((4, 5), np.nan)),
        long_edge_at_least=(ON_SIZES, np.zeros((4, 5), int)),
        long_edge_status=(ON_SIZES, np.full((4, 5), "found", dtype="<U20")),
        mirrored=("edge_size", [1, 1, 1, 0, 0]),
        period=("edge_size", [2500.0, 5000.0, 10000.0, 20e3, 40e3]),
    )  # fmt: skip
    for size, bound, at_least, status in (
        (1250.0, 2400.0, 1, "beyond the cell"),
        (5000.0, 500.0, 0, "beyond the cutoffs"),
    ):
        place = {"surface": "mcd", "edge_size": size}
        data["long_edge"].loc[place] = np.nan
        data["long_edge_interval"].loc[place] = np.nan
        data["long_edge_bound"].loc[place] = bound
        data["long_edge_at_least"].loc[place] = at_least
        data["long_edge_status"].loc[place] = status
    return data
