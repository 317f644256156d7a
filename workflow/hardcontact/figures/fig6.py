"""Fig. 6: which length scales of roughness the pull-off force depends on."""

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from hardcontact.figures import style
from hardcontact.figures.tables import VALUE_COLUMNS, bounded, label_surfaces, value_and_bounds

__all__ = ["draw", "table"]

POOLED = "pooled"
SIDES = {
    "small": "roughness below the cutoff removed",
    "large": "roughness above the cutoff removed",
}
COLUMNS = [
    "side", "group", "label", "basis", "origin", "quantity", "realization", "cutoff_wavelength",
    *VALUE_COLUMNS,
]  # fmt: skip


def table(band: xr.Dataset, scales: xr.Dataset, published_constants: pd.DataFrame) -> pd.DataFrame:
    """Return force ratios and critical wavelengths of Fig. 6, one row a point.

    Parameters
    ----------
    band, scales, published_constants : xarray.Dataset, pandas.DataFrame
        As `draw` takes them.

    Returns
    -------
    pandas.DataFrame
        `ratio` (1) against `cutoff_wavelength` (nm): the mean over realizations with its interval
        (`realization` empty) and each realization; `critical_wavelength` (nm), empty where the
        ratio never leaves 1 +- tolerance, and its published value.
    """
    rows = pd.concat(
        frame
        for side in SIDES
        for frame in (
            _mean_rows(band.sel(side=side)),
            _realization_rows(scales.sel(side=side)),
            _critical_rows(band.sel(side=side)),
            _published_row(side, _published_cutoff(published_constants, side)),
        )
    )
    return label_surfaces(rows, band, "group")[COLUMNS].reset_index(drop=True)


