"""Elastic pressure over the hardness against the shortest wavelength of a surface."""

import pandas as pd
import xarray as xr
from matplotlib.figure import Figure

from hardcontact.report.figures import drawing, style, tables

TITLE = "Down to which wavelength contacts stay elastic"
CHAPTER = "8. What decides the band"
CAPTION = """\
Mean pressure of elastic contact relative to the hardness H, against the shortest wavelength that
the roughness has. The pressure is E* h'/1.67: E* is the contact modulus, h' the rms slope of all
longer waves. Above the black line contacts yield.

The study takes every contact as plastic: its area is preload over hardness. On a surface whose
curve is below 1 at the pixels of its scans, only shorter waves make contacts yield. Contacts yield
where the curve exceeds 1. Below 1 nm these are waves of a few atoms. Drawn from elastic_limit.nc.
"""

MIN_INDEX = 0.01  # that is drawn


def draw(elastic_limit: xr.Dataset) -> tuple[pd.DataFrame, Figure]:
    """Draw one curve for each surface; from 1 (line) on contacts yield."""
    figure = drawing.create(3.0, elastic_limit)
    axes = figure.subplots()
    index = elastic_limit["pressure_over_hardness"]
    visible = elastic_limit.assign(pressure_over_hardness=index.where(index > MIN_INDEX))
    for look, surface in style.iterate_surfaces(visible):
        label = str(surface["label"].item())
        index = surface["pressure_over_hardness"]
        axes.plot(index["shortest_wavelength"], index, color=look["color"], label=label)
    axes.axhline(1, color="black", lw=0.9)
    axes.set(xscale="log", yscale="log", xlabel="shortest wavelength of the roughness (nm)")
    axes.set_ylabel("elastic pressure / hardness")
    axes.text(0.99, 1.1, "contacts yield", transform=axes.get_yaxis_transform(), ha="right")
    axes.legend(loc="lower left")
    style.label_logarithmic(axes.xaxis, axes.yaxis, digits=(1,))
    rows = tables.variable_rows(visible, ("", "pressure_over_hardness", "1"))
    return tables.tidy_table([rows], elastic_limit, "shortest_wavelength"), figure
