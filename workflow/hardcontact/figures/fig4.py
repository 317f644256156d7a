"""Fig. 4: range and work of adhesion from the computed pull-off forces."""

import pandas as pd
import xarray as xr
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from hardcontact.figures import drawing, fig4_error, style, tables
from hardcontact.numbers.printing import print_share

TITLE = "Fig. 4: range and work of adhesion"
CHAPTER = "3. Adhesion"
CAPTION = """\
(a) Adhesive pressure of one contact, and its force against separation. (b) Mean force relative
to that on the reference substrate, and (c) mean force at the published work of adhesion W,
against the range ρ. (d) Mean relative error of the forces at the best W for each ρ. (e) The
same error over ρ and W.

Contact is plastic, in (d) also rigid. (a) is at the published ρ and W. In (b) and (c) symbols
are computed, bars their {{ inference.confidence | percent }} interval over scans, and bands
hold 90 % of many equally good sets of substitute scans; bars that go on for more than a decade
beyond all values end at the frame. Horizontal lines: published means, in (c) dotted medians.
Cross at the foot of (b): the ρ that fits all published ratios best, with its
{{ inference.confidence | percent }} interval. Open symbols in (c): at the best fit of ρ and W.
In (d): star and rings, least and other minima with plastic contact; vertical line, and brackets
in the title, the {{ inference.confidence | percent }} interval of the least one over scans;
grey dots, best fit of each set of substitutes, whose spread is the interval that the verdicts
take. In (e): white dots, fits to samples of what the mean forces may be, given the scatter of
the scans; black, published result with its uncertainty; white line, where the error is small
enough anywhere, the region below the paper's threshold. Dashed in (b) to (e): the published
range. Drawn from contact.nc, inference.nc and sets.nc, published values from parameters.csv and
pull_off.csv of resources/paper.
"""

CONTACT_MODEL = "plastic"  # the one the paper's conclusions rest on
MEGAPASCAL = 1e6
PRESSURE_DECADES = 3  # below, the pressure adds nothing visible to the force
AT_FIT: style.Look = {"mfc": "white", "ms": 5, "mew": 1.2}
RATIO_FIT: style.Look = {"color": "black", "lw": 1.2, "marker": "P", "ms": 5}

SHOWN = {  # panel, unit
    "ratio": ("b", "1"),
    "mean_force": ("c", "N"),
    "mean_force_at_fit": ("c", "N"),
    "median_force": ("c", "N"),
    "range_from_ratios": ("b", "nm"),
}

Curves = dict[tuple[str, str], xr.Dataset]  # by quantity, and by what the values are over


def _table(
    contact: xr.Dataset,
    inference: xr.Dataset,
    sets: xr.Dataset,
    published_constants: pd.DataFrame,
    published_pull_off: pd.DataFrame,
) -> pd.DataFrame:
    """Return the curves and fitted values of Fig. 4, one row a point.

    `x` is the separation (nm, panel a) or the range of adhesion rho (nm, b to e), `value` with
    `low`, `high` in `unit`: over "scans" the mean and its interval, over "sets" the median and
    SHARE_OF_SETS. The maps of panels a (adhesive pressure) and e (mean relative error) stay in
    contact.nc and inference.nc.
    """
    fit, of_sets = (data.sel(contact_model=CONTACT_MODEL) for data in (inference, sets))
    curves = _force_curves(fit, of_sets, published_constants["value"]["work_of_adhesion"])
    separation = pd.DataFrame({"x": contact["separation"].values, "value": contact["force"].values})
    in_contact = {"panel": "a", "surface": contact.attrs["surface"], "origin": "computed"}
    frames = [
        separation.assign(**in_contact, quantity="force", unit="N"),
        *_curve_rows(fit, curves, published_pull_off),
        fig4_error.error_rows(inference, sets, CONTACT_MODEL, published_constants),
    ]
    return tables.tidy(frames, inference, "over", "x")


