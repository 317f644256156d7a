"""Table 1: rms height, slope and curvature of the surfaces, published and computed."""

import json
import math
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from hardcontact.figures import drawing, style, tables
from hardcontact.records.published import rows_met

ROW_HEIGHT = 0.19  # inch
MIDDLE: style.Look = {"ha": "center", "va": "center"}
LEFT = -2.2  # where the names of the rows begin, in widths of a column
SCOPES = {
    "AFM scans": "AFM scans alone",
    "all scales": "all scales (published: stylus, AFM and TEM; computed: the joined spectrum)",
}
NOTE = (
    f"{tables.BY_CONSTRUCTION} by construction: substitutes are made to meet this mean "
    "(of AFM scans' heights also the ±), which tests nothing"
)
COLUMNS = [
    "scope", "quantity", "definition", "surface", "label", "basis", "origin",
    "value", "uncertainty", "unit", "by_construction",
]  # fmt: skip
DEFINITIONS = {  # variable: definition
    "height": {"rms_height": ""},
    "slope": {"rms_gradient": "gradient", "rms_profile_slope": "slope of profiles"},
    "curvature": {"rms_half_laplacian": "half the Laplacian", "rms_laplacian": "Laplacian"},
}


class _Quantity(NamedTuple):
    """A row of the paper's Table 1."""

    name: str  # as in resources/paper/table1.csv
    scope: str
    title: str
    unit: str
    printed_unit: float = 1  # in `unit`

    @property
    def definitions(self) -> dict[str, str]:
        """Definition of each variable that it can be computed as."""
        variables = DEFINITIONS[self.name.rpartition("_")[-1]]
        prefix = "all_scales_" if self.scope == "all scales" else ""
        return {f"{prefix}{variable}": definition for variable, definition in variables.items()}


QUANTITIES = (
    _Quantity("afm_rms_height", "AFM scans", "rms height (nm)", "nm"),
    _Quantity("afm_rms_slope", "AFM scans", "rms slope", "1"),
    _Quantity("afm_rms_curvature", "AFM scans", "rms curvature (10⁻³ nm⁻¹)", "nm-1", 1e-3),
    _Quantity("all_rms_height", "all scales", "rms height (nm)", "nm"),
    _Quantity("all_rms_slope", "all scales", "rms slope", "1"),
    _Quantity("all_rms_curvature", "all scales", "rms curvature (nm⁻¹)", "nm-1"),
)


def table(topography: xr.Dataset, published_table1: pd.DataFrame) -> pd.DataFrame:
    """Return the published and the computed values of Table 1, one row a value.

    Heights in nm, slopes 1, curvatures in nm-1; `uncertainty` is the published +- or the standard
    deviation over the scans (none for the moments of the joined spectrum). `by_construction` says
    that a substitute was made to meet the published value under this definition.
    """
    rows = [
        {"scope": quantity.scope, "quantity": quantity.name, "unit": quantity.unit, **row}
        for quantity in QUANTITIES
        for surface in map(str, topography["surface"].values)
        for row in (
            *_published_rows(quantity.name, surface, published_table1),
            *_computed_rows(quantity, topography.sel(surface=surface)),
        )
    ]
    return tables.labelled([pd.DataFrame(rows)], topography, COLUMNS)


def draw(topography: xr.Dataset, published_table1: pd.DataFrame) -> Figure:
    """Draw Table 1 as a figure: one column a surface, published rows above the computed ones."""
    rows = table(topography, published_table1)
    lines = rows[["quantity", "origin", "definition"]].drop_duplicates()
    lines = lines.sort_values("origin", ascending=False, kind="stable")  # published ones first
    columns = [str(name) for name in topography["surface"].values]
    last = 1 + len(SCOPES) + len(lines)
    figure = drawing.create((last + 1) * ROW_HEIGHT + drawing.FOOTER, topography)
    axes = figure.subplots()
    axes.set_axis_off()
    axes.set(xlim=(LEFT, len(columns)), ylim=(last + 1, 0))
    _draw_header(axes, topography, columns)
    cells = {
        (row["quantity"], row["origin"], row["definition"], row["surface"]): row
        for _, row in rows.iterrows()
    }
    top = 1
    for scope, title in SCOPES.items():
        _rule(axes, top, 1.0)
        axes.text(LEFT, top + 0.5, title, style="italic", fontsize=7, va="center")
        top += 1
        for quantity in QUANTITIES:
            if quantity.scope == scope:
                of_quantity = lines[lines["quantity"] == quantity.name]
                _draw_quantity(axes, top, quantity, of_quantity, cells, columns)
                top += len(of_quantity)
    _rule(axes, last, 1.0)
    axes.text(LEFT, last + 0.6, NOTE, fontsize=7, va="center")
    return figure


