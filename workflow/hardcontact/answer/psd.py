"""The spectrum of a surface: its measurements, where they are reliable, what is made of them."""

from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from hardcontact.answer import canvas
from hardcontact.answer.artificial import artificial_bands, measurements
from hardcontact.figures import style

MEASURED: dict[str, Any] = {"lw": 2.4, "alpha": 0.5, "solid_capstyle": "butt"}
KINDS: dict[str, dict[str, Any]] = {
    "map": {"color": "#0072B2", **MEASURED},
    "profile": {"color": "#009E73", **MEASURED},
    "description": {"color": "#D55E00", **MEASURED},
}
LABELS = {
    "map": "map, reliable",
    "profile": "profile, reliable",
    "description": "description, of a source",
}
UNRELIABLE: dict[str, Any] = {"color": "0.3", "lw": 1.1, "ls": ":"}
JOINED: dict[str, Any] = {"color": "black", "ls": "none", "marker": "o", "ms": 3}
USED: dict[str, Any] = {"color": "black", "lw": 0.9}
MARGIN = 4.0  # factor by which the wavelengths shown go beyond all that are measured


@canvas.canvas_style()
def draw(of_surface: xr.Dataset) -> Figure:
    """Draw the isotropic PSD of each measurement, the joined one, and where no scan is reliable.

    Parameters
    ----------
    of_surface : xarray.Dataset
        Part of spectra.nc: `psd` and `reliable` (measurement, bin_wavevector), `kind`
        (measurement), `joined` (bin_wavevector) and `spectrum` (wavevector), in nm⁴ over rad/nm,
        and what `artificial_bands` takes.

    Returns
    -------
    matplotlib.figure.Figure
        The figure.
    """
    figure = canvas.create(3.9)
    axes = figure.subplots()
    known = measurements(of_surface)
    wavelength = 2 * np.pi / known["bin_wavevector"].values
    for one in range(known.sizes["measurement"]):
        _draw_measurement(axes, wavelength, known.isel(measurement=one))
    axes.plot(wavelength, of_surface["joined"], zorder=4, **JOINED)
    axes.plot(2 * np.pi / of_surface["wavevector"], of_surface["spectrum"], zorder=3, **USED)
    axes.set(xscale="log", yscale="log", xlabel="wavelength", ylabel="isotropic PSD (nm⁴)")
    _limit(axes, wavelength, known, of_surface)
    canvas.label_lengths(axes.xaxis)
    style.shade_artificial(axes, artificial_bands(of_surface))
    kinds = [kind for kind in KINDS if kind in known["kind"].values]
    figure.legend(handles=_legend_handles(kinds), loc="outside upper center", ncols=2)
    return figure


def _draw_measurement(axes: Axes, wavelength: np.ndarray, one: xr.Dataset) -> None:
    """Draw the PSD of one measurement: where it is reliable in colour, elsewhere pale."""
    density = one["psd"]
    axes.plot(wavelength, density, zorder=2, **UNRELIABLE)
    reliable = density.where(one["reliable"] == 1)
    axes.plot(wavelength, reliable, **KINDS[str(one["kind"].item())])


def _limit(axes: Axes, wavelength: np.ndarray, known: xr.Dataset, of_surface: xr.Dataset) -> None:
    """Show the wavelengths that are measured and some beyond, and the PSD there."""
    measured = wavelength[np.isfinite(known["psd"].values).any(axis=0)]
    left, right = measured.min() / MARGIN, measured.max() * MARGIN
    used = of_surface["spectrum"]
    inside = (used["wavevector"] >= 2 * np.pi / right) & (used["wavevector"] <= 2 * np.pi / left)
    values = np.concatenate(
        [used.values[inside.values & (used.values > 0)], known["psd"].values.ravel()]
    )
    bottom, top = np.nanmin(values), np.nanmax(values)
    axes.set(xlim=(left, right), ylim=(bottom / 3, top * 3))


def _legend_handles(kinds: list[str]) -> list[Any]:
    """Return one entry for each kind of line."""
    return [
        *(Line2D([], [], label=LABELS[kind], **KINDS[kind]) for kind in kinds),
        Line2D([], [], label="not reliable, not used", **UNRELIABLE),
        Line2D([], [], label="joined", **JOINED),
        Line2D([], [], label="spectrum used", **USED),
        Patch(label="no reliable scan", **style.ARTIFICIAL),
    ]
