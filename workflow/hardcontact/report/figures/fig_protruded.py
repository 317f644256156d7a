"""The effect of rare protrusions, on a coating or the sphere, on the fit of range and work."""

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from hardcontact.base.formatting import format_share
from hardcontact.report.figures import drawing, style, tables

TITLE = "If one coating or the sphere had rare protrusions"
CHAPTER = "3. Adhesion"
CAPTION = """\
(a) Mean and median force on one coating if the coating (dots) or the sphere (triangles) has rare
protrusions. (b, c) Best range ρ and work of adhesion W of sets of scans with such
protrusions. Filled: mean and median force are within a factor of two of the published ones. Black:
published.

The coating is {{ sets.protruded_surface | replace("_", " ") }}; other coatings have no
protrusions. Forces of (a) are at the published ρ and W, those of (b, c) at the best fit.
Protrusions have Gaussian shape and stand at random positions, 0.1 to 3 per µm². They are 3 to 8 rms
heights of the coating high (colour) and 30 to 100 nm wide. A quarter of the draws have none
(dark). (b) The coating is scaled to its rms height of Table 1, and its rms slope stays within its
uncertainty there. (c) All coatings feel the protrusions of the sphere, whose rms height stays
below the published 1 nm. The factor of two is the only condition; ρ and W are free. Sets that
meet it and lie near the published pair are consistent with the paper, but do not test it. Drawn
from protruded.nc, protruded_sphere.nc and resources/paper/parameters.csv and pull_off.csv.
"""

HEIGHT_COLOURS = "viridis"
#: Panel and symbol by the body with protrusions.
PANELS = {"coating": "b", "sphere": "c"}
SYMBOLS = {"coating": "o", "sphere": "^"}
COLUMNS = [
    "panel", "protruded_body", "draw", "set", "origin", "quantity", "protrusion_density",
    "protrusion_height", "protrusion_width", "agrees", *tables.VALUE_COLUMNS,
]  # fmt: skip


def draw(
    protruded: xr.Dataset,
    protruded_sphere: xr.Dataset,
    published_constants: pd.DataFrame,
    published_pull_off: pd.DataFrame,
) -> tuple[pd.DataFrame, Figure]:
    """Draw (a) forces of each draw of protrusions, (b, c) fits of all sets with each draw.

    The table has (a) mean and median force (N), and (b, c) range (nm) and work of adhesion (J/m2)
    of each set. `agrees` is 1 if its forces agree with the published forces, else 0.
    """
    published_forces = published_pull_off.loc[protruded.attrs["surface"]]
    protruded_body = pd.Index(list(PANELS), name="protruded_body")
    fits = xr.concat(
        [protruded, protruded_sphere], protruded_body, join="outer", combine_attrs="override"
    )
    norm = Normalize(0, np.nanmax(fits["protrusion_height"].values, initial=1.0))
    figure = drawing.create(3.2, protruded)
    force_axes, *fit_axes = figure.subplots(1, 3, width_ratios=(1, 1, 1.2))
    _draw_forces(force_axes, fits, published_forces, norm)
    for axes, (name, letter) in zip(fit_axes, PANELS.items(), strict=True):
        share = _draw_fits(axes, fits.sel(protruded_body=name), norm)
        style.draw_published_fit(axes, published_constants)
        style.label_panel(axes, letter, f"on the {name}; {format_share(share, '.0f')} agree")
    colour_scale = ScalarMappable(norm, HEIGHT_COLOURS)
    figure.colorbar(colour_scale, ax=fit_axes[-1], label="height of protrusions / rms height")
    handles = [
        *(Line2D([], [], ls="none", marker=symbol, color="0.4", label=f"on the {name} (a)")
          for name, symbol in SYMBOLS.items()),
        Line2D([], [], ls="none", marker="o", color="0.4", label="forces agree (b, c)"),
        Line2D([], [], ls="none", marker="o", mfc="none", color="0.4",
               label="forces differ (b, c)"),
        Line2D([], [], ls="none", marker="s", color="black", label="published"),
    ]  # fmt: skip
    style.legend_above(figure, handles, max_columns=5)
    published_rows = [
        tables.quantity_rows(
            "a",
            f"{name}_force_at_published",
            "N",
            "published",
            value=published_forces[f"{name}_force"],
        )
        for name in ("mean", "median")
    ]
    protrusions = fits[["protrusion_density", "protrusion_height", "protrusion_width"]]
    frames = [
        tables.computed_rows(
            protrusions.assign(value=fits[name]), panel="a", quantity=name, unit="N"
        )
        for name in ("mean_force_at_published", "median_force_at_published")
    ] + [
        tables.computed_rows(
            protrusions.assign(value=fits[name], agrees=fits["agrees"]), quantity=name, unit=unit
        ).assign(panel=lambda rows: rows["protruded_body"].map(PANELS))
        for name, unit in (("range_of_adhesion", "nm"), ("work_of_adhesion", "J/m2"))
    ]
    return pd.concat([*frames, *published_rows], ignore_index=True).reindex(columns=COLUMNS), figure


def _draw_forces(
    axes: Axes, fits: xr.Dataset, published_forces: "pd.Series[float]", norm: Normalize
) -> None:
    """Draw median against mean force (µN) at the published pair."""
    published = [
        published_forces[name] / style.MICRONEWTON for name in ("mean_force", "median_force")
    ]
    forces = fits[["mean_force_at_published", "median_force_at_published"]] / style.MICRONEWTON
    for name, symbol in SYMBOLS.items():
        mean, median = forces.sel(protruded_body=name).values()
        colours = fits["protrusion_height"].sel(protruded_body=name)
        axes.scatter(mean, median, c=colours, cmap=HEIGHT_COLOURS, norm=norm, s=14, marker=symbol)
    axes.plot(*published, "s", color="black", ms=5)
    largest = np.nanmax(forces.to_array().values, initial=max(published))
    ends = np.array([0.7 * min(published), 1.5 * largest])
    axes.plot(ends, ends, color="0.7", lw=0.6, zorder=0)
    axes.set(xscale="log", yscale="log", xlabel="mean force (µN)", ylabel="median force (µN)")
    style.label_logarithmic(axes.xaxis, axes.yaxis, digits=(1, 2, 5))
    style.label_panel(axes, "a", "at the published ρ and $W$")


def _draw_fits(axes: Axes, fits: xr.Dataset, norm: Normalize) -> float:
    """Draw work (mJ/m²) against range of adhesion (nm); return the share of sets that agrees."""
    agrees = fits["agrees"].values == 1
    heights = fits["protrusion_height"].broadcast_like(fits["agrees"]).values
    ranges = fits["range_of_adhesion"].values
    works = fits["work_of_adhesion"].values / style.MILLIJOULE
    axes.plot(ranges[~agrees], works[~agrees], "o", mfc="none", mec="0.75", mew=0.4, ms=2.5)
    axes.scatter(
        ranges[agrees],
        works[agrees],
        c=heights[agrees],
        cmap=HEIGHT_COLOURS,
        norm=norm,
        s=8,
        zorder=3,
    )
    axes.set(
        xscale="log", yscale="log", xlabel="range of adhesion ρ (nm)",
        ylabel="work of adhesion $W$ (mJ/m²)",
    )  # fmt: skip
    style.label_logarithmic(axes.xaxis, axes.yaxis)
    return float(agrees.mean()) if agrees.size else 0.0
