"""Scaling of the band: edges and their formulas, errors of the formulas, map of the regimes."""

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import NullLocator

from hardcontact.report.figures import drawing, style, tables
from hardcontact.theory.closed_form import TRANSITION
from hardcontact.theory.edge_scaling import FORMULA

TITLE = "Scaling of the band: surface, attraction or contact?"
CHAPTER = "8. What decides the band"
CAPTION = """\
(a) Short edge of the critical band against the range of adhesion ρ. (b) Long edge against the
interaction radius √(2Rρ), R the radius of the sphere. Lines: the formulas; dashed: the
published edges. (c) Computed edges relative to the formulas on designed random surfaces. (d)
Surfaces where many points or single peaks attract.

(a, b) One line per sphere; bars: {{ inference.confidence | percent }} intervals over realizations,
random surfaces of one spectrum. Where no cutoff changes the force by more than the tolerance of
Fig. 6, no edge is shown. A, preload over hardness, is the contact area. (c) Surfaces held out:
not used to make the formulas. Open: a bound, the last cutoff; grey: within a factor of two. (d) σ
is the rms height, m the height of the apex. Line: σ/ρ = m/σ, where
many points (left) give way to single peaks; grey: the transition. Coloured marks: the study's
surfaces at the paper's sphere, range and load. Pale: the designed surfaces. Crosses: two chromium
nitride coatings, from published spectra. The area of a mark is √A relative to the roll-off λ_r. λ_r
is the wavelength whose octave holds most of the variance of heights. Drawn from scaling.nc and
resources/paper/parameters.csv.
"""

EDGE_LABELS = {"small": "short edge (nm)", "large": "long edge (nm)"}
INTERACTION_RADIUS = "$\\sqrt{2R\\rho}$"
PUBLISHED_LINE: style.Look = {"color": style.PUBLISHED_COLOUR, "lw": 0.8, "ls": "--", "zorder": 1}
#: Edges of designed surfaces.
SIDE_LOOKS = {"small": ("black", "v", "short edge"), "large": ("0.55", "^", "long edge")}
#: Names of published spectra on the map.
NITRIDES = {"crn_rougher": "CrN, rougher", "crn_smoother": "CrN, smoother"}
#: Coordinates on the map, and area of the mark, for surfaces of the study and designed surfaces.
STUDY_VARIABLES = ("rms_height_over_range", "apex_level", "contact_over_rolloff")
DESIGNED_VARIABLES = (
    "designed_rms_height_over_range",
    "designed_level",
    "designed_contact_over_rolloff",
)
FURTHER_COLUMNS = (
    "side",
    "radius",
    "area",
    "rho",
    "interaction_radius",
    "designed",
    "prediction",
)  # columns


def draw(scaling: xr.Dataset, published_constants: pd.DataFrame) -> tuple[pd.DataFrame, Figure]:
    """Draw edges against (a) the range and (b) the reach, (c) errors, (d) a map of the regimes.

    Panels a and b have the contact area nearest to the paper's; the table has all areas.
    """
    figure = drawing.create(5.6, scaling)
    (short, long), (errors, regimes) = figure.subplots(2, 2)
    scaling = scaling.set_coords("interaction_radius")
    section = scaling.sel(area=scaling.attrs["area"], method="nearest")
    frames = []
    for axes, side, abscissa, letter in (
        (short, "small", "rho", "a"),
        (long, "large", "interaction_radius", "b"),
    ):
        _draw_edges(axes, section.sel(side=side), abscissa)
        published = tables.published_edge(published_constants, side)
        axes.axhline(published, **PUBLISHED_LINE)
        axes.set_ylabel(EDGE_LABELS[side])
        style.label_panel(axes, letter, f"A = {section['area']:g} nm²; lines: formula")
        edge_variables = ((letter, name, "nm") for name in ("edge", "formula_edge"))
        frames.append(tables.variable_rows(scaling.sel(side=[side]), *edge_variables))
        frames.append(
            tables.quantity_rows(letter, "edge", "nm", "published", side=side, value=published)
        )
    short.set(xlabel="range of adhesion ρ (nm)")
    short.set_xticks(scaling["rho"], [f"{rho:g}" for rho in scaling["rho"].values])
    short.xaxis.set_minor_locator(NullLocator())
    long.set(xlabel=f"interaction radius {INTERACTION_RADIUS} (nm)")
    held_out = scaling.sel(designed=scaling["held_out"] == 1, prediction=FORMULA)
    _draw_errors(errors, held_out)
    _draw_regimes(regimes, scaling)
    map_variables = (("d", name, "1") for name in (*STUDY_VARIABLES, *DESIGNED_VARIABLES))
    frames += [
        tables.variable_rows(held_out, ("c", "designed_computed_over_predicted", "1")),
        tables.variable_rows(scaling, *map_variables),
    ]
    line = Line2D([], [], label="published edge", **PUBLISHED_LINE)
    style.legend_above(figure, [*style.surface_handles(scaling, ls="none"), line], 5)
    return tables.tidy_table(frames, scaling, *FURTHER_COLUMNS), figure


