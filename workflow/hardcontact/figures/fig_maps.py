"""Maps of the pull-off force beside the heights, their distribution, and what a mean needs."""

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from hardcontact.figures import drawing, style, tables
from hardcontact.numbers.printing import print_share

MAPPED, ARRAY = "all positions", "array of contacts"
FORCES = "RdBu_r"  # white at the mean of the map
REACH = 0.999  # share of the positions of each surface inside the colours
LINES = {"array": "-", "random": "--"}
NEEDS = {"contacts_needed": "e", "scans_needed": "f"}


def table(maps: xr.Dataset) -> pd.DataFrame:
    """Return what panels b to f are drawn from, one row a number; the maps stay in maps.nc.

    Of each surface the mean of the map that is drawn and the distribution of all maps, over the
    force of a smooth sphere; relative errors of means at the confidence of the study by the number
    of contacts, and of the mean of one whole scan; contacts and scans needed, with their intervals.
    """
    there = _at_range(maps)
    shown: list[tuple[str, str, xr.Dataset | xr.DataArray]] = [
        ("b", "mean_over_smooth_sphere", there["mean"].drop_vars("rho")),
        ("c", "share_per_decade", there["distribution"]),
        ("d", "relative_error", there["error"]),
        ("d", "relative_error_of_one_scan", there["scan_error"]),
        *((panel, name, tables.bounded(maps, name)) for name, panel in NEEDS.items()),
    ]
    rows = pd.concat(
        tables.as_rows(values).assign(panel=panel, quantity=name) for panel, name, values in shown
    )
    rows = rows.assign(origin="computed", unit="1", sample=rows["sample"].fillna(rows["sampling"]))
    return tables.tidy([rows], maps, "sample", "rho", "contacts", "relative_force")


def draw(maps: xr.Dataset) -> Figure:
    """Draw (a) heights, (b) forces, (c) distributions, (d) errors, (e, f) what a mean needs."""
    figure = drawing.create(8.2, maps)
    rows = figure.add_gridspec(4, 1, height_ratios=(1, 1, 1.25, 1.25))
    across = maps.sizes["surface"]
    above, below = (rows[row].subgridspec(1, across).subplots(squeeze=False)[0] for row in (0, 1))
    (shares, errors), (contacts, scans) = rows[2:].subgridspec(2, 2).subplots(squeeze=False)
    there = _at_range(maps)
    _draw_maps(above, below, there)
    _draw_distributions(shares, there)
    _draw_errors(errors, there)
    _draw_contacts_needed(contacts, maps)
    _draw_scans_needed(scans, maps)
    style.legend_above(figure, style.surface_handles(maps), min(across, 6))
    return figure


def _at_range(maps: xr.Dataset) -> xr.Dataset:
    """Return all at the range of adhesion of the maps that are drawn.

    New are their `mean` (surface) over the force of a smooth sphere, the relative `error`
    (sampling, surface, contacts) that means keep within with confidence, and that of the mean of
    one scan known at every position, `scan_error` (surface).
    """
    there = maps.drop_dims("sampling").sel(rho=float(maps.attrs["reference_rho"]))
    mean = there["pull_off_force"].mean(["row", "column"], dtype=float)
    random = there["variation"] / np.sqrt(there["contacts"])
    either = xr.concat([there["array_error"], random], pd.Index(list(LINES), name="sampling"))
    quantile = maps.attrs["normal_quantile"]
    return there.assign(
        mean=mean / maps.attrs["smooth_sphere_force"],
        error=quantile * either,
        scan_error=quantile * there["between_scans"],
    )


def _draw_maps(above: np.ndarray, below: np.ndarray, maps: xr.Dataset) -> None:
    """Draw the heights (nm) of one scan a surface, and under them the force over its mean."""
    limit = _limit(maps["pull_off_force"])
    for place, (look, of_surface) in enumerate(style.by_surface(maps)):
        heights, forces = (
            of_surface[name].dropna("row", how="all").dropna("column", how="all").values
            for name in ("heights", "pull_off_force")
        )
        size = float(of_surface["scan_size"])
        style.draw_map(above[place], heights, size)
        relative, norm = forces / forces.mean(dtype=float), LogNorm(1 / limit, limit)
        image = below[place].imshow(relative, norm=norm, cmap=FORCES, extent=(0, size, 0, size))
        _draw_bar(below[place], image, limit)
        for axes in (above[place], below[place]):
            axes.spines[:].set(edgecolor=look["color"], linewidth=1.5)
        style.label_panel(above[place], f"a_{place + 1}", str(of_surface["label"].item()))
        percent = 100 * of_surface["mean"].item()
        style.label_panel(below[place], f"b_{place + 1}", f"mean {percent:.2g} %")
    above[0].set_ylabel("height")
    below[0].set_ylabel("pull-off force / mean")


def _limit(forces: xr.DataArray) -> float:
    """Return the largest factor between a force and the mean of its map that has a colour."""
    relative = forces / forces.mean(["row", "column"], dtype=float)
    tails = relative.quantile([1 - REACH, REACH], ["row", "column"])
    return max(2.0, float(np.exp(np.abs(np.log(tails)).max())))


