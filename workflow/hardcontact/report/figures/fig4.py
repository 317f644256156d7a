"""Fig. 4: computed pull-off forces against the range of adhesion."""

import math

import pandas as pd
import xarray as xr
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from hardcontact.base.formatting import format_share
from hardcontact.contact.contact import PLASTIC
from hardcontact.report.figures import drawing, panels, style

MEGAPASCAL = 1e6
MAX_MAP_PIXELS = 640  # per row of the pressure map
PRESSURE_DECADES = 3  # drawn below the peak; lower pressures hardly add to the force
PUBLISHED_MEAN: style.Look = {"lw": 1.0, "ls": ":"}
AT_FIT: style.Look = {"mfc": "white", "ms": 5, "mew": 1.2}  # of a symbol at the fitted pair
#: Steps of `iterate_dodged` between symbols AT_FIT, which are larger than those of the curves.
DODGES_AT_FIT = 4
MARK_POSITION = 0.97  # of the symbol on a published mean, on the x axis from 0 to 1
RATIO_FIT: style.Look = {"color": "black", "lw": 1.2, "marker": "P", "ms": 5}


def draw(
    contact: xr.Dataset,
    fit: xr.Dataset,
    sets: xr.Dataset,
    published_constants: pd.DataFrame,
    published_pull_off: pd.DataFrame,
) -> Figure:
    """Draw Fig. 4: (a) one contact, (b) force ratios, (c) forces."""
    plastic_fit = fit.sel(contact_model=PLASTIC)
    set_fits = sets.sel(contact_model=PLASTIC)
    figure, ((pressure, separation, legend_panel), (ratios, forces)) = drawing.create_rows(
        5.6, fit, row_heights=(1, 1.5), panel_widths=((1.3, 1, 1), (1, 1))
    )
    _draw_pressure(pressure, contact)
    separation.axhline(0, color="0.7", lw=0.6)
    contact_forces = contact["force"] / style.MICRONEWTON
    separation.plot(contact["separation"], contact_forces, color=style.PUBLISHED_COLOUR)
    separation.set(xlabel="separation (nm)", ylabel="force (µN)")
    separation.locator_params(nbins=5)
    style.label_panel(separation, "a_2", panels.format_pair(published_constants["value"]))
    published_forces = published_pull_off["mean_force"]
    work = published_constants["value"]["work_of_adhesion"]
    _draw_ratios(ratios, plastic_fit, set_fits, published_forces)
    _draw_forces(forces, plastic_fit, set_fits, work, published_forces)
    for axes in (ratios, forces):
        panels.finish_range_axis(axes, plastic_fit["rho"].values, published_constants)
        style.label_logarithmic(axes.yaxis, digits=(1, 3))
    legend_panel.set_axis_off()
    legend_panel.legend(handles=_legend_handles(plastic_fit, published_constants), loc="center")
    return figure


def _legend_handles(fit: xr.Dataset, published_constants: pd.DataFrame) -> list[Artist]:
    """Return one entry per surface and one for each kind of line and symbol of panels b and c."""
    confidence = format_share(fit.attrs["confidence"])
    published = published_constants["value"]["range_of_adhesion"]
    fit_label = "at the best fit, " + panels.format_pair(fit).replace(", ", ",\n")
    sets = format_share(panels.SHARE_OF_SETS)
    grey: style.Look = {"color": "0.3"}
    return [
        *style.surface_handles(fit),
        Line2D([], [], marker="|", ms=9, ls="none", label=f"{confidence} interval", **grey),
        Patch(color="0.3", label=f"{sets} of all sets of substitutes", **style.SPREAD_LOOK),
        Line2D([], [], label="published mean force", **grey, **PUBLISHED_MEAN),
        Line2D([], [], label=f"published range, ρ = {published:g} nm", **style.PUBLISHED_LOOK),
        Line2D([], [], label="ρ that fits the ratios best", **RATIO_FIT),
        Line2D([], [], marker="o", ls="none", label=fit_label, **grey, **AT_FIT),
    ]


