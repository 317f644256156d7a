"""Elastic contact: pressure relative to the hardness, force relative to rigid contact."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from hardcontact.base.units import GIGAPASCAL
from hardcontact.report.figures import drawing, panels, style

PRESSURE_COLOURS = "RdBu_r"  # white at the hardness
PRESSURE_TICKS = np.array([0.1, 0.3, 1, 3, 10])  # pressures relative to the hardness
NO_CONTACT_COLOUR = "0.75"
MOST_SHARE = 0.5  # of the contact area; the paper calls a larger share "most"
MOST_LOOK: style.Look = {"color": "0.9", "lw": 0, "zorder": 0}
PRESSURE_LEVELS = {  # attribute: label, line
    "hardness": ("hardness", "-"),
    "hertz_peak_pressure": ("smooth sphere (Hertz)", "--"),
}
SCAN_SPREAD = 0.6  # width of the scans of one surface, relative to the distance of surfaces


def draw(elastic: xr.Dataset) -> Figure:
    """Draw (a) the pressure of one contact on each surface, (b-d) all contacts as dots."""
    surfaces = elastic.sizes["surface"]
    figure, (maps, (share_axes, peak_axes, force_axes)) = drawing.create_rows(
        5.1, elastic, row_heights=(1, 1.3), panel_widths=([1] * surfaces, (1, 1, 1))
    )
    _draw_pressures(maps, elastic)
    _draw_shares(share_axes, elastic)
    _draw_peaks(peak_axes, elastic)
    _draw_forces(force_axes, elastic)
    for axes in (share_axes, peak_axes, force_axes):
        axes.set_xticks(range(surfaces), elastic["label"].values, **style.TILTED_LABELS)
    handles = [
        Patch(color=NO_CONTACT_COLOUR, label="no contact (a)"),
        Line2D([], [], color="0.3", marker="o", ms=3, ls="none", label="one contact"),
        Line2D([], [], color="0.3", lw=1.6, label="median"),
        Patch(label="published: most of the area (b)", **MOST_LOOK),
    ]
    style.legend_above(figure, handles)
    return figure


def _draw_shares(axes: Axes, elastic: xr.Dataset) -> None:
    """Draw the share of the contact area with pressure above the hardness, and MOST_SHARE."""
    _draw_contacts(axes, elastic["share_above_hardness"])
    axes.axhspan(MOST_SHARE, 1, **MOST_LOOK)
    axes.set(ylim=(-0.03, 1.03), ylabel="share of contact area")
    style.label_panel(axes, "b", "pressure above hardness")


def _draw_peaks(axes: Axes, elastic: xr.Dataset) -> None:
    """Draw the peak pressure (GPa), the hardness, and the peak on a smooth sphere."""
    _draw_contacts(axes, elastic["peak_pressure"] / GIGAPASCAL)
    for name, (label, dashes) in PRESSURE_LEVELS.items():
        level = elastic.attrs[name] / GIGAPASCAL
        axes.axhline(level, color="black", lw=0.9, ls=dashes, label=label)
    axes.set(yscale="log", ylabel="peak pressure (GPa)")
    style.label_logarithmic(axes.yaxis, digits=(1,))
    axes.legend()
    style.label_panel(axes, "c", "highest pressure")


def _draw_forces(axes: Axes, elastic: xr.Dataset) -> None:
    """Draw the change of the pull-off force (%) from rigid to elastic bodies."""
    ratio = elastic["elastic_pull_off_force"] / elastic["rigid_pull_off_force"]
    change = (ratio - 1) / style.PERCENT
    _draw_contacts(axes, change)
    axes.axhline(0, color="0.6", lw=0.8, zorder=0, label="no change")
    axes.legend()
    axes.set_ylabel("change of the force (%)")
    style.label_panel(axes, "d", f"elasticity: up to {abs(change).max().item():.2g} %")


def _draw_pressures(row: np.ndarray, elastic: xr.Dataset) -> None:
    """Map the pressure of one contact of each surface, white at the hardness."""
    hardness = elastic.attrs["hardness"] / GIGAPASCAL
    ticks = hardness * PRESSURE_TICKS
    pressure = elastic.set_coords("label")["pressure"].transpose("surface", "y", "x") / GIGAPASCAL
    reach = 1.1 * panels.mask_half_width((pressure > 0).any("surface"))
    for position, (axes, surface_data) in enumerate(zip(row, pressure, strict=True), start=1):
        # Pixels that only other surfaces have are NaN.
        surface_data = surface_data.dropna("y", how="all").dropna("x", how="all")
        touching = surface_data.where(surface_data > 0)
        colours = {"norm": LogNorm(ticks[0], ticks[-1]), "cmap": PRESSURE_COLOURS}
        image = axes.pcolormesh(
            touching["x"], touching["y"], touching, **colours, **style.PIXEL_LOOK
        )
        axes.set(facecolor=NO_CONTACT_COLOUR, aspect="equal", xlabel="x (nm)")
        axes.set(xlim=(-reach, reach), ylim=(-reach, reach))
        axes.locator_params(nbins=4)
        axes.label_outer()
        style.label_panel(axes, f"a_{position}", str(surface_data["label"].item()))
    row[0].set_ylabel("y (nm)")
    bar = row[0].figure.colorbar(image, ax=row, pad=0.01, extend="both")
    bar.set_label("pressure (GPa)\nline: hardness")
    bar.set_ticks(ticks, labels=[f"{tick:.3g}" for tick in ticks])
    bar.minorticks_off()
    bar.ax.axhline(hardness, color="black", lw=1.0)


def _draw_contacts(axes: Axes, values: xr.DataArray) -> None:
    """Draw a dot for each contact, the scans of a surface side by side, and a bar at the median."""
    offsets = np.linspace(-SCAN_SPREAD / 2, SCAN_SPREAD / 2, values.sizes["scan"])[:, None]
    values = values.transpose("surface", "scan", "contact")
    for position, (look, surface_data) in enumerate(style.iterate_surfaces(values)):
        positions = np.broadcast_to(position + offsets, surface_data.shape)
        symbols: style.Look = look | {"ls": "none", "ms": 3, "mew": 0, "alpha": 0.6}
        axes.plot(positions.ravel(), surface_data.values.ravel(), **symbols)
        ends = position - 0.45, position + 0.45
        axes.hlines(surface_data.median(), *ends, color=look["color"], lw=1.6)
    axes.set_xlim(-0.6, values.sizes["surface"] - 0.4)