@style.print_style()
def draw(band: xr.Dataset, scales: xr.Dataset, published_constants: pd.DataFrame) -> Figure:
    """Draw Fig. 6: pull-off force of filtered surfaces over that of the unfiltered ones.

    Panel a against the short-, b against the long-wavelength cutoff; the row below each shows where
    the ratio leaves 1 +- tolerance, and the published cutoff runs through both.

    Parameters
    ----------
    band : xarray.Dataset
        With `scale_ratio(group, side, cutoff_wavelength)`, `critical_wavelength(side, group)` in nm
        and their intervals, and the attribute `scale_tolerance`.
    scales : xarray.Dataset
        With `ratio(surface, realization, side, cutoff_wavelength)`.
    published_constants : pandas.DataFrame
        With the critical wavelengths of both sides (nm).

    Returns
    -------
    matplotlib.figure.Figure
        The figure.
    """
    figure = style.create(4.6)
    grid = figure.subplots(2, 2, sharex="col", height_ratios=(3, 1))
    grid[1, 1].sharey(grid[1, 0])
    for letter, side, (above, below) in zip("ab", SIDES, grid.T, strict=True):
        _draw_ratios(above, band.sel(side=side), scales.sel(side=side))
        _draw_critical(below, band.sel(side=side))
        published = _published_cutoff(published_constants, side)
        for axes in (above, below):
            axes.axvline(published, color="0.4", lw=1.0, ls="--", label="published cutoff")
        style.label_panel(above, letter, SIDES[side])
        below.label_outer()
    grid[0, 0].set_ylabel("pull-off force / unfiltered")
    handles, labels = grid[0, 0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper center", ncols=4)
    style.mark_basis(figure, band)
    return figure


def _mean_rows(of_side: xr.Dataset) -> pd.DataFrame:
    frame = bounded(of_side, "scale_ratio").to_dataframe().dropna(subset="value").reset_index()
    return frame.assign(origin="computed", quantity="ratio", unit="1")


def _realization_rows(of_side: xr.Dataset) -> pd.DataFrame:
    frame = of_side["ratio"].to_dataframe("value").dropna(subset="value").reset_index()
    named = frame.rename(columns={"surface": "group"})
    return named.assign(origin="computed", quantity="ratio", unit="1")


def _critical_rows(of_side: xr.Dataset) -> pd.DataFrame:
    frame = bounded(of_side, "critical_wavelength").to_dataframe().reset_index()
    return frame.assign(origin="computed", quantity="critical_wavelength", unit="nm")


def _published_cutoff(published_constants: pd.DataFrame, side: str) -> float:
    """Return the published critical wavelength (nm) of one side of the band."""
    return float(published_constants["value"][f"critical_wavelength_{side}"])


def _published_row(side: str, cutoff: float) -> pd.DataFrame:
    return pd.DataFrame(
        {
            "side": [side],
            "group": POOLED,
            "origin": "published",
            "unit": "nm",
            "quantity": "critical_wavelength",
            "value": cutoff,
        }
    )


def _colours(band: xr.Dataset) -> dict[str, str]:
    """Return the colour of each group: that of its surface, black for all of them pooled."""
    return {**style.colours(band["surface"].values), POOLED: style.PUBLISHED}


def _labels(band: xr.Dataset) -> dict[str, str]:
    """Return the printed name of each group."""
    names = {
        str(name): str(band["label"].sel(surface=name).item()) for name in band["surface"].values
    }
    return {**names, POOLED: "all pooled"}


def _draw_ratios(axes: Axes, of_side: xr.Dataset, scales: xr.Dataset) -> None:
    """Draw ratio against cutoff (nm) of each group, with band and single realizations."""
    tolerance, labels = of_side.attrs["scale_tolerance"], _labels(of_side)
    axes.axhspan(
        1 - tolerance,
        1 + tolerance,
        color="0.88",
        zorder=0,
        label=f"within ±{style.print_share(tolerance)}",
    )
    curves = bounded(of_side, "scale_ratio")
    for group, colour in _colours(of_side).items():
        mean = curves.sel(group=group).dropna("cutoff_wavelength", subset=["value"])
        cutoff = mean["cutoff_wavelength"]
        width = 1.2
        if group == POOLED:
            # Only the outline of this band is drawn, as a filled one would hide the others.
            axes.plot(cutoff, mean["low"], cutoff, mean["high"], color=colour, lw=0.8, ls=":")
            width = 1.8
        else:
            axes.fill_between(cutoff, mean["low"], mean["high"], color=colour, alpha=0.18, lw=0)
        axes.plot(cutoff, mean["value"], color=colour, label=labels[group], lw=width)
    _draw_realizations(axes, scales, _colours(of_side))
    axes.set(xscale="log", yscale="log")
    style.label_logarithmic(axes.xaxis, at=(1, 2, 5))
    style.label_logarithmic(axes.yaxis)


def _draw_realizations(axes: Axes, scales: xr.Dataset, colours: dict[str, str]) -> None:
    """Draw a thin line for each realization of each surface."""
    axes.plot([], [], color="0.4", lw=0.4, label="single realization")
    ratio = scales["ratio"].dropna("cutoff_wavelength", how="all")
    for surface in map(str, scales["surface"].values):
        lines = ratio.sel(surface=surface).transpose("cutoff_wavelength", "realization")
        axes.plot(ratio["cutoff_wavelength"], lines, color=colours[surface], lw=0.4, alpha=0.6)


def _draw_critical(axes: Axes, of_side: xr.Dataset) -> None:
    """Mark the critical wavelength (nm) and its interval of each group, one row a group."""
    colours, labels = _colours(of_side), _labels(of_side)
    for row, (group, colour) in enumerate(colours.items()):
        of_group = value_and_bounds(of_side.sel(group=group), "critical_wavelength")
        axes.plot([of_group["low"], of_group["high"]], [row, row], color=colour, lw=1.4)
        axes.plot([of_group["value"]], [row], color=colour, marker="o", ls="none")
        if not np.isfinite(of_group["value"]):
            axes.text(
                0.02,
                row,
                "never outside the band",
                transform=axes.get_yaxis_transform(),
                fontsize=7,
                color=colour,
                va="center",
            )
    axes.set_yticks(range(len(colours)), [labels[group] for group in colours])
    axes.set(ylim=(len(colours) - 0.4, -0.6), xlabel="cutoff wavelength (nm)")
