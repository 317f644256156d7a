"""Panel a of Fig. 4: the adhesive pressure and the force of one contact."""

import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm

from hardcontact.figures import style

__all__ = ["draw_pressure", "draw_separation", "separation_rows"]

MICRONEWTON = 1e-6
MEGAPASCAL = 1e6
PRESSURE_DECADES = 3  # below, the pressure adds nothing visible to the force


def separation_rows(contact: xr.Dataset) -> pd.DataFrame:
    """Return the force (N) against the separation `x` (nm) of the contact."""
    return pd.DataFrame(
        {
            "panel": "a",
            "surface": str(contact.attrs["surface"]),
            "origin": "computed",
            "quantity": "force",
            "x": contact["separation"].values,
            "value": contact["force"].values,
            "unit": "N",
        }
    )


def draw_pressure(axes: Axes, contact: xr.Dataset) -> None:
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


def draw_separation(axes: Axes, contact: xr.Dataset) -> None:
    """Draw the force (µN) against the separation (nm)."""
    axes.axhline(0, color="0.7", lw=0.6)
    axes.plot(contact["separation"], contact["force"] / MICRONEWTON, color=style.PUBLISHED)
    axes.set(xlabel="separation (nm)", ylabel="force (µN)")
    axes.locator_params(nbins=5)


def _reach(pressure: xr.DataArray, bottom: float) -> float:
    """Return the half width (nm) of the square about the apex that holds all pressure > bottom."""
    farthest = (abs(pressure[along]).where(pressure > bottom).max().item() for along in "xy")
    return 1.05 * float(max(farthest))