def _draw_pressure(axes: Axes, contact: xr.Dataset) -> None:
    """Map the adhesive pressure (MPa) from its maximum down to PRESSURE_DECADES below."""
    pressure = abs(contact["adhesive_pressure"]) / MEGAPASCAL
    # A finer map looks the same, but takes gigabytes to draw.
    coarsening = math.ceil(pressure.sizes["x"] / MAX_MAP_PIXELS)
    pressure = pressure.coarsen(x=coarsening, y=coarsening, boundary="trim").max()
    top = pressure.max().item()
    bottom = top / 10**PRESSURE_DECADES
    x, y = pressure["x"].values / 1000, pressure["y"].values / 1000
    clipped = pressure.clip(min=bottom).values
    image = axes.pcolormesh(
        x, y, clipped, norm=LogNorm(bottom, top), cmap="magma", **style.PIXEL_LOOK
    )
    reach = 1.05 * panels.mask_half_width(pressure > bottom) / 1000
    axes.set(xlim=(-reach, reach), ylim=(-reach, reach), xlabel="x (µm)", ylabel="y (µm)")
    axes.set_aspect("equal")
    axes.locator_params(nbins=4)
    bar = axes.figure.colorbar(
        image, ax=axes, pad=0.02, shrink=0.8, label="adhesive pressure (MPa)"
    )
    style.label_logarithmic(bar.ax.yaxis, digits=(1,))
    style.label_panel(axes, "a_1", str(contact.attrs["label"]))


def _draw_ratios(
    axes: Axes, fit: xr.Dataset, set_fits: xr.Dataset, published_forces: pd.Series
) -> None:
    """Draw mean forces relative to the reference surface against rho (nm)."""
    # The ratio of the reference surface is 1 at all ranges.
    reference = abs(fit["force_over_reference"] - 1).max("rho").idxmin("surface").item()
    curves = panels.value_and_interval(fit, "force_over_reference")
    set_spread = panels.summarize_sets(set_fits["force_over_reference"])
    _draw_curves(axes, curves, set_spread, published_forces / published_forces[reference])
    best = panels.scalar_and_interval(fit, "range_from_ratios")
    ranges = [best[name] for name in ("low", "value", "high")]
    axes.plot(ranges, [0.05] * 3, transform=axes.get_xaxis_transform(), markevery=[1], **RATIO_FIT)
    axes.set_ylabel(f"force relative to {fit['label'].sel(surface=reference).item()}")
    style.label_panel(axes, "b", "ratios of forces, for any $W$")


def _draw_forces(
    axes: Axes, fit: xr.Dataset, set_fits: xr.Dataset, work: float, published_forces: pd.Series
) -> None:
    """Draw the mean force (µN) at the published work of adhesion (J/m²) against rho (nm)."""
    factor = work / style.MICRONEWTON  # because `mean_force` is for 1 J/m²
    curves = panels.value_and_interval(fit, "mean_force") * factor
    set_spread = panels.summarize_sets(set_fits["mean_force"]) * factor
    _draw_curves(axes, curves, set_spread, published_forces / style.MICRONEWTON)
    fitted = panels.value_and_interval(fit.sel(pair="fitted"), "mean_force_at_pair")
    for dodge, look, force in style.iterate_dodged(fitted / style.MICRONEWTON):
        rho = fit["range_of_adhesion"] * dodge**DODGES_AT_FIT
        panels.draw_bars(axes, rho, force, width=1.2, zorder=4, **look | AT_FIT)
    axes.set_ylabel("mean pull-off force (µN)")
    title = rf"curves: at the published $W$ = {work / style.MILLIJOULE:.3g} mJ/m²"
    style.label_panel(axes, "c", title)


def _draw_curves(axes: Axes, curves: xr.Dataset, set_spread: xr.Dataset, levels: pd.Series) -> None:
    """Draw curves with intervals, bands of the sets and published levels against rho (nm)."""
    transform = axes.get_yaxis_transform()
    for dodge, look, curve in style.iterate_dodged(curves):
        surface = curve["surface"].item()
        panels.draw_band(axes, curves["rho"], set_spread.sel(surface=surface), look["color"])
        panels.draw_bars(axes, dodge * curves["rho"], curve, width=0.7, ms=2.5, **look)
        axes.axhline(levels[surface], color=look["color"], **PUBLISHED_MEAN)
        axes.plot(MARK_POSITION, levels[surface], transform=transform, mfc="white", **look)
    axes.set(xscale="log", yscale="log")
    style.end_near_values(axes)