def _published_rows(quantity: str, surface: str, published: pd.DataFrame) -> list[dict[Any, Any]]:
    of_surface = published[(published["surface"] == surface) & (published["quantity"] == quantity)]
    rows = of_surface[["surface", "value", "uncertainty"]]
    rows = rows.assign(origin="published", definition="", by_construction=False)
    return rows.to_dict("records")


def _computed_rows(quantity: _Quantity, of_surface: xr.Dataset) -> list[dict[str, Any]]:
    """Return a row for each definition: mean over scans, or number of the joined spectrum."""
    by_construction = quantity.name in rows_met(of_surface["calibrated_to_table1"].item())
    taken = json.loads(of_surface.attrs["table1_variables"])[quantity.name].removesuffix("_mean")
    computed = {"surface": of_surface["surface"].item(), "origin": "computed"}
    rows = []
    for variable, definition in quantity.definitions.items():
        mean = "_mean" if f"{variable}_mean" in of_surface else ""
        row = {
            "definition": definition,
            "value": of_surface[f"{variable}{mean}"].item(),
            "uncertainty": of_surface[f"{variable}_std"].item() if mean else np.nan,
            "by_construction": by_construction and variable == taken,
        }
        rows.append({**computed, **row})
    return rows


def _draw_header(axes: Axes, topography: xr.Dataset, columns: list[str]) -> None:
    """Write the surfaces' names in their colours over the columns."""
    colours = style.colours(columns, topography.attrs["sphere_surface"])
    _rule(axes, 0, 1.0)
    for place, surface in enumerate(columns):
        label = str(topography["label"].sel(surface=surface).item())
        colour = colours[surface]
        axes.text(place + 0.5, 0.5, label, color=colour, weight="bold", fontsize=8, **MIDDLE)


def _draw_quantity(
    axes: Axes,
    top: int,
    quantity: _Quantity,
    lines: pd.DataFrame,
    cells: dict[Any, pd.Series],
    columns: list[str],
) -> None:
    """Write the lines of one quantity, downwards from `top`, under a thin rule."""
    _rule(axes, top, 0.4)
    axes.text(LEFT, top + 0.5, quantity.title, weight="bold", fontsize=7, va="center")
    for height, (_, line) in enumerate(lines.iterrows(), start=top):
        origin, definition = line["origin"], line["definition"]
        name = f"{origin}, {definition}" if definition else origin
        axes.text(-0.05, height + 0.5, name, fontsize=7, ha="right", va="center")
        for place, surface in enumerate(columns):
            key = (quantity.name, origin, definition, surface)
            text = _print_cell(cells[key], quantity) if key in cells else "–"
            axes.text(place + 0.5, height + 0.5, text, fontsize=7, **MIDDLE)


def _print_cell(cell: pd.Series, quantity: _Quantity) -> str:
    """Return value and uncertainty in the printed unit, marked if they hold by construction."""
    value, uncertainty = (cell[name] / quantity.printed_unit for name in ("value", "uncertainty"))
    if not np.isfinite(value):
        return "–"
    mark = f" {tables.BY_CONSTRUCTION}" if cell["by_construction"] else ""
    if not np.isfinite(uncertainty):
        return f"{value:.3g}{mark}"
    if cell["origin"] == "published":  # whichever of the two was published with more
        decimals = max(len(f"{number:g}".partition(".")[2]) for number in (value, uncertainty))
    else:
        decimals = _decimals(value, uncertainty)
    return f"{value:.{decimals}f} ± {uncertainty:.{decimals}f}{mark}"


def _decimals(value: float, uncertainty: float) -> int:
    """Return the decimals of two digits of the uncertainty, or of three of the value if fewer."""
    digits = [1 - math.floor(math.log10(uncertainty))] if uncertainty > 0 else []
    digits += [2 - math.floor(math.log10(abs(value)))] if value else []
    return max(0, min(digits, default=2))


def _rule(axes: Axes, height: float, width: float) -> None:
    axes.plot(axes.get_xlim(), [height, height], color="black", lw=width, clip_on=False)
