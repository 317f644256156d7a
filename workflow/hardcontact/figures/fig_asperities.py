"""Asperities: how few patches carry the pull-off force, and how far apart they lie."""

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from hardcontact.figures import drawing, style, tables
from hardcontact.numbers.printing import print_share
from hardcontact.scales.critical_band import POOLED

TITLE = "The asperities that carry the force"
CHAPTER = "5. Asperities"
CAPTION = """\
The pixels that carry most of the pull-off force form patches. Against the range of adhesion ρ,
with plastic contact: (a) share of the whole force on the largest patch, (b) on the two largest,
(c) number of patches, (d) diameter of the circle that holds as much of the force. Symbols:
median over contacts; bands: between quartiles.

"Most" is 90 % by default; pixels that touch at an edge or a corner belong to one patch;
contacts are a sample on all scans; the circle of (d) is about the centre of force. Dotted: half
of the force; the paper says that on MCD and NCD most of it comes from just one or two
asperities. Black lines in (d): the same diameter for a smooth sphere on a smooth plane (solid),
and the radius √(2Rρ) (dash-dotted) of the disk that the paper compares with the long critical
wavelength; it is a radius, and the circle of the rough surfaces a diameter. Grey line and band:
the computed critical wavelength of all substrates, which belongs to the range that Fig. 6 is
computed at, with its {{ inference.confidence | percent }} interval; dashed: published, 1.8 µm.
Drawn from asperities.nc, band.nc and resources/paper/parameters.csv.
"""

MICROMETRE = 1000  # nm
QUARTILES = {"low": 0.25, "value": 0.5, "high": 0.75}


QUANTITIES = {  # panel, title, axis, unit, printed unit
    "largest_share": ("a", "largest patch", "share of the force", "1", 1),
    "two_largest_share": ("b", "two largest patches", "share of the force", "1", 1),
    "patches": ("c", "patches with {share:g} % of the force", "number of patches", "1", 1),
    "extent": (
        "d",
        "diameter that holds {share:g} % of the force",
        "length (µm)",
        "nm",
        MICROMETRE,
    ),
}
SMOOTH: dict[str, style.Look] = {
    "smooth_extent": {"label": "smooth sphere on a plane (d)", "ls": "-"},
    "interaction_radius": {"label": "interaction radius √(2Rρ) (d)", "ls": "-."},
}


def _table(
    asperities: xr.Dataset, band: xr.Dataset, published_constants: pd.DataFrame
) -> pd.DataFrame:
    """Return the curves against the range of adhesion `rho` (nm) and the lengths beside them.

    Of each surface the median over contacts with its quartiles `low` and `high`; `extent` is a
    diameter. Panel d adds, in nm, of a smooth sphere on a plane the radius of interaction and the
    diameter that holds the same share of the force, and the long critical wavelength, computed with
    its interval and published.
    """
    curves = [
        tables.computed_rows(_quartiles(asperities, name), panel=panel, quantity=name, unit=unit)
        for name, (panel, _, _, unit, _) in QUANTITIES.items()
    ]
    smooth = [
        tables.computed_rows(lengths, panel="d", quantity=name, unit="nm")
        for name, lengths in _smooth(asperities).items()
    ]
    published = tables.published_edge(published_constants, "large")
    critical = pd.DataFrame([_critical(band), {"value": published}])
    critical = critical.assign(panel="d", quantity="critical_wavelength", unit="nm")
    critical["origin"] = ["computed", "published"]
    return tables.tidy([*curves, *smooth, critical], asperities, "rho")


def draw(
    asperities: xr.Dataset, band: xr.Dataset, published_constants: pd.DataFrame
) -> tuple[pd.DataFrame, Figure]:
    """Draw (a) the force on the largest patch, (b) on two, (c) how many there are, (d) how wide."""
    figure = drawing.create(5.2, asperities)
    grid = figure.subplots(2, 2, sharex=True)
    for axes, (name, (panel, title, label, _, unit)) in zip(
        grid.ravel(), QUANTITIES.items(), strict=True
    ):
        _draw_curves(axes, asperities, name, unit)
        axes.set_ylabel(label)
        style.label_panel(axes, panel, title.format(share=100 * asperities.attrs["share"]))
    for axes in grid[0]:
        axes.axhline(0.5, color="0.4", lw=0.8, ls=":", label="half of the force (a, b)")
        axes.set_ylim(0, 1)
    for name, lengths in _smooth(asperities).items():
        grid[1, 1].plot(lengths["rho"], lengths / MICROMETRE, color="black", lw=0.9, **SMOOTH[name])
    _draw_critical(grid[1, 1], band, published_constants)
    for axes in grid[1]:
        axes.set(xscale="log", yscale="log", xlabel="range of adhesion ρ (nm)")
        style.label_logarithmic(axes.xaxis, axes.yaxis)
    entries = style.legend_entries((grid[0, 0], grid[1, 1]))
    entries["bands: middle half of contacts"] = Patch(color="0.3", alpha=0.25, lw=0)
    figure.legend(entries.values(), entries.keys(), loc="outside upper center", ncols=4)
    return _table(asperities, band, published_constants), figure


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


def _draw_curves(axes: Axes, asperities: xr.Dataset, name: str, unit: float) -> None:
    """Draw median and quartiles of each surface against rho (nm), in a printed unit."""
    curves = _quartiles(asperities, name) / unit
    for look, curve in style.by_surface(curves.assign(label=asperities["label"])):
        style.draw_with_band(axes, curve, "rho", label=str(curve["label"].item()), **look)


def _draw_critical(axes: Axes, band: xr.Dataset, published_constants: pd.DataFrame) -> None:
    """Draw the long critical wavelength (µm), computed with its interval, and published."""
    value, low, high = (length / MICROMETRE for length in _critical(band).values())
    published = tables.published_edge(published_constants, "large") / MICROMETRE
    confidence = print_share(band.attrs["confidence"])
    axes.axhline(value, color="0.4", lw=1.0, label="critical wavelength $λ_L$ (d)")
    if np.isfinite([low, high]).all():
        axes.axhspan(low, high, color="0.85", zorder=0, label=f"its {confidence} interval (d)")
    axes.axhline(published, color="0.4", lw=1.0, ls="--", label="published $λ_L$ (d)")
