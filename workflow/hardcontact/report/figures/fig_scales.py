"""The question as a picture: spectra of all surfaces, and one scan without short or long waves."""

from collections.abc import Sequence

import matplotlib as mpl
import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from hardcontact.base.formatting import format_length
from hardcontact.report.figures import drawing, panels, style
from hardcontact.surfaces.filters import filtered_series, interpolate
from hardcontact.surfaces.height_map import HeightMap, mirror_scan

PUBLISHED_BAND_LOOK: style.Look = {"color": "0.4", "alpha": 0.2, "lw": 0}
SCAN_LOOK: style.Look = {"ls": "none", "ms": 3, "mfc": "white", "mew": 0.8}
ARTIFICIAL_LINE: style.Look = {"ls": (0, (2, 1.2)), "marker": "", "lw": 1.0}
PROFILE_LOOKS: tuple[style.Look, ...] = (  # no surface has the colours of the last two
    {"lw": 3.2, "alpha": 0.4},
    {"lw": 0.9, "color": "#332288"},
    {"lw": 1.1, "color": "#882255", "ls": "--"},
)
SPHERE_LINE: style.Look = {"color": style.SPHERE_COLOUR, "lw": 1.4, "ls": "-."}
SCALE_BAR = 500  # nm
MAP_COLOURS = mpl.colormaps["viridis"].resampled(20)  # few colours halve the SVG
#: Smaller values of a spectrum (nm⁴) are zero but for rounding: the spectrum ends there.
MIN_SPECTRUM = 1e-12
SHOWN_DECADES = 14  # of the spectra


def draw(
    topography: xr.Dataset, filtered_forces: xr.Dataset, published_constants: pd.DataFrame
) -> Figure:
    """Draw (a) the spectra of all surfaces, (b-d) maps of one scan, (e) their profiles."""
    band = panels.published_band(published_constants)
    figure, ((spectrum_axes,), map_axes, (profile_axes,)) = drawing.create_rows(
        7.4, topography, row_heights=(2.3, 2.1, 1.4), panel_widths=([1], [1, 1, 1], [1])
    )
    _draw_spectra(spectrum_axes, topography, filtered_forces, band)
    surface = topography.attrs["reference_surface"]
    sphere_surface = topography.attrs["sphere_surface"]
    colour = style.surface_colours(topography["surface"].values, sphere_surface)[surface]
    scan = topography.sel(surface=surface)
    maps = filtered_heights(scan, band)
    _draw_maps(map_axes, scan, maps)
    _draw_profiles(profile_axes, scan, maps, filtered_forces.attrs["sphere_radius"], colour)
    short, long = (format_length(edge) for edge in band)
    handles = [
        *style.surface_handles(topography),
        Patch(label=f"published band, {short} to {long}", **PUBLISHED_BAND_LOOK),
        Line2D([], [], color="0.3", marker="o", label="mean of the scans", **SCAN_LOOK),
        Patch(label="artificial roughness (dashed)", **style.HATCHED_LOOK),
    ]
    style.legend_above(figure, handles)
    return figure


