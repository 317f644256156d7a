"""Fig. 6: which length scales of roughness the pull-off force depends on."""

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from hardcontact.figures import style

__all__ = ["draw", "table"]

POOLED = "pooled"
SIDES = {
    "small": "roughness below the cutoff removed",
    "large": "roughness above the cutoff removed",
}


def table(inference: xr.Dataset, scales: xr.Dataset) -> pd.DataFrame:
    """Return force ratios and critical wavelengths of Fig. 6, one row a point.

    `ratio` (1) against `cutoff_wavelength` (nm): the mean over realizations with its 95 % interval
    (`realization` empty) and each realization; `critical_wavelength` (nm), empty where the ratio
    never leaves 1 +- tolerance, and its published value.
    """
    rows = pd.concat(
        frame
        for side in SIDES
        for frame in (
            _mean_rows(inference.sel(side=side)),
            _realization_rows(scales.sel(side=side)),
            _critical_rows(inference.sel(side=side)),
            _published_row(inference, side),
        )
    )
    columns = [
        "side",
        "group",
        "label",
        "basis",
        "origin",
        "quantity",
        "realization",
        "cutoff_wavelength",
        "value",
        "low",
        "high",
        "unit",
    ]
    named = inference[["label", "basis"]].to_dataframe()[["label", "basis"]]
    return rows.join(named, on="group")[columns].reset_index(drop=True)


@style.print_style()
def draw(inference: xr.Dataset, scales: xr.Dataset) -> Figure:
    """Draw Fig. 6: pull-off force of filtered surfaces over that of the unfiltered ones.

    Panel a against the short-, b against the long-wavelength cutoff (nm); the row below each shows
    where the ratio leaves 1 +- attrs["scale_tolerance"], and the published cutoff (attrs
    published_cutoff_small, published_cutoff_large, nm) runs through both.
    """
    figure = style.create(4.6)
    grid = figure.subplots(2, 2, sharex="col", height_ratios=(3, 1))
    grid[1, 1].sharey(grid[1, 0])
    for letter, side, (above, below) in zip("ab", SIDES, grid.T, strict=True):
        of_side = inference.sel(side=side)
        _draw_ratios(above, of_side, scales.sel(side=side))
        _draw_critical(below, of_side)
        for axes in (above, below):
            axes.axvline(
                inference.attrs[f"published_cutoff_{side}"],
                color="0.4",
                lw=1.0,
                ls="--",
                label="published cutoff",
            )
        style.label_panel(above, letter, SIDES[side])
        below.label_outer()
    grid[0, 0].set_ylabel("pull-off force / unfiltered")
    handles, labels = grid[0, 0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper center", ncols=4)
    style.mark_basis(figure, inference)
    return figure


def _mean_rows(of_side: xr.Dataset) -> pd.DataFrame:
    names = {"scale_ratio": "value", "scale_ratio_low": "low", "scale_ratio_high": "high"}
    frame = of_side[list(names)].rename(names).to_dataframe().dropna(subset="value").reset_index()
    return frame.assign(origin="computed", quantity="ratio", unit="1")


def _realization_rows(of_side: xr.Dataset) -> pd.DataFrame:
    frame = of_side["ratio"].to_dataframe("value").dropna(subset="value").reset_index()
    named = frame.rename(columns={"surface": "group"})
    return named.assign(origin="computed", quantity="ratio", unit="1")


def _critical_rows(of_side: xr.Dataset) -> pd.DataFrame:
    names = {
        "critical_wavelength": "value",
        "critical_wavelength_low": "low",
        "critical_wavelength_high": "high",
    }
    frame = of_side[list(names)].rename(names).to_dataframe().reset_index()
    return frame.assign(origin="computed", quantity="critical_wavelength", unit="nm")


def _published_row(inference: xr.Dataset, side: str) -> pd.DataFrame:
    return pd.DataFrame(
        {
            "side": [side],
            "group": POOLED,
            "origin": "published",
            "unit": "nm",
            "quantity": "critical_wavelength",
            "value": inference.attrs[f"published_cutoff_{side}"],
        }
    )


def _colours(inference: xr.Dataset) -> dict[str, str]:
    """Return the colour of each group: that of its surface, black for all of them pooled."""
    return {**style.colours(inference["surface"].values), POOLED: style.PUBLISHED}


def _labels(inference: xr.Dataset) -> dict[str, str]:
    """Return the printed name of each group."""
    names = {
        str(name): str(inference["label"].sel(surface=name).item())
        for name in inference["surface"].values
    }
    return {**names, POOLED: "all pooled"}


def _draw_ratios(axes: Axes, of_side: xr.Dataset, scales: xr.Dataset) -> None:
    """Draw ratio against cutoff (nm) of each group, with band and single realizations."""
    tolerance, labels = of_side.attrs["scale_tolerance"], _labels(of_side)
    axes.axhspan(
        1 - tolerance, 1 + tolerance, color="0.88", zorder=0, label=f"within ±{tolerance:.0%}"
    )
    for group, colour in _colours(of_side).items():
        mean = of_side.sel(group=group).dropna("cutoff_wavelength", subset=["scale_ratio"])
        cutoff = mean["cutoff_wavelength"]
        low, high = mean["scale_ratio_low"], mean["scale_ratio_high"]
        if group == POOLED:  # outlined, as a filled band would hide those of the surfaces
            axes.plot(cutoff, low, cutoff, high, color=colour, lw=0.8, ls=":")
        else:
            axes.fill_between(cutoff, low, high, color=colour, alpha=0.18, lw=0)
        axes.plot(
            cutoff,
            mean["scale_ratio"],
            color=colour,
            label=labels[group],
            lw=1.8 if group == POOLED else 1.2,
        )
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
        critical, low, high = (
            of_side[f"critical_wavelength{end}"].sel(group=group).item()
            for end in ("", "_low", "_high")
        )
        axes.plot([low, high], [row, row], color=colour, lw=1.4)
        axes.plot([critical], [row], color=colour, marker="o", ls="none")
        if not np.isfinite(critical):
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
