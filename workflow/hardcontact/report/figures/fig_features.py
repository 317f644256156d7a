"""Forces on a surface with bumps, with pits, or Gaussian: mean, median and scatter."""

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from hardcontact.base.statistics import log_std_of_lognormal
from hardcontact.report.figures import drawing, style

#: Symbol, colour and words of each kind of surface; no coating has these colours.
FEATURE_LOOKS: dict[str, style.Look] = {
    "bumps": {"marker": "^", "color": "#882255", "label": "bumps"},
    "pits": {"marker": "v", "color": "#332288", "label": "pits"},
    "gaussian": {"marker": "o", "color": "0.6", "label": "Gaussian, height over all scales"},
}
EQUALITY_LOOK: style.Look = {"color": "0.6", "lw": 0.8}


def draw(features: xr.Dataset, published_pull_off: pd.DataFrame) -> Figure:
    """Draw (a) median and (b) scatter of the forces on each surface against their mean."""
    figure = drawing.create_figure(3.2, features)
    median_axes, scatter_axes = figure.subplots(1, 2)
    for feature_kind, look in FEATURE_LOOKS.items():
        candidates = features.sel(features=feature_kind)
        mean = candidates["mean_force_at_pair"] / style.MICRONEWTON
        median = candidates["median_force_at_pair"] / style.MICRONEWTON
        median_axes.scatter(mean, median, s=14, **look)
        scatter_axes.scatter(mean, candidates["log_force_std"], s=14, **look)
    # NaN if the paper has no forces on the surface.
    forces = published_pull_off.reindex([features.attrs["surface"]]).iloc[0]
    published_mean = forces["mean_force"] / style.MICRONEWTON
    published_median = forces["median_force"] / style.MICRONEWTON
    published_log_std = log_std_of_lognormal(forces["mean_force"], forces["median_force"])
    published_look: style.Look = {"marker": "s", "color": "black", "label": "published"}
    median_axes.plot(published_mean, published_median, ls="none", **published_look)
    scatter_axes.plot(published_mean, published_log_std, ls="none", **published_look)
    means = features["mean_force_at_pair"].values / style.MICRONEWTON
    ends = [np.nanmin(means, initial=published_mean), np.nanmax(means, initial=published_mean)]
    median_axes.plot(ends, ends, zorder=0, **EQUALITY_LOOK)
    median_axes.set(xscale="log", yscale="log", ylabel="median force (µN)")
    scatter_axes.set(xscale="log", ylabel="standard deviation of ln F")
    for letter, axes, title in (("a", median_axes, "median"), ("b", scatter_axes, "scatter")):
        axes.set_xlabel("mean force (µN)")
        style.label_panel(axes, letter, f"{title} at the published ρ and $W$")
    style.label_logarithmic(
        median_axes.xaxis, median_axes.yaxis, scatter_axes.xaxis, digits=(1, 2, 5)
    )
    handles = [
        Line2D([], [], ls="none", **look) for look in (*FEATURE_LOOKS.values(), published_look)
    ]
    handles.append(Line2D([], [], label="median = mean (a)", **EQUALITY_LOOK))
    style.legend_above(figure, handles, max_columns=5)
    return figure
