"""Fig. 4: range and work of adhesion from the computed pull-off forces."""

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from hardcontact.base.printing import print_formatted, print_share
from hardcontact.paper.inference import PLASTIC
from hardcontact.report.figures import drawing, style, tables

TITLE = "Fig. 4: range and work of adhesion"
CHAPTER = "3. Adhesion"
CAPTION = """\
(a) Adhesive pressure of one contact, the largest in each pixel, and its force against
separation. (b) Mean force relative to that on the reference substrate, and (c) mean force at
the published work of adhesion W, against the range ρ. (d) Mean relative error of the forces at
the best W for each ρ. (e) The same error over ρ and W.

Contact is plastic, in (d) also rigid; (a) is at the published ρ and W. (b, c) Bars:
{{ inference.confidence | percent }} intervals over scans, at most to a decade beyond all values;
bands: 90 % of many equally good sets of substitute scans; horizontal lines: published means. Cross
in (b): the ρ that fits all published ratios best. Open symbols in (c): best fit of ρ and W. (d)
Star and rings: least and other minima with plastic contact; vertical line, and brackets in the
title: {{ inference.confidence | percent }} interval of the least over scans; grey dots: best fit
of each set of substitutes, whose spread is the interval that the verdicts take. (e) White dots:
fits to samples of what the mean forces may be, given the scatter of the scans; black: published
result with its uncertainty; white line: where the error is below the paper's threshold, if it is
anywhere. Dashed in (b) to (e): the published range. Drawn from contact.nc, inference.nc and
sets.nc, published values from parameters.csv and pull_off.csv of resources/paper.
"""

MODELS: dict[str, style.Look] = {
    "plastic": {"color": "black", "ls": "-"},
    "rigid": {"color": "0.45", "ls": "--"},
}
MEGAPASCAL = 1e6
MAP_PIXELS = 640  # along an edge of the map of the pressure
PRESSURE_DECADES = 3  # below, the pressure adds nothing visible to the force
FAIR = 0.7  # the map shows the works of adhesion whose error gets below this somewhere
FITTED_UNITS = {"range_of_adhesion": "nm", "work_of_adhesion": "J/m2"}
AT_FIT: style.Look = {"mfc": "white", "ms": 5, "mew": 1.2}
RATIO_FIT: style.Look = {"color": "black", "lw": 1.2, "marker": "P", "ms": 5}
ON_MAP: style.Look = {"frameon": True, "facecolor": "0.6", "framealpha": 0.9}


def draw(
    contact: xr.Dataset,
    inference: xr.Dataset,
    sets: xr.Dataset,
    published_constants: pd.DataFrame,
    published_pull_off: pd.DataFrame,
) -> tuple[pd.DataFrame, Figure]:
    """Draw Fig. 4: (a) one contact, (b) force ratios, (c) forces, (d, e) errors of the fit.

    The column `x` has the separation (nm, panel a) or the range of adhesion (nm, b to e). Values
    over "scans" are means with their interval; values over "sets" are the median and SHARE_OF_SETS.
    """
    fit, set_fits = (data.sel(contact_model=PLASTIC) for data in (inference, sets))
    figure, ((pressure, separation, key), (ratios, forces), (error_curves, error)) = (
        drawing.create_rows(7.6, inference, (1, (1.3, 1, 1)), (1.3, (1, 1)), (1.3, (1, 1)))
    )
    _draw_pressure(pressure, contact)
    distances, contact_forces = contact["separation"].values, contact["force"].values
    separation.axhline(0, color="0.7", lw=0.6)
    separation.plot(distances, contact_forces / style.MICRONEWTON, color=style.PUBLISHED)
    separation.set(xlabel="separation (nm)", ylabel="force (µN)")
    separation.locator_params(nbins=5)
    curve = tables.rows_of("a", "force", "N", x=distances, value=contact_forces)
    frames = [
        curve.assign(surface=contact.attrs["surface"]),
        _draw_ratios(ratios, fit, set_fits, published_pull_off["mean_force"]),
        _draw_forces(forces, fit, set_fits, published_constants, published_pull_off["mean_force"]),
        _draw_least_error(error_curves, inference, set_fits),
        _draw_error_map(error, fit, published_constants),
    ]
    separation.set_title(style.print_pair(published_constants["value"]), loc="left")
    for axes in (ratios, forces, error_curves, error):
        style.draw_published_range(axes, published_constants)
        axes.set_xlim(fit["rho"].values[[0, -1]])
        axes.set_xlabel("range of adhesion ρ (nm)")
        style.label_logarithmic(axes.xaxis, at=(1, 3))
    key.set_axis_off()
    key.legend(handles=_legend_handles(fit, published_constants), loc="center")
    return tables.tidy(frames, inference, "over", "x"), figure


