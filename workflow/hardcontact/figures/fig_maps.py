"""Maps of the pull-off force beside the heights, their distribution, and what a mean needs."""

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from hardcontact.figures import style, tables
from hardcontact.numbers.printing import print_share

MAPPED, ARRAY = "all positions", "array of contacts"
FORCES = "RdBu_r"  # white at the mean of the map
REACH = 0.999  # share of the positions of each surface inside the colours
LINES = {"array": "-", "random": "--"}
NEEDS = {"contacts_needed": "e", "scans_needed": "f"}
COLUMNS = [
    *tables.ROW_COLUMNS,
    "sample",
    "rho",
    "contacts",
    "relative_force",
    *tables.VALUE_COLUMNS,
]


def table(maps: xr.Dataset) -> pd.DataFrame:
    """Return what panels b to f are drawn from, one row a number; the maps stay in maps.nc.

    Of each surface the mean of the map that is drawn and the distribution of all maps, over the
    force of a smooth sphere; relative errors of means at the confidence of the study by the number
    of contacts, and of the mean of one whole scan; contacts and scans needed, with their intervals.
    """
    rows = [
        _rows(_drawn_mean(maps), "b", "mean_over_smooth_sphere"),
        _rows(maps["distribution"].sel(rho=_reference(maps)), "c", "share_per_decade"),
        _rows(_errors(maps), "d", "relative_error"),
        _rows(_scan_error(maps), "d", "relative_error_of_one_scan"),
    ]
    for name, panel in NEEDS.items():
        needed = tables.bounded(maps, name).to_dataframe().reset_index()
        rows.append(needed.assign(panel=panel, quantity=name))
    rows = [one.rename(columns={"sampling": "sample"}) for one in rows]
    joined = pd.concat(rows, ignore_index=True).assign(origin="computed", unit="1")
    return tables.label_surfaces(joined, maps).reindex(columns=COLUMNS)


@style.print_style()
def draw(maps: xr.Dataset) -> Figure:
    """Draw (a) heights, (b) forces, (c) distributions, (d) errors, (e, f) what a mean needs."""
    figure = style.create(8.2)
    rows = figure.add_gridspec(4, 1, height_ratios=(1, 1, 1.25, 1.25))
    across = maps.sizes["surface"]
    above, below = (rows[row].subgridspec(1, across).subplots(squeeze=False)[0] for row in (0, 1))
    (shares, errors), (contacts, scans) = rows[2:].subgridspec(2, 2).subplots(squeeze=False)
    _draw_maps(above, below, maps)
    _draw_distributions(shares, maps)
    _draw_errors(errors, maps)
    _draw_contacts_needed(contacts, maps)
    _draw_scans_needed(scans, maps)
    figure.legend(
        handles=style.surface_handles(maps), loc="outside upper center", ncols=min(across, 6)
    )
    style.mark_basis(figure, maps)
    return figure


def _reference(maps: xr.Dataset) -> float:
    """Return the range of adhesion (nm) of the maps."""
    return float(maps.attrs["reference_rho"])


def _drawn_mean(maps: xr.Dataset) -> xr.DataArray:
    """Return the mean (surface) of the maps that are drawn, over the force of a smooth sphere."""
    mean: xr.DataArray = maps["pull_off_force"].mean(["row", "column"], dtype=float)
    relative: xr.DataArray = mean / maps.attrs["smooth_sphere_force"]
    return relative


def _errors(maps: xr.Dataset) -> xr.DataArray:
    """Return the error (sampling, surface, contacts) of means that they keep with confidence."""
    at_range = maps.sel(rho=_reference(maps))
    random = at_range["variation"] / np.sqrt(maps["contacts"])
    either = xr.concat([at_range["array_error"], random], pd.Index(list(LINES), name="sampling"))
    errors: xr.DataArray = maps.attrs["normal_quantile"] * either
    return errors


def _scan_error(maps: xr.Dataset) -> xr.DataArray:
    """Return the same (surface) of the mean of one scan that is known at every position."""
    scatter = maps["between_scans"].sel(rho=_reference(maps))
    error: xr.DataArray = maps.attrs["normal_quantile"] * scatter
    return error


def _rows(values: xr.DataArray, panel: str, quantity: str) -> pd.DataFrame:
    rows = values.to_series().rename("value").reset_index()
    rho = float(values["rho"]) if "rho" in values.coords else np.nan
    return rows.assign(panel=panel, quantity=quantity, rho=rho)


