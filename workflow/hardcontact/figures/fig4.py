"""Fig. 4: range and work of adhesion from the computed pull-off forces."""

from typing import Any

import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from hardcontact.figures import fig4_error, marks, style, tables
from hardcontact.numbers.printing import print_share

CONTACT_MODEL = "plastic"  # the one the paper's conclusions rest on
MEGAPASCAL = 1e6
PRESSURE_DECADES = 3  # below, the pressure adds nothing visible to the force
COLUMNS = [*tables.ROW_COLUMNS, "over", "x", *tables.VALUE_COLUMNS]
AT_FIT: dict[str, Any] = {"mfc": "white", "ms": 5, "mew": 1.2}
RATIO_FIT: dict[str, Any] = {"color": "black", "lw": 1.2, "marker": "P", "ms": 5}

Curves = dict[tuple[str, str], xr.Dataset]  # by quantity, and by what the values are over


def table(
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
    curves = force_curves(fit, of_sets, _published_work(published_constants))
    frames = [
        _separation_rows(contact),
        *curve_rows(fit, curves, published_pull_off),
        fig4_error.error_rows(inference, sets, CONTACT_MODEL, published_constants),
    ]
    return tables.label_surfaces(pd.concat(frames, ignore_index=True), inference)[COLUMNS]


@style.print_style()
def draw(
    contact: xr.Dataset,
    inference: xr.Dataset,
    sets: xr.Dataset,
    published_constants: pd.DataFrame,
    published_pull_off: pd.DataFrame,
) -> Figure:
    """Draw Fig. 4: (a) one contact, (b) force ratios, (c) forces, (d, e) errors of the fit."""
    fit, of_sets = (data.sel(contact_model=CONTACT_MODEL) for data in (inference, sets))
    work = _published_work(published_constants)
    curves = force_curves(fit, of_sets, work)
    figure = style.create(7.6)
    rows = figure.add_gridspec(3, 1, height_ratios=(1, 1.3, 1.3))
    upper = rows[0].subgridspec(1, 3, width_ratios=(1.3, 1, 1))
    pressure, separation, key = upper.subplots(squeeze=False)[0]
    ratios, forces = rows[1].subgridspec(1, 2).subplots(squeeze=False)[0]
    least, error = rows[2].subgridspec(1, 2).subplots(squeeze=False)[0]
    _draw_pressure(pressure, contact)
    _draw_separation(separation, contact)
    separation.set_title(_print_pair(published_constants), loc="left")
    draw_ratios(ratios, fit, curves, published_pull_off)
    draw_forces(forces, fit, curves, work, published_pull_off)
    fig4_error.draw_least_error(least, inference, sets, CONTACT_MODEL)
    fig4_error.draw_error_map(error, fit, published_constants)
    for axes in (ratios, forces, least, error):
        marks.draw_published_range(axes, published_constants)
        axes.set_xlim(fit["rho"].values[[0, -1]])
        axes.set_xlabel("range of adhesion ρ (nm)")
        style.label_logarithmic(axes.xaxis, at=(1, 3))
    key.set_axis_off()
    key.legend(handles=_legend_handles(fit, published_constants), loc="center")
    style.mark_basis(figure, inference)
    return figure


def _published_work(published_constants: pd.DataFrame) -> float:
    """Return the published work of adhesion (J/m2)."""
    return float(published_constants["value"]["work_of_adhesion"])


def _print_pair(published_constants: pd.DataFrame) -> str:
    """Return the published range and work of adhesion, as panel a has them."""
    published = published_constants["value"]["range_of_adhesion"]
    work = _published_work(published_constants) / marks.MILLIJOULE
    return f"ρ = {published:g} nm, $W$ = {work:.3g} mJ/m²"


def _legend_handles(fit: xr.Dataset, published_constants: pd.DataFrame) -> list[Line2D | Patch]:
    """Return one entry a surface and one for each kind of line and symbol of panels b and c."""
    confidence = print_share(fit.attrs["confidence"])
    published = published_constants["value"]["range_of_adhesion"]
    best_range = fit["range_of_adhesion"].item()
    best_work = fit["work_of_adhesion"].item() / marks.MILLIJOULE
    return [
        *style.surface_handles(fit),
        Line2D([], [], color="0.3", lw=0.7, label=f"{confidence} interval over scans (bars)"),
        marks.sets_handle(),
        Line2D([], [], color="0.3", lw=0.9, label="published mean"),
        Line2D([], [], color="0.3", lw=0.9, ls=":", label="published median"),
        Line2D([], [], label=f"published range, ρ = {published:g} nm", **marks.PUBLISHED_RANGE),
        Line2D([], [], label="ρ that fits the ratios best", **RATIO_FIT),
        Line2D(
            [],
            [],
            color="0.3",
            marker="o",
            ls="none",
            label=f"at the best fit, ρ = {best_range:.3g} nm,\n$W$ = {best_work:.3g} mJ/m²",
            **AT_FIT,
        ),
    ]


def _separation_rows(contact: xr.Dataset) -> pd.DataFrame:
    """Return the force (N) against the separation `x` (nm) of the contact."""
    curve = pd.DataFrame({"x": contact["separation"].values, "value": contact["force"].values})
    surface = str(contact.attrs["surface"])
    return curve.assign(panel="a", surface=surface, origin="computed", quantity="force", unit="N")


def _draw_pressure(axes: Axes, contact: xr.Dataset) -> None:
    """Map the adhesive pressure (MPa) around the apex, over its largest PRESSURE_DECADES."""
    pressure = abs(contact["adhesive_pressure"]) / MEGAPASCAL
    top = pressure.max().item()
    bottom = top / 10**PRESSURE_DECADES
    x, y = contact["x"].values / 1000, contact["y"].values / 1000
    image = axes.pcolormesh(
        x,
        y,
        pressure.clip(min=bottom).values,
        norm=LogNorm(bottom, top),
        cmap="magma",
        shading="nearest",
        rasterized=True,
    )
    reach = _reach(pressure, bottom) / 1000
    axes.set(xlim=(-reach, reach), ylim=(-reach, reach), xlabel="x (µm)", ylabel="y (µm)")
    axes.set_aspect("equal")
    axes.locator_params(nbins=4)
    axes.figure.colorbar(image, ax=axes, pad=0.02, shrink=0.8, label="adhesive pressure (MPa)")
    style.label_panel(axes, "a", str(contact.attrs["label"]))


def _draw_separation(axes: Axes, contact: xr.Dataset) -> None:
    """Draw the force (µN) against the separation (nm)."""
    axes.axhline(0, color="0.7", lw=0.6)
    axes.plot(contact["separation"], contact["force"] / marks.MICRONEWTON, color=style.PUBLISHED)
    axes.set(xlabel="separation (nm)", ylabel="force (µN)")
    axes.locator_params(nbins=5)


def _reach(pressure: xr.DataArray, bottom: float) -> float:
    """Return the half width (nm) of the square about the apex that holds all pressure > bottom."""
    farthest = (abs(pressure[along]).where(pressure > bottom).max().item() for along in "xy")
    return 1.05 * float(max(farthest))


def _reference(fit: xr.Dataset) -> str:
    """Return the surface the ratios refer to, whose own ratio is 1 everywhere."""
    return str(abs(fit["ratio"] - 1).max("rho").idxmin("surface").item())


def force_curves(fit: xr.Dataset, of_sets: xr.Dataset, work: float) -> Curves:
    """Return ratio and mean force (N) at a work of adhesion (J/m2), over "scans" and "sets"."""
    return {
        ("ratio", "scans"): tables.bounded(fit, "ratio"),
        ("ratio", "sets"): tables.over_sets(of_sets["ratio"]),
        ("mean_force", "scans"): tables.bounded(fit, "mean_force") * work,
        ("mean_force", "sets"): tables.over_sets(of_sets["mean_force"]) * work,
    }


def curve_rows(
    fit: xr.Dataset, curves: Curves, published_pull_off: pd.DataFrame
) -> list[pd.DataFrame]:
    """Return what panels b and c show: curves, values at the fit (nm, N), published values."""
    return [
        *_computed_rows(curves),
        _fitted_rows(fit),
        *_published_rows(fit, published_pull_off),
        pd.DataFrame([tables.value_and_bounds(fit, "range_from_ratios")]).assign(
            panel="b", origin="computed", quantity="range_from_ratios", over="scans", unit="nm"
        ),
    ]


def _computed_rows(curves: Curves) -> list[pd.DataFrame]:
    shown = {"ratio": ("b", "1"), "mean_force": ("c", "N")}
    return [
        values.to_dataframe()[["value", "low", "high"]]
        .reset_index()
        .rename(columns={"rho": "x"})
        .assign(quantity=quantity, over=over, panel=shown[quantity][0], unit=shown[quantity][1])
        .assign(origin="computed")
        for (quantity, over), values in curves.items()
    ]


def _fitted_rows(fit: xr.Dataset) -> pd.DataFrame:
    """Return the mean forces (N) at the fitted range and work of adhesion."""
    forces = tables.bounded(fit.sel(pair="fitted"), "force_mean")
    rows = forces.to_dataframe()[["value", "low", "high"]].reset_index()
    rows = rows.assign(panel="c", origin="computed", quantity="mean_force_at_fit", over="scans")
    return rows.assign(unit="N", x=fit["range_of_adhesion"].item())


def _published(fit: xr.Dataset, published_pull_off: pd.DataFrame) -> pd.DataFrame:
    """Return published mean and median (N) by surface, and the ratio of means."""
    forces = published_pull_off.reindex(fit["surface"].values)
    mean = forces["mean_force"]
    return forces.assign(ratio=mean / mean[_reference(fit)])


def _published_rows(fit: xr.Dataset, published_pull_off: pd.DataFrame) -> list[pd.DataFrame]:
    published = _published(fit, published_pull_off).rename_axis("surface").reset_index()
    shown = (("b", "ratio", "1"), ("c", "mean_force", "N"), ("c", "median_force", "N"))
    return [
        published[["surface", quantity]]
        .rename(columns={quantity: "value"})
        .assign(panel=panel, origin="published", quantity=quantity, unit=unit)
        for panel, quantity, unit in shown
    ]


def draw_ratios(
    axes: Axes, fit: xr.Dataset, curves: Curves, published_pull_off: pd.DataFrame
) -> None:
    """Draw the ratio of mean forces to the reference surface against rho (nm)."""
    reference = _reference(fit)
    _draw_curves(axes, fit, curves["ratio", "scans"], curves["ratio", "sets"], skipped=reference)
    ratios = _published(fit, published_pull_off)["ratio"]
    _draw_levels(axes, ratios.drop(reference), fit, "-")
    best = tables.value_and_bounds(fit, "range_from_ratios")
    along = [best[name] for name in ("low", "value", "high")]
    style.end_near_values([axes])
    axes.plot(along, [0.05] * 3, transform=axes.get_xaxis_transform(), markevery=[1], **RATIO_FIT)
    axes.set_ylabel(f"force / that of {fit['label'].sel(surface=reference).item()}")
    style.label_panel(axes, "b", "ratios of forces, for any $W$")


def draw_forces(
    axes: Axes, fit: xr.Dataset, curves: Curves, work: float, published_pull_off: pd.DataFrame
) -> None:
    """Draw the mean force (µN) at the published work of adhesion (J/m2) against rho (nm)."""
    scans, of_sets = (curves["mean_force", over] / marks.MICRONEWTON for over in ("scans", "sets"))
    _draw_curves(axes, fit, scans, of_sets)
    published = _published(fit, published_pull_off) / marks.MICRONEWTON
    _draw_levels(axes, published["mean_force"], fit, "-")
    _draw_levels(axes, published["median_force"], fit, ":")
    fitted = tables.bounded(fit.sel(pair="fitted"), "force_mean") / marks.MICRONEWTON
    for surface, look in style.looks(fit["surface"].values).items():
        of_surface = fitted.sel(surface=surface)
        axes.errorbar(
            fit["range_of_adhesion"],
            of_surface["value"],
            marks.reach(of_surface)[:, None],
            elinewidth=1.2,
            zorder=4,
            **look | AT_FIT,
        )
    style.end_near_values([axes])
    axes.set_ylabel("mean pull-off force (µN)")
    style.label_panel(
        axes, "c", rf"curves: at the published $W$ = {work / marks.MILLIJOULE:.3g} mJ/m²"
    )


def _draw_curves(
    axes: Axes, fit: xr.Dataset, scans: xr.Dataset, of_sets: xr.Dataset, skipped: str = ""
) -> None:
    """Draw the value with its interval, and the band of the sets, of each but the skipped one."""
    for surface, look in style.looks(fit["surface"].values).items():
        if surface == skipped:
            continue
        band, curve = of_sets.sel(surface=surface), scans.sel(surface=surface)
        marks.fill_sets(axes, band["rho"], band, look["color"])
        axes.errorbar(
            curve["rho"], curve["value"], marks.reach(curve), elinewidth=0.7, ms=2.5, **look
        )
    axes.set(xscale="log", yscale="log")


def _draw_levels(axes: Axes, levels: pd.Series, fit: xr.Dataset, dashes: str) -> None:
    """Draw a horizontal line for each surface with a published value."""
    colours = style.colours(fit["surface"].values)
    for surface, level in levels.dropna().items():
        axes.axhline(level, color=colours[str(surface)], lw=0.9, ls=dashes)