def _draw_edges(axes: Axes, cases: xr.Dataset, abscissa: str) -> None:
    """Draw the edges of one side for all surfaces, and the formula as a line for each sphere."""
    edges = tables.value_and_interval(cases, "edge").assign(
        abscissa=cases[abscissa], formula=cases["formula_edge"]
    )
    for look, surface_data in style.iterate_surfaces(edges):
        surface_cases = surface_data.stack(case=["radius", "rho"]).dropna("case", subset=["value"])
        style.draw_bars(
            axes, surface_cases["abscissa"], surface_cases, ls="none", ms=3, elinewidth=0.4, **look
        )
        for radius in surface_data["radius"]:
            line = surface_data.sel(radius=radius)
            axes.plot(line["abscissa"], line["formula"], color=look["color"], lw=0.7, alpha=0.7)
    axes.set(xscale="log", yscale="log")
    style.label_logarithmic(axes.xaxis)
    style.label_logarithmic(axes.yaxis, digits=(1, 3))


def _draw_errors(axes: Axes, held_out: xr.Dataset) -> None:
    """Draw the ratio of computed edges to the formula against t rho/sigma for designed surfaces."""
    modulus = held_out["designed_level"] / held_out["designed_rms_height_over_range"]
    for side, (colour, marker, label) in SIDE_LOOKS.items():
        side_data = held_out.sel(side=side)
        errors = side_data["designed_computed_over_predicted"]
        bound = side_data["designed_bound"] != 0
        look: style.Look = {"color": colour, "marker": marker, "ls": "none", "ms": 3.5}
        axes.plot(modulus[~bound], errors[~bound], **look, label=label)
        axes.plot(modulus[bound], errors[bound], **look, mfc="white")
    axes.axhspan(0.5, 2, color="0.92", lw=0, zorder=0)
    axes.axhline(1, color="0.7", lw=0.6, zorder=0)
    axes.axvline(1, color="0.7", lw=0.6, ls=":", zorder=0)
    axes.set(xscale="log", yscale="log", xlim=(0.03, None))
    axes.set(xlabel="modulus $k = \\rho m/\\sigma^2$", ylabel="computed / formula")
    axes.legend(loc="upper right", handletextpad=0.2)
    style.label_logarithmic(axes.xaxis, axes.yaxis)
    style.label_panel(axes, "c", "designed surfaces, held out")


def _draw_regimes(axes: Axes, scaling: xr.Dataset) -> None:
    """Draw all surfaces over sigma/rho and t; marks have the area sqrt(A) over the roll-off."""
    levels = np.geomspace(0.1, 300, 200)
    axes.plot(levels, levels, color="0.4", lw=0.8)
    axes.fill_between(
        levels, levels - TRANSITION, levels + TRANSITION, color="0.92", lw=0, zorder=0
    )

    is_nitride = scaling["designed"].isin(list(NITRIDES))
    modulus = scaling["designed_level"] / scaling["designed_rms_height_over_range"]
    for many_points, colour in ((True, "0.75"), (False, "#DDCC77")):
        designed = scaling.sel(designed=~is_nitride & ((modulus > 1) == many_points))
        x, y, contact = [designed[name] for name in DESIGNED_VARIABLES]
        axes.scatter(x, y, s=8 + 600 * contact, c=colour, lw=0, alpha=0.8)
    for look, surface_data in style.iterate_surfaces(scaling):
        x, y, contact = [surface_data[name] for name in STUDY_VARIABLES]
        axes.scatter(x, y, s=8 + 600 * contact, **look, edgecolors="black", lw=0.5, zorder=3)
    for name, label in NITRIDES.items():
        coating = scaling.sel(designed=name)
        x, y = coating["designed_rms_height_over_range"].item(), coating["designed_level"].item()
        axes.plot(x, y, "x", color=style.PUBLISHED_COLOUR, ms=5)
        axes.annotate(label, (x, y), (-3, 4), textcoords="offset points", ha="right", fontsize=7)
    axes.set(xscale="log", xlim=(0.2, 300), ylim=(-0.5, 5))
    axes.set(xlabel="$\\sigma/\\rho$", ylabel="level of the apex $t = m/\\sigma$")
    axes.text(0.25, 4.6, "many points", fontsize=7, style="italic", va="top")
    axes.text(280, 4.6, "single peaks", fontsize=7, style="italic", ha="right", va="top")
    style.label_logarithmic(axes.xaxis)
    style.label_panel(axes, "d", "regimes; area of a mark: contact over roll-off $\\lambda_r$")
