"""Table 1 of the paper: published and computed rms height, slope and curvature of surfaces."""

import math
from typing import NamedTuple

import pandas as pd
import xarray as xr

from hardcontact.base.published import rows_met
from hardcontact.surfaces.metrics import TABLE1_VARIABLES


class _Quantity(NamedTuple):
    """A quantity of the paper's Table 1."""

    name: str  # as in resources/paper/table1.csv
    title: str
    printed_unit: float  # in the unit of the datasets
    variable_titles: dict[str, str]  # titles of the variables that may correspond to it


TABLE1_QUANTITIES = (
    _Quantity("afm_rms_height", "AFM scans: rms height (nm)", 1, {"rms_height": "computed"}),
    _Quantity("afm_rms_slope", "AFM scans: rms slope", 1, {
        "rms_gradient": "computed, gradient",
        "rms_profile_slope": "computed, slope of profiles",
    }),
    _Quantity("afm_rms_curvature", "AFM scans: rms curvature (10⁻³ nm⁻¹)", 1e-3, {
        "rms_half_laplacian": "computed, half the Laplacian",
        "rms_laplacian": "computed, Laplacian",
    }),
    _Quantity("all_rms_height", "All scales: rms height (nm)", 1, {
        "all_scales_rms_height": "computed",
    }),
    _Quantity("all_rms_slope", "All scales: rms slope", 1, {
        "all_scales_rms_gradient": "computed, gradient",
        "all_scales_rms_profile_slope": "computed, slope of profiles",
    }),
    _Quantity("all_rms_curvature", "All scales: rms curvature (nm⁻¹)", 1, {
        "all_scales_rms_half_laplacian": "computed, half the Laplacian",
        "all_scales_rms_laplacian": "computed, Laplacian",
    }),
)  # fmt: skip


def table1_rows(topography: xr.Dataset, published: pd.DataFrame) -> list[list[str]]:
    """Return the rows of Table 1 as printed: a title, then the value for each surface.

    Values of scans are mean and standard deviation over the scans of a surface. Values over all
    scales are those of the joined spectrum. A dagger marks what substitutes meet by construction.
    """
    surfaces = [topography.sel(surface=name) for name in topography["surface"].values]
    rows = []
    for quantity in TABLE1_QUANTITIES:
        values = published[published["quantity"] == quantity.name].set_index("surface")
        cells = [
            _print_published(values, str(data["surface"].item()), quantity) for data in surfaces
        ]
        rows.append([f"{quantity.title}, published", *cells])
        for variable, title in quantity.variable_titles.items():
            rows.append([title, *[_print_computed(data, variable, quantity) for data in surfaces]])
    return rows


def _print_published(values: pd.DataFrame, surface: str, quantity: _Quantity) -> str:
    """Return a published value and its uncertainty, with equally many decimals."""
    if surface not in values.index:
        return "–"
    numbers = values.loc[[surface], ["value", "uncertainty"]].to_numpy(float)
    value, uncertainty = numbers[0] / quantity.printed_unit
    decimals = max(len(f"{number:g}".partition(".")[2]) for number in (value, uncertainty))
    return _print_with_uncertainty(value, uncertainty, decimals)


def _print_computed(surface: xr.Dataset, variable: str, quantity: _Quantity) -> str:
    """Return a computed value: mean over scans, or rms value of the joined spectrum."""
    mean = f"{variable}_mean"
    value = surface[mean if mean in surface else variable].item() / quantity.printed_unit
    spread = (
        surface[f"{variable}_std"].item() / quantity.printed_unit if mean in surface else math.nan
    )
    meets_by_construction = quantity.name in rows_met(surface["table1_rows_met"].item())
    is_of_table1 = TABLE1_VARIABLES[quantity.name] in (variable, mean)
    mark = " †" if meets_by_construction and is_of_table1 else ""
    return _print_with_uncertainty(value, spread, decimals_of(value, spread)) + mark


def _print_with_uncertainty(value: float, uncertainty: float, decimals: int) -> str:
    if not math.isfinite(value):
        return "–"
    if not math.isfinite(uncertainty):
        return f"{value:.3g}"
    return f"{value:.{decimals}f} ± {uncertainty:.{decimals}f}"


def decimals_of(value: float, uncertainty: float) -> int:
    """Return the decimals for two digits of the uncertainty and at most three of the value."""
    digits = [1 - math.floor(math.log10(uncertainty))] if uncertainty > 0 else []
    digits += [2 - math.floor(math.log10(abs(value)))] if value and math.isfinite(value) else []
    return max(0, min(digits, default=2))