def _draw_bar(axes: Axes, image: object, limit: float) -> None:
    """Draw the colour bar of a force map, labelled by plain factors of the mean."""
    bar = axes.figure.colorbar(image, ax=axes, shrink=0.9, pad=0.02, extend="both")  # type: ignore[arg-type]
    factor = 2 if limit < 8 else 10
    bar.set_ticks([1 / factor, 1, factor], labels=[f"1/{factor}", "1", f"{factor}"])
    bar.minorticks_off()
    axes.set(xticks=[], yticks=[])


def _draw_distributions(axes: Axes, maps: xr.Dataset) -> None:
    """Draw the distributions of all positions, filled, and of the arrays of contacts, as lines."""
    shares, forces = maps["distribution"], maps["relative_force"]
    for look, of_surface in style.by_surface(maps):
        colour = look["color"]
        mapped, array = (of_surface["distribution"].sel(sample=name) for name in (MAPPED, ARRAY))
        axes.fill_between(forces, mapped, step="mid", color=colour, alpha=0.35, lw=0)
        axes.step(forces, array, where="mid", color=colour, lw=0.9)
    found = forces.where((shares > 0).any(["surface", "sample"]), drop=True)
    axes.set(xscale="log", xlim=(found.min() / 1.1, found.max() * 1.1), ylim=(0, None))
    axes.set(xlabel="pull-off force / that of a smooth sphere", ylabel="share per decade")
    style.label_logarithmic(axes.xaxis, at=(1,))
    number = maps.attrs["array_contacts"]
    filled = Patch(color="0.3", alpha=0.35, lw=0, label=MAPPED)
    axes.legend(handles=[filled, _line("-", f"{number:g} contacts a scan", 0.9)])
    style.label_panel(axes, "c", f"distribution at ρ = {maps['rho']:g} nm")


def _draw_errors(axes: Axes, maps: xr.Dataset) -> None:
    """Draw errors against the number of contacts, and at the right that of one whole scan."""
    last = float(maps["contacts"][-1])
    for look, of_surface in style.by_surface(maps):
        for sampling, dashes in LINES.items():
            curve = 100 * of_surface["error"].sel(sampling=sampling)
            axes.plot(maps["contacts"], curve, ls=dashes, color=look["color"])
        one = 100 * of_surface["scan_error"].item()
        axes.plot([1.15 * last, 3 * last], [one, one], color=look["color"], lw=2.5)
    axes.axhline(100 * maps.attrs["tolerance"], color="0.4", lw=0.8, ls=":")
    axes.axvline(maps.attrs["array_contacts"], color="0.4", lw=0.8, ls=":")
    axes.set(xscale="log", yscale="log", xlabel="contacts on the scan", ylabel="error of mean (%)")
    style.label_logarithmic(axes.xaxis, axes.yaxis)
    axes.legend(handles=[*_sampling_handles(), _line("-", "one whole scan", 2.5)])
    confidence = print_share(maps.attrs["confidence"])
    style.label_panel(axes, "d", f"error that {confidence} keep within")


def _line(dashes: str, label: str, width: float = 1.2) -> Line2D:
    return Line2D([], [], color="0.3", ls=dashes, lw=width, label=label)


def _sampling_handles() -> list[Line2D]:
    return [_line(dashes, f"contacts: {sampling}") for sampling, dashes in LINES.items()]


def _draw_contacts_needed(axes: Axes, maps: xr.Dataset) -> None:
    """Draw the contacts that the mean of their scan needs, in arrays with intervals, at random."""
    needed = tables.bounded(maps, "contacts_needed")
    for look, of_surface in style.by_surface(needed):
        style.draw_with_band(axes, of_surface.sel(sampling="array"), "rho", **look)
        at_random = of_surface["value"].sel(sampling="random")
        axes.plot(maps["rho"], at_random, ls=LINES["random"], color=look["color"])
    axes.axhline(maps.attrs["array_contacts"], color="0.4", lw=0.8, ls=":")
    axes.legend(handles=_sampling_handles())
    _finish_needed(axes, "contacts")
    tolerance = print_share(maps.attrs["tolerance"])
    style.label_panel(axes, "e", f"contacts for {tolerance} of their scan's mean")


def _draw_scans_needed(axes: Axes, maps: xr.Dataset) -> None:
    """Draw the scans that the mean of the surface needs, with their intervals."""
    needed = tables.bounded(maps, "scans_needed")
    tolerance = print_share(maps.attrs["tolerance"])
    style.label_panel(axes, "f", f"scans for {tolerance} of the surface's mean")
    if needed["value"].isnull().all():
        axes.text(0.5, 0.5, "unknown from one scan a surface", ha="center", va="center")
        axes.set(xticks=[], yticks=[])
        return
    for look, of_surface in style.by_surface(needed):
        style.draw_with_band(axes, of_surface, "rho", **look)
    _finish_needed(axes, "scans")


def _finish_needed(axes: Axes, what: str) -> None:
    axes.set(xscale="log", yscale="log", xlabel="range of adhesion ρ (nm)")
    axes.set_ylabel(f"{what} needed")
    style.label_logarithmic(axes.xaxis, axes.yaxis)