def draw(
    contact: xr.Dataset,
    inference: xr.Dataset,
    sets: xr.Dataset,
    published_constants: pd.DataFrame,
    published_pull_off: pd.DataFrame,
) -> tuple[pd.DataFrame, Figure]:
    """Draw Fig. 4: (a) one contact, (b) force ratios, (c) forces, (d, e) errors of the fit."""
    fit, of_sets = (data.sel(contact_model=CONTACT_MODEL) for data in (inference, sets))
    work = float(published_constants["value"]["work_of_adhesion"])
    curves = _force_curves(fit, of_sets, work)
    figure, ((pressure, separation, key), (ratios, forces), (least, error)) = drawing.create_rows(
        7.6, inference, (1, (1.3, 1, 1)), (1.3, (1, 1)), (1.3, (1, 1))
    )
    _draw_pressure(pressure, contact)
    _draw_separation(separation, contact)
    separation.set_title(style.print_pair(published_constants["value"]), loc="left")
    _draw_ratios(ratios, fit, curves, published_pull_off)
    _draw_forces(forces, fit, curves, work, published_pull_off)
    fig4_error.draw_least_error(least, inference, sets, CONTACT_MODEL)
    fig4_error.draw_error_map(error, fit, published_constants)
    for axes in (ratios, forces, least, error):
        style.draw_published_range(axes, published_constants)
        axes.set_xlim(fit["rho"].values[[0, -1]])
        axes.set_xlabel("range of adhesion ρ (nm)")
        style.label_logarithmic(axes.xaxis, at=(1, 3))
    key.set_axis_off()
    key.legend(handles=_legend_handles(fit, published_constants), loc="center")
    return _table(contact, inference, sets, published_constants, published_pull_off), figure


def _legend_handles(fit: xr.Dataset, published_constants: pd.DataFrame) -> list[Artist]:
    """Return one entry a surface and one for each kind of line and symbol of panels b and c."""
    confidence = print_share(fit.attrs["confidence"])
    published = published_constants["value"]["range_of_adhesion"]
    of_fit = "at the best fit, " + style.print_pair(fit).replace(", ", ",\n")
    grey: style.Look = {"color": "0.3"}
    return [
        *style.surface_handles(fit),
        Line2D([], [], lw=0.7, label=f"{confidence} interval over scans (bars)", **grey),
        style.sets_handle(),
        Line2D([], [], lw=0.9, label="published mean", **grey),
        Line2D([], [], lw=0.9, ls=":", label="published median", **grey),
        Line2D([], [], label=f"published range, ρ = {published:g} nm", **style.PUBLISHED_RANGE),
        Line2D([], [], label="ρ that fits the ratios best", **RATIO_FIT),
        Line2D([], [], marker="o", ls="none", label=of_fit, **grey, **AT_FIT),
    ]


def _draw_pressure(axes: Axes, contact: xr.Dataset) -> None:
    """Map the adhesive pressure (MPa) around the apex, over its largest PRESSURE_DECADES."""
    pressure = abs(contact["adhesive_pressure"]) / MEGAPASCAL
    top = pressure.max().item()
    bottom = top / 10**PRESSURE_DECADES
    x, y = contact["x"].values / 1000, contact["y"].values / 1000
    shown, norm = pressure.clip(min=bottom).values, LogNorm(bottom, top)
    image = axes.pcolormesh(x, y, shown, norm=norm, cmap="magma", **style.PIXELS)
    reach = 1.05 * style.half_width(pressure > bottom) / 1000
    axes.set(xlim=(-reach, reach), ylim=(-reach, reach), xlabel="x (µm)", ylabel="y (µm)")
    axes.set_aspect("equal")
    axes.locator_params(nbins=4)
    axes.figure.colorbar(image, ax=axes, pad=0.02, shrink=0.8, label="adhesive pressure (MPa)")
    style.label_panel(axes, "a", str(contact.attrs["label"]))


def _draw_separation(axes: Axes, contact: xr.Dataset) -> None:
    """Draw the force (µN) against the separation (nm)."""
    axes.axhline(0, color="0.7", lw=0.6)
    axes.plot(contact["separation"], contact["force"] / style.MICRONEWTON, color=style.PUBLISHED)
    axes.set(xlabel="separation (nm)", ylabel="force (µN)")
    axes.locator_params(nbins=5)


def _reference(fit: xr.Dataset) -> str:
    """Return the surface the ratios refer to, whose own ratio is 1 everywhere."""
    return str(abs(fit["ratio"] - 1).max("rho").idxmin("surface").item())


def _force_curves(fit: xr.Dataset, of_sets: xr.Dataset, work: float) -> Curves:
    """Return ratio and mean force (N) at a work of adhesion (J/m2), over "scans" and "sets"."""
    return {
        ("ratio", "scans"): tables.bounded(fit, "ratio"),
        ("ratio", "sets"): tables.over_sets(of_sets["ratio"]),
        ("mean_force", "scans"): tables.bounded(fit, "mean_force") * work,
        ("mean_force", "sets"): tables.over_sets(of_sets["mean_force"]) * work,
    }


