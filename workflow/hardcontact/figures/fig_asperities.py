"""Asperities: how few patches carry the pull-off force, and how far apart they lie."""

from typing import NamedTuple

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from hardcontact.figures import style, tables
from hardcontact.numbers.printing import print_share
from hardcontact.scales.critical_band import POOLED

MICROMETRE = 1000  # nm
QUARTILES = {"low": 0.25, "value": 0.5, "high": 0.75}


class _Quantity(NamedTuple):
    """The quantity of one panel, and how it is printed."""

    panel: str
    title: str
    axis: str
    unit: str
    printed_unit: float = 1  # in `unit`


QUANTITIES = {
    "largest_share": _Quantity("a", "largest patch", "share of the force", "1"),
    "two_largest_share": _Quantity("b", "two largest patches", "share of the force", "1"),
    "patches": _Quantity("c", "patches with {share:g} % of the force", "number of patches", "1"),
    "extent": _Quantity(
        "d", "diameter that holds {share:g} % of the force", "length (µm)", "nm", MICROMETRE
    ),
}
SMOOTH = {
    "smooth_extent": ("smooth sphere on a plane (d)", "-"),
    "interaction_radius": ("interaction radius √(2Rρ) (d)", "-."),
}
COLUMNS = [*tables.ROW_COLUMNS, "rho", *tables.VALUE_COLUMNS]


def table(
    asperities: xr.Dataset, band: xr.Dataset, published_constants: pd.DataFrame
) -> pd.DataFrame:
    """Return the curves against the range of adhesion `rho` (nm) and the lengths beside them.

    Of each surface the median over contacts with its quartiles `low` and `high`; `extent` is a
    diameter. Panel d adds, in nm, of a smooth sphere on a plane the radius of interaction and the
    diameter that holds the same share of the force, and the long critical wavelength, computed with
    its interval and published.
    """
    curves = tables.drawn_rows(
        *(
            (quantity.panel, name, quantity.unit, _quartiles(asperities, name))
            for name, quantity in QUANTITIES.items()
        ),
        *(("d", name, "nm", lengths) for name, lengths in _smooth(asperities).items()),
    )
    rows = pd.concat([curves, _critical_rows(band, published_constants)], ignore_index=True)
    return tables.label_surfaces(rows, asperities)[COLUMNS]


@style.print_style()
def draw(asperities: xr.Dataset, band: xr.Dataset, published_constants: pd.DataFrame) -> Figure:
    """Draw (a) the force on the largest patch, (b) on two, (c) how many there are, (d) how wide."""
    figure = style.create(5.2)
    grid = figure.subplots(2, 2, sharex=True)
    for axes, (name, quantity) in zip(grid.ravel(), QUANTITIES.items(), strict=True):
        _draw_curves(axes, asperities, name)
        axes.set_ylabel(quantity.axis)
        title = quantity.title.format(share=100 * asperities.attrs["share"])
        style.label_panel(axes, quantity.panel, title)
    for axes in grid[0]:
        axes.axhline(0.5, color="0.4", lw=0.8, ls=":", label="half of the force (a, b)")
        axes.set_ylim(0, 1)
    _draw_smooth(grid[1, 1], asperities)
    _draw_critical(grid[1, 1], band, published_constants)
    for axes in grid[1]:
        axes.set(xscale="log", yscale="log", xlabel="range of adhesion ρ (nm)")
        style.label_logarithmic(axes.xaxis, axes.yaxis)
    figure.legend(*_legend_entries(grid), loc="outside upper center", ncols=4)
    style.mark_basis(figure, asperities)
    return figure


def _quartiles(asperities: xr.Dataset, name: str) -> xr.Dataset:
    """Return median and quartiles (surface, rho) over the contacts of all scans."""
    quartiles = asperities[name].quantile(list(QUARTILES.values()), ["scan", "contact"])
    return quartiles.assign_coords(quantile=list(QUARTILES)).to_dataset("quantile")


def _smooth(asperities: xr.Dataset) -> dict[str, xr.DataArray]:
    """Return lengths (nm) against rho of a smooth sphere on a plane.

    The attraction there falls with the distance r from the apex as exp(-r²/(2Rρ)).
    """
    radius = np.sqrt(2 * asperities.attrs["sphere_radius"] * asperities["rho"])
    outside = 1 - asperities.attrs["share"]
    return {"smooth_extent": 2 * radius * np.sqrt(-np.log(outside)), "interaction_radius": radius}


def _critical(band: xr.Dataset) -> dict[str, float]:
    """Return the long critical wavelength (nm) of all substrates and its interval."""
    return tables.value_and_bounds(band.sel(side="large", group=POOLED), "critical_wavelength")


def _critical_rows(band: xr.Dataset, published_constants: pd.DataFrame) -> pd.DataFrame:
    both = [
        {"origin": "computed", **_critical(band)},
        {"origin": "published", "value": tables.published_edge(published_constants, "large")},
    ]
    return pd.DataFrame(both).assign(panel="d", quantity="critical_wavelength", unit="nm")


def _draw_curves(axes: Axes, asperities: xr.Dataset, name: str) -> None:
    """Draw median and quartiles of each surface against rho (nm)."""
    curves = _quartiles(asperities, name) / QUANTITIES[name].printed_unit
    for surface, look in style.looks(asperities["surface"].values).items():
        label = str(asperities["label"].sel(surface=surface).item())
        style.draw_over_range(axes, curves.sel(surface=surface), band=0.15, label=label, **look)


def _draw_smooth(axes: Axes, asperities: xr.Dataset) -> None:
    """Draw the lengths (µm) of a smooth sphere on a plane."""
    for name, lengths in _smooth(asperities).items():
        label, dashes = SMOOTH[name]
        axes.plot(
            lengths["rho"], lengths / MICROMETRE, color="black", lw=0.9, ls=dashes, label=label
        )


def _draw_critical(axes: Axes, band: xr.Dataset, published_constants: pd.DataFrame) -> None:
    """Draw the long critical wavelength (µm), computed with its interval, and published."""
    value, low, high = (length / MICROMETRE for length in _critical(band).values())
    published = tables.published_edge(published_constants, "large") / MICROMETRE
    confidence = print_share(band.attrs["confidence"])
    axes.axhline(value, color="0.4", lw=1.0, label="critical wavelength $λ_L$ (d)")
    if np.isfinite([low, high]).all():
        axes.axhspan(low, high, color="0.85", zorder=0, label=f"its {confidence} interval (d)")
    axes.axhline(published, color="0.4", lw=1.0, ls="--", label="published $λ_L$ (d)")


def _legend_entries(grid: np.ndarray) -> tuple[list[Artist], list[str]]:
    """Return handles and labels: the surfaces, what bands are, and the lines of panels a and d."""
    entries = style.legend_entries((grid[0, 0], grid[1, 1]))
    entries["bands: middle half of contacts"] = Patch(color="0.3", alpha=0.25, lw=0)
    return list(entries.values()), list(entries)