def _legend_handles(fit: xr.Dataset, published_constants: pd.DataFrame) -> list[Artist]:
    """Return one entry a surface and one for each kind of line and symbol of panels b and c."""
    confidence = print_share(fit.attrs["confidence"])
    published = published_constants["value"]["range_of_adhesion"]
    fit_label = "at the best fit, " + style.print_pair(fit).replace(", ", ",\n")
    grey: style.Look = {"color": "0.3"}
    return [
        *style.surface_handles(fit),
        Line2D([], [], lw=0.7, label=f"{confidence} interval over scans (bars)", **grey),
        style.sets_handle(),
        Line2D([], [], lw=0.9, label="published mean", **grey),
        Line2D([], [], label=f"published range, ρ = {published:g} nm", **style.PUBLISHED_RANGE),
        Line2D([], [], label="ρ that fits the ratios best", **RATIO_FIT),
        Line2D([], [], marker="o", ls="none", label=fit_label, **grey, **AT_FIT),
    ]


def _draw_pressure(axes: Axes, contact: xr.Dataset) -> None:
    """Map the adhesive pressure (MPa) around the apex, over its largest PRESSURE_DECADES.

    The map has at most MAP_PIXELS along an edge, each the largest pressure of those that it covers:
    a finer map looks the same and takes gigabytes to draw.
    """
    pressure = abs(contact["adhesive_pressure"]) / MEGAPASCAL
    covered = -(-pressure.sizes["x"] // MAP_PIXELS)
    pressure = pressure.coarsen(x=covered, y=covered, boundary="trim").max()
    top = pressure.max().item()
    bottom = top / 10**PRESSURE_DECADES
    x, y = pressure["x"].values / 1000, pressure["y"].values / 1000
    shown, norm = pressure.clip(min=bottom).values, LogNorm(bottom, top)
    image = axes.pcolormesh(x, y, shown, norm=norm, cmap="magma", **style.PIXELS)
    reach = 1.05 * style.half_width(pressure > bottom) / 1000
    axes.set(xlim=(-reach, reach), ylim=(-reach, reach), xlabel="x (µm)", ylabel="y (µm)")
    axes.set_aspect("equal")
    axes.locator_params(nbins=4)
    axes.figure.colorbar(image, ax=axes, pad=0.02, shrink=0.8, label="adhesive pressure (MPa)")
    style.label_panel(axes, "a", str(contact.attrs["label"]))


def _draw_ratios(
    axes: Axes, fit: xr.Dataset, set_fits: xr.Dataset, published: pd.Series
) -> pd.DataFrame:
    """Draw the ratio of mean forces to the reference surface against rho (nm).

    The reference is the surface whose own ratio is 1 everywhere.
    """
    reference = abs(fit["ratio"] - 1).max("rho").idxmin("surface").item()
    scans, set_spread = tables.bounded(fit, "ratio"), tables.over_sets(set_fits["ratio"])
    rows = _draw_curves(axes, scans, set_spread, published / published[reference])
    best = tables.value_and_bounds(fit, "range_from_ratios")
    along = [best[name] for name in ("low", "value", "high")]
    axes.plot(along, [0.05] * 3, transform=axes.get_xaxis_transform(), markevery=[1], **RATIO_FIT)
    axes.set_ylabel(f"force / that of {fit['label'].sel(surface=reference).item()}")
    style.label_panel(axes, "b", "ratios of forces, for any $W$")
    rows = rows.assign(panel="b", quantity="ratio", unit="1")
    best_rows = tables.rows_of("b", "range_from_ratios", "nm", over="scans", **best)
    return pd.concat([rows, best_rows])


def _draw_forces(
    axes: Axes,
    fit: xr.Dataset,
    set_fits: xr.Dataset,
    published_constants: pd.DataFrame,
    published: pd.Series,
) -> pd.DataFrame:
    """Draw the mean force (µN) at the published work of adhesion against rho (nm)."""
    work = published_constants["value"]["work_of_adhesion"]
    scans = tables.bounded(fit, "mean_force") * work
    set_spread = tables.over_sets(set_fits["mean_force"]) * work
    rows = _draw_curves(axes, scans, set_spread, published, style.MICRONEWTON)
    fitted = tables.bounded(fit.sel(pair="fitted"), "force_mean")
    for look, force in style.by_surface(fitted / style.MICRONEWTON):
        look = look | AT_FIT
        style.draw_bars(axes, fit["range_of_adhesion"], force, elinewidth=1.2, zorder=4, **look)
    axes.set_ylabel("mean pull-off force (µN)")
    title = rf"curves: at the published $W$ = {work / style.MILLIJOULE:.3g} mJ/m²"
    style.label_panel(axes, "c", title)
    fit_rows = tables.computed_rows(fitted.assign(x=fit["range_of_adhesion"]), over="scans")
    rows = pd.concat(
        [rows.assign(quantity="mean_force"), fit_rows.assign(quantity="mean_force_at_fit")]
    )
    return rows.assign(panel="c", unit="N")


def _draw_curves(
    axes: Axes, scans: xr.Dataset, set_spread: xr.Dataset, published: pd.Series, unit: float = 1
) -> pd.DataFrame:
    """Draw values with intervals, bands of the sets and published levels, in a printed unit."""
    for look, curve in style.by_surface(scans / unit):
        surface = curve["surface"].item()
        style.fill_interval(axes, set_spread.sel(surface=surface) / unit, "rho", look["color"])
        style.draw_bars(axes, curve["rho"], curve, elinewidth=0.7, ms=2.5, **look)
        axes.axhline(published[surface] / unit, color=look["color"], lw=0.9)
    axes.set(xscale="log", yscale="log")
    style.end_near_values([axes])
    published_levels = (
        published.reindex(scans["surface"].values).rename("value").rename_axis("surface")
    )
    frames = [
        tables.computed_rows(scans, over="scans"),
        tables.computed_rows(set_spread, over="sets"),
        published_levels.reset_index().assign(origin="published"),
    ]
    return pd.concat(frames).rename(columns={"rho": "x"})


def _draw_least_error(axes: Axes, inference: xr.Dataset, set_fits: xr.Dataset) -> pd.DataFrame:
    """Draw the error, least over W, against rho (nm), and the best fit of each set."""
    fit = inference.sel(contact_model=PLASTIC)
    threshold = inference.attrs["error_threshold"]
    set_look: style.Look = {"color": "0.6", "ms": 4, "mew": 0, "alpha": 0.8}
    set_ranges, set_errors = set_fits["range_of_adhesion"].values, set_fits["best_error"].values
    axes.plot(set_ranges, set_errors, ".", label="best fit of a set", **set_look)
    frames = [tables.rows_of("d", "best_error_of_set", "1", x=set_ranges, value=set_errors)]
    for model in [name for name in MODELS if name in inference["contact_model"]]:
        curve = inference["error_of_range"].sel(contact_model=model)
        ranges = curve["rho_fine"].values
        axes.plot(ranges, curve, lw=1.2, label=f"{model} contact", **MODELS[model])
        name = f"least_error_{model}"
        frames.append(tables.rows_of("d", name, "1", x=ranges, value=curve.values))
    best = tables.value_and_bounds(fit, "best_error")
    axes.plot([fit["range_of_adhesion"]] * 2, [best["low"], best["high"]], color="black", lw=1.0)
    style.draw_fit(axes, fit, "error")
    axes.axhline(threshold, color="0.6", lw=0.8, zorder=0)
    text, place = f"paper: below {threshold:g}", axes.get_yaxis_transform()
    axes.text(0.02, threshold, text, transform=place, va="bottom", **style.NOTE)
    axes.set(xscale="log", yscale="log", ylabel="mean relative error, least over $W$")
    errors = [*set_errors, best["low"], best["value"], threshold]
    axes.set_ylim(bottom=np.nanmin(errors) / 5)  # leaves room for the legend
    style.label_logarithmic(axes.yaxis, at=(1, 2, 5))
    axes.legend(loc="lower left", ncols=2, frameon=True, framealpha=1, edgecolor="white")
    over = " over scans" if np.isfinite(best["low"]) else ""
    style.label_panel(axes, "d", f"smallest error {print_formatted(best, '.2g')}{over}")
    frames.append(tables.rows_of("d", "best_error", "1", **best))
    return pd.concat([*frames, _minimum_rows(fit, "d", "error", "1")])


def _draw_error_map(axes: Axes, fit: xr.Dataset, published_constants: pd.DataFrame) -> pd.DataFrame:
    """Map the mean relative error over rho (nm) and W (mJ/m2), with fit and published values."""
    error = fit["mean_relative_error"].transpose("work", "rho_fine")
    rho, work = fit["rho_fine"].values, fit["work"].values / style.MILLIJOULE
    norm = LogNorm(vmax=max(1.0, 3 * error.min().item()))
    image = axes.pcolormesh(rho, work, error.values, norm=norm, cmap="cividis", **style.PIXELS)
    threshold = fit.attrs["error_threshold"]
    if (error < threshold).any():
        axes.contour(rho, work, error.values, levels=[threshold], colors="white", linewidths=1.0)
        axes.plot([], [], color="white", lw=1.0, label=f"error < {threshold:g}")
    ranges, works = fit["sampled_range"].values, fit["sampled_work"].values
    axes.plot([], [], "o", color="white", ms=2.5, label="samples of the scans")
    look: style.Look = {"color": "white", "ms": 2, "alpha": 0.6, "mew": 0, "rasterized": True}
    axes.plot(ranges, works / style.MILLIJOULE, ".", **look)
    style.draw_published_fit(axes, published_constants)
    axes.legend(loc="lower left", **ON_MAP)  # panel d names the marks of the fit
    style.draw_fit(axes, fit, "work", style.MILLIJOULE)
    axes.set(xscale="log", yscale="log", ylabel="work of adhesion $W$ (mJ/m²)")
    fair = work[error.min("rho_fine").values < FAIR]
    shown = [*fair, published_constants["value"]["work_of_adhesion"] / style.MILLIJOULE]
    axes.set_ylim(max(work[0], min(shown) / 1.5), min(work[-1], max(shown) * 1.5))
    style.label_logarithmic(axes.yaxis, at=(1,))
    bar = axes.figure.colorbar(image, ax=axes, label="mean relative error", pad=0.02, extend="max")
    style.label_logarithmic(bar.ax.yaxis)
    style.label_panel(axes, "e")
    frames = [
        tables.rows_of("e", name, unit, **tables.value_and_bounds(fit, name))
        for name, unit in FITTED_UNITS.items()
    ]
    frames += [
        tables.rows_of("e", "sampled_work", "J/m2", x=ranges, value=works),
        _minimum_rows(fit, "e", "work", "J/m2"),
        tables.published_rows(published_constants, FITTED_UNITS, "e"),
    ]
    return pd.concat(frames)


def _minimum_rows(fit: xr.Dataset, panel: str, height: str, unit: str) -> pd.DataFrame:
    """Return work or error at each local minimum of the error along the range."""
    minima = fit.dropna("minimum", subset=["minimum_range"])
    name = f"minimum_{height}"
    return tables.rows_of(panel, name, unit, x=minima["minimum_range"], value=minima[name])