def _curve_rows(
    fit: xr.Dataset, curves: Curves, published_pull_off: pd.DataFrame
) -> list[pd.DataFrame]:
    """Return what panels b and c show: curves, values at the fit (nm, N), published values."""
    at_fit = tables.bounded(fit.sel(pair="fitted"), "force_mean")
    computed = {
        **{name: values.rename(rho="x") for name, values in curves.items()},
        ("mean_force_at_fit", "scans"): at_fit.assign(x=fit["range_of_adhesion"]),
    }
    published = _published(fit, published_pull_off).rename_axis("surface").reset_index()
    best = pd.DataFrame([tables.value_and_bounds(fit, "range_from_ratios")])
    rows = [
        *(
            ("computed", quantity, over, tables.as_rows(values))
            for (quantity, over), values in computed.items()
        ),
        *(
            ("published", quantity, None, published.assign(value=published[quantity]))
            for quantity in ("ratio", "mean_force", "median_force")
        ),
        ("computed", "range_from_ratios", "scans", best),
    ]
    return [
        frame.assign(origin=origin, quantity=quantity, over=over, panel=panel, unit=unit)
        for origin, quantity, over, frame in rows
        for panel, unit in [SHOWN[quantity]]
    ]


def _published(fit: xr.Dataset, published_pull_off: pd.DataFrame) -> pd.DataFrame:
    """Return published mean and median (N) by surface, and the ratio of means."""
    forces = published_pull_off.reindex(fit["surface"].values)
    mean = forces["mean_force"]
    return forces.assign(ratio=mean / mean[_reference(fit)])


def _draw_ratios(
    axes: Axes, fit: xr.Dataset, curves: Curves, published_pull_off: pd.DataFrame
) -> None:
    """Draw the ratio of mean forces to the reference surface against rho (nm)."""
    reference = _reference(fit)
    _draw_curves(axes, curves["ratio", "scans"], curves["ratio", "sets"], skipped=reference)
    ratios = _published(fit, published_pull_off)["ratio"]
    _draw_levels(axes, ratios.drop(reference), fit, "-")
    best = tables.value_and_bounds(fit, "range_from_ratios")
    along = [best[name] for name in ("low", "value", "high")]
    style.end_near_values([axes])
    axes.plot(along, [0.05] * 3, transform=axes.get_xaxis_transform(), markevery=[1], **RATIO_FIT)
    axes.set_ylabel(f"force / that of {fit['label'].sel(surface=reference).item()}")
    style.label_panel(axes, "b", "ratios of forces, for any $W$")


def _draw_forces(
    axes: Axes, fit: xr.Dataset, curves: Curves, work: float, published_pull_off: pd.DataFrame
) -> None:
    """Draw the mean force (µN) at the published work of adhesion (J/m2) against rho (nm)."""
    scans, of_sets = (curves["mean_force", over] / style.MICRONEWTON for over in ("scans", "sets"))
    _draw_curves(axes, scans, of_sets)
    published = _published(fit, published_pull_off) / style.MICRONEWTON
    _draw_levels(axes, published["mean_force"], fit, "-")
    _draw_levels(axes, published["median_force"], fit, ":")
    fitted = tables.bounded(fit.sel(pair="fitted"), "force_mean") / style.MICRONEWTON
    for look, of_surface in style.by_surface(fitted):
        style.draw_bars(
            axes, fit["range_of_adhesion"], of_surface, elinewidth=1.2, zorder=4, **look | AT_FIT
        )
    style.end_near_values([axes])
    axes.set_ylabel("mean pull-off force (µN)")
    title = rf"curves: at the published $W$ = {work / style.MILLIJOULE:.3g} mJ/m²"
    style.label_panel(axes, "c", title)


def _draw_curves(axes: Axes, scans: xr.Dataset, of_sets: xr.Dataset, skipped: str = "") -> None:
    """Draw the value with its interval, and the band of the sets, of each but the skipped one."""
    for look, curve in style.by_surface(scans):
        surface = curve["surface"].item()
        if surface != skipped:
            band = of_sets.sel(surface=surface)
            style.fill_interval(axes, band, "rho", look["color"])
            style.draw_bars(axes, curve["rho"], curve, elinewidth=0.7, ms=2.5, **look)
    axes.set(xscale="log", yscale="log")


def _draw_levels(axes: Axes, levels: pd.Series, fit: xr.Dataset, dashes: str) -> None:
    """Draw a horizontal line for each surface with a published value."""
    colours = style.colours(fit["surface"].values)
    for surface, level in levels.dropna().items():
        axes.axhline(level, color=colours[str(surface)], lw=0.9, ls=dashes)