def _draw_maps(above: np.ndarray, below: np.ndarray, maps: xr.Dataset) -> None:
    """Draw the heights (nm) of one scan a surface, and under them the force over its mean."""
    limit = _limit(maps["pull_off_force"])
    colours, means = style.colours(maps["surface"].values), _drawn_mean(maps)
    for place, (surface, colour) in enumerate(colours.items()):
        of_surface = maps.sel(surface=surface)
        heights, forces = (
            of_surface[name].dropna("row", how="all").dropna("column", how="all").values
            for name in ("heights", "pull_off_force")
        )
        size = float(of_surface["scan_size"])
        style.draw_map(above[place], heights, size)
        image = below[place].imshow(
            forces / forces.mean(dtype=float),
            norm=LogNorm(1 / limit, limit),
            cmap=FORCES,
            extent=(0, size, 0, size),
        )
        _draw_bar(below[place], image, limit)
        for axes in (above[place], below[place]):
            axes.spines[:].set(edgecolor=colour, linewidth=1.5)
        label = str(of_surface["label"].item())
        style.label_panel(above[place], f"a_{place + 1}", label)
        percent = 100 * means.sel(surface=surface).item()
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
    shares = maps["distribution"].sel(rho=_reference(maps))
    for surface, colour in style.colours(maps["surface"].values).items():
        mapped, array = (shares.sel(surface=surface, sample=name) for name in (MAPPED, ARRAY))
        axes.fill_between(
            shares["relative_force"], mapped, step="mid", color=colour, alpha=0.35, lw=0
        )
        axes.step(shares["relative_force"], array, where="mid", color=colour, lw=0.9)
    found = shares["relative_force"].where((shares > 0).any(["surface", "sample"]), drop=True)
    axes.set(xscale="log", xlim=(found.min() / 1.1, found.max() * 1.1), ylim=(0, None))
    axes.set(xlabel="pull-off force / that of a smooth sphere", ylabel="share per decade")
    style.label_logarithmic(axes.xaxis, at=(1,))
    number = maps.attrs["array_contacts"]
    axes.legend(
        handles=[
            Patch(color="0.3", alpha=0.35, lw=0, label=MAPPED),
            Line2D([], [], color="0.3", lw=0.9, label=f"{number:g} contacts a scan"),
        ]
    )
    style.label_panel(axes, "c", f"distribution at ρ = {_reference(maps):g} nm")


def _draw_errors(axes: Axes, maps: xr.Dataset) -> None:
    """Draw errors against the number of contacts, and at the right that of one whole scan."""
    errors, of_scans = _errors(maps), _scan_error(maps)
    last = float(maps["contacts"][-1])
    for surface, colour in style.colours(maps["surface"].values).items():
        for sampling, dashes in LINES.items():
            curve = errors.sel(surface=surface, sampling=sampling)
            axes.plot(maps["contacts"], 100 * curve, ls=dashes, color=colour)
        one = 100 * of_scans.sel(surface=surface).item()
        axes.plot([1.15 * last, 3 * last], [one, one], color=colour, lw=2.5)
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
    for surface, look in style.looks(maps["surface"].values).items():
        of_surface = needed.sel(surface=surface)
        style.draw_over_range(axes, of_surface.sel(sampling="array"), band=0.15, **look)
        at_random = of_surface["value"].sel(sampling="random")
        axes.plot(maps["rho"], at_random, ls=LINES["random"], color=look["color"])
    axes.axhline(maps.attrs["array_contacts"], color="0.4", lw=0.8, ls=":")
    axes.legend(handles=_sampling_handles())
    _finish_needed(axes, maps, "contacts")
    style.label_panel(axes, "e", f"contacts for {_tolerance(maps)} of their scan's mean")


def _draw_scans_needed(axes: Axes, maps: xr.Dataset) -> None:
    """Draw the scans that the mean of the surface needs, with their intervals."""
    needed = tables.bounded(maps, "scans_needed")
    style.label_panel(axes, "f", f"scans for {_tolerance(maps)} of the surface's mean")
    if needed["value"].isnull().all():
        axes.text(0.5, 0.5, "unknown from one scan a surface", ha="center", va="center")
        axes.set(xticks=[], yticks=[])
        return
    for surface, look in style.looks(maps["surface"].values).items():
        style.draw_over_range(axes, needed.sel(surface=surface), band=0.15, **look)
    _finish_needed(axes, maps, "scans")


def _tolerance(maps: xr.Dataset) -> str:
    return print_share(maps.attrs["tolerance"])


def _finish_needed(axes: Axes, maps: xr.Dataset, what: str) -> None:
    axes.set(xscale="log", yscale="log", xlabel="range of adhesion ρ (nm)")
    axes.set_ylabel(f"{what} needed")
    style.label_logarithmic(axes.xaxis, axes.yaxis)