def filtered_heights(scan: xr.Dataset, band: Sequence[float]) -> dict[str, np.ndarray]:
    """Return heights (nm) of a scan by title: all waves, none below a band (nm), none above it."""
    heights = panels.centred_heights(scan["example_heights"])
    mirrored = mirror_scan(HeightMap(heights, scan["scan_size"].item() / len(heights)))
    # At least two pixels lie within the short edge.
    pixels = max(mirrored.pixels, 2 * int(mirrored.size / band[0]) + 4)
    fine_map = interpolate(mirrored, pixels)
    (long_waves,) = filtered_series(fine_map, "short", [band[0]], pixels)
    (short_waves,) = filtered_series(fine_map, "long", [band[1]], pixels)
    maps = {
        "all wavelengths": fine_map,
        f"none below {format_length(band[0])}": long_waves,
        f"none above {format_length(band[1])}": short_waves,
    }
    unmirrored = slice(pixels // 2)
    return {title: periodic.heights[unmirrored, unmirrored] for title, periodic in maps.items()}


def _draw_spectra(
    axes: Axes, topography: xr.Dataset, filtered_forces: xr.Dataset, band: Sequence[float]
) -> None:
    """Draw spectra: of scans, and at all scales, dashed where roughness is artificial."""
    wavelengths = 2 * np.pi / topography["wavevector"]
    shortest, longest = filtered_forces["transition"].sel(side=["short", "long"]).values
    is_artificial = (wavelengths < shortest) | (wavelengths > longest)
    for look, surface_topography in style.iterate_surfaces(topography):
        density = surface_topography["spectrum"].where(lambda values: values > MIN_SPECTRUM)
        scan_density = surface_topography["isotropic_psd"].mean("scan")
        line: style.Look = look | {"marker": ""}
        axes.plot(wavelengths, density.where(~is_artificial), **line)
        axes.plot(wavelengths, density, **look | ARTIFICIAL_LINE)
        axes.plot(wavelengths, scan_density, **look | SCAN_LOOK)
    axes.axvspan(*band, zorder=0, **PUBLISHED_BAND_LOOK)
    spectrum_ends = filtered_forces["spectrum_end"].values
    axes.set(xscale="log", yscale="log", xlabel="wavelength (nm)", ylabel="isotropic PSD (nm⁴)")
    axes.set_xlim(spectrum_ends.min(), spectrum_ends.max())
    highest = 10 * topography["spectrum"].max().item()
    axes.set_ylim(highest / 10**SHOWN_DECADES, highest)
    style.label_logarithmic(axes.xaxis)
    panels.hatch_wavelengths(axes, [(0.0, shortest), (longest, np.inf)])
    style.label_panel(axes, "a", "power spectral densities")


def _draw_maps(row: np.ndarray, scan: xr.Dataset, maps: dict[str, np.ndarray]) -> None:
    """Map the heights on one scale, with a bar of SCALE_BAR and the line of the profiles."""
    size = scan["scan_size"].item()
    unfiltered, *_ = maps.values()
    height_limits = {"vmin": unfiltered.min(), "vmax": unfiltered.max()}
    for axes, letter, (title, heights) in zip(row, "bcd", maps.items(), strict=True):
        image = axes.imshow(heights, cmap=MAP_COLOURS, extent=(0, size, size, 0), **height_limits)
        axes.axhline(size / 2, color="white", lw=0.7, ls=":")
        start = 0.05 * size
        axes.plot([start, start + SCALE_BAR], [0.93 * size] * 2, color="white", lw=2.5)
        axes.text(start, 0.9 * size, f"{SCALE_BAR} nm", color="white", fontsize=7, va="bottom")
        axes.set(xticks=[], yticks=[])
        style.label_panel(axes, letter, title)
    row[0].set_ylabel(f"first scan of {scan['label'].item()}")
    row[0].figure.colorbar(image, ax=row, pad=0.01, shrink=0.9, label="height (nm)")


def _draw_profiles(
    axes: Axes, scan: xr.Dataset, maps: dict[str, np.ndarray], radius: float, colour: str
) -> None:
    """Draw the heights (nm) along the middle of each map, and a smooth sphere on the unfiltered."""
    for look, (title, heights) in zip(PROFILE_LOOKS, maps.items(), strict=True):
        x = (0.5 + np.arange(len(heights))) * scan["scan_size"].item() / len(heights)
        line: style.Look = {"color": colour} | look
        axes.plot(x, heights[len(heights) // 2], label=title, **line)
    parabola = (x - x.mean()) ** 2 / (2 * radius)
    unfiltered, *_ = maps.values()
    profile = unfiltered[len(x) // 2]
    label = f"smooth sphere, radius {format_length(radius)}"
    axes.plot(x, parabola + (profile - parabola).max(), **SPHERE_LINE, label=label)
    axes.set(xlabel="position (nm)", ylabel="height (nm)", xlim=(0, scan["scan_size"].item()))
    low, high = axes.get_ylim()
    axes.set_ylim(low - 0.25 * (high - low), high)  # leaves room for the legend
    axes.legend(loc="lower center", ncols=4, columnspacing=1.2)
    style.label_panel(axes, "e", "heights along the dotted lines")
