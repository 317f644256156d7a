"""Elastic contact: pressure relative to the hardness, force relative to rigid contact."""

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure

from hardcontact.report.figures import drawing, style, tables

TITLE = "Elastic contact"
CHAPTER = "2. Contact"
CAPTION = """\
(a) Pressure of one elastic contact on each substrate, around its peak; white: the hardness. (b)
Share of the contact area whose pressure exceeds the hardness. (c) Peak pressure beside the
hardness (solid) and the peak on a smooth sphere (dashed). (d) Change of the pull-off force from
rigid to elastic bodies.

In (b-d) each dot is one contact. The contacts of one scan form one column. The bar is the median
over all contacts of a substrate. Published values: in (b) "in most of the contact area" (grey), in
(c) 135 MPa for the smooth sphere (Hertz), in (d) "virtually indistinguishable". All pressures are
computed on the pixels of the scans; shorter waves have higher slopes and pressures. Grey in (a):
no contact. Pressures beyond the scale have the colours of its ends. Forces of (d) are at the
published range and work of adhesion. Drawn from elastic.nc.
"""

GIGAPASCAL = 1e9
PRESSURE_COLOURS = "RdBu_r"  # white at the hardness
PRESSURE_TICKS = np.array([0.1, 0.3, 1, 3, 10])  # of the pressure, over the hardness
NO_CONTACT_COLOUR = "0.75"
MOST_SHARE = 0.5  # share of the contact area that the paper calls "most"
PRESSURE_LEVELS = {  # attribute: origin, label, line
    "hardness": ("given", "hardness", "-"),
    "hertz_peak_pressure": ("computed", "smooth sphere (Hertz)", "--"),
}
SCAN_SPREAD = 0.6  # width of the scans of one surface, relative to the distance of surfaces


def draw(elastic: xr.Dataset) -> tuple[pd.DataFrame, Figure]:
    """Draw (a) the pressure of one contact a surface, (b-d) all contacts, one dot each.

    The table has a row for each contact, for the median of each surface, and for each level of
    comparison; the published level is a range from `low` to `high`.
    """
    surfaces = elastic.sizes["surface"]
    figure, (maps, (shares, peaks, forces)) = drawing.create_rows(
        4.6, elastic, (1, (1,) * surfaces), (1.3, (1, 1, 1))
    )
    ratio = elastic["elastic_pull_off_force"] / elastic["rigid_pull_off_force"]
    _draw_pressures(maps, elastic)

    _draw_contacts(shares, elastic["share_above_hardness"])
    shares.axhspan(MOST_SHARE, 1, color="0.88", zorder=0)
    middle = shares.get_xlim()[1] / 2
    shares.text(middle, 1.02, "published: most of the area", fontsize=7, ha="center", va="bottom")
    shares.set(ylim=(-0.03, 1.12), ylabel="share of contact area")
    style.label_panel(shares, "b", "pressure above hardness")

    _draw_contacts(peaks, elastic["peak_pressure"] / GIGAPASCAL)
    for name, (_, label, dashes) in PRESSURE_LEVELS.items():
        level = elastic.attrs[name] / GIGAPASCAL
        peaks.axhline(level, color="black", lw=0.9, ls=dashes, label=label)
    peaks.set(yscale="log", ylabel="peak pressure (GPa)")
    style.label_logarithmic(peaks.yaxis, digits=(1,))
    peaks.legend()
    style.label_panel(peaks, "c", "highest pressure")

    excess = (ratio - 1) / style.PERCENT
    _draw_contacts(forces, excess)
    forces.axhline(0, color="0.7", lw=0.6, zorder=0)
    forces.set_ylabel("elastic / rigid pull-off − 1 (%)")
    style.label_panel(forces, "d", f"differs by up to {abs(excess).max().item():.2g} %")

    for axes in (shares, peaks, forces):
        axes.set_xticks(range(surfaces), elastic["label"].values, **style.TILTED)
    frames = []
    for panel, name, unit, values in (
        ("b", "share_above_hardness", "1", elastic["share_above_hardness"]),
        ("c", "peak_pressure", "Pa", elastic["peak_pressure"]),
        ("d", "elastic_over_rigid", "1", ratio),
    ):
        medians = values.median(["scan", "contact"])
        frames += [
            tables.computed_rows(values, panel=panel, quantity=name, unit=unit),
            tables.computed_rows(medians, panel=panel, quantity=f"{name}_median", unit=unit),
        ]
    frames.append(
        tables.quantity_rows(
            "b", "share_above_hardness", "1", "published", low=MOST_SHARE, high=1.0
        )
    )
    for name, (origin, _, _) in PRESSURE_LEVELS.items():
        frames.append(tables.quantity_rows("c", name, "Pa", origin, value=elastic.attrs[name]))
    return tables.tidy_table(frames, elastic, "scan", "contact"), figure


def _draw_pressures(row: np.ndarray, elastic: xr.Dataset) -> None:
    """Map the pressure of one contact of each surface, white at the hardness."""
    hardness = elastic.attrs["hardness"] / GIGAPASCAL
    ticks = hardness * PRESSURE_TICKS
    pressure = elastic.set_coords("label")["pressure"].transpose("surface", "y", "x") / GIGAPASCAL
    reach = 1.1 * style.mask_half_width((pressure > 0).any("surface"))
    for position, (axes, surface_data) in enumerate(zip(row, pressure, strict=True), start=1):
        # At pixels of other surfaces there is no value.
        surface_data = surface_data.dropna("y", how="all").dropna("x", how="all")
        contact = surface_data.where(surface_data > 0)
        norm = LogNorm(ticks[0], ticks[-1])
        image = axes.pcolormesh(
            contact["x"],
            contact["y"],
            contact,
            norm=norm,
            cmap=PRESSURE_COLOURS,
            **style.PIXEL_LOOK,
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
    """Draw one dot a contact, the scans of a surface side by side, and a bar at the median."""
    offsets = np.linspace(-SCAN_SPREAD / 2, SCAN_SPREAD / 2, values.sizes["scan"])[:, None]
    for position, (surface, colour) in enumerate(style.colours(values["surface"].values).items()):
        surface_data = values.sel(surface=surface).transpose("scan", "contact")
        positions = np.broadcast_to(position + offsets, surface_data.shape)
        axes.plot(
            positions.ravel(), surface_data.values.ravel(), "o", color=colour, ms=2.5, alpha=0.6
        )
        axes.hlines(surface_data.median(), position - 0.45, position + 0.45, color=colour, lw=1.6)
    axes.set_xlim(-0.6, values.sizes["surface"] - 0.4)
