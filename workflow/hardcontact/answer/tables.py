"""Tables of the page of own surfaces: rms numbers of scans, and what each measurement serves."""

from collections.abc import Mapping

import numpy as np
import xarray as xr

from hardcontact.answer.artificial import measurements
from hardcontact.answer.html import table_html
from hardcontact.answer.limits import measurement_name
from hardcontact.numbers.printing import print_length

ROUGHNESS = (
    "surface, scan", "size, pixel", "rms height (nm)", "rms slope", "rms curvature (1/nm)",
    "peak to valley (nm)", "skewness",
)  # fmt: skip
METRICS = ("rms_height", "rms_gradient", "rms_half_laplacian", "peak_to_valley", "skewness")
ALL_SCALES = ("rms_height", "rms_gradient", "rms_half_laplacian")
MEASUREMENTS = ("scan", "kind", "size, pixel", "reliable", "ends at", "tip radius", "notes")


def roughness_table(topography: xr.Dataset, labels: Mapping[str, str]) -> str:
    """Return the rms numbers of every scan and over all scales, in HTML."""
    rows = []
    for surface, label in labels.items():
        of_surface = topography.sel(surface=surface)
        grid = ", ".join(print_length(of_surface[f"{of}_size"].item()) for of in ("scan", "pixel"))
        for scan in of_surface["scan"].values[np.isfinite(of_surface["rms_height"].values)]:
            values = (of_surface[name].sel(scan=scan).item() for name in METRICS)
            rows.append([f"{label}, {scan}", grid, *map(_digits, values)])
        joined = (_digits(of_surface[f"all_scales_{name}"].item()) for name in ALL_SCALES)
        rows.append([f"{label}, joined spectrum", "all scales, partly artificial", *joined, "", ""])
    note = (
        "Slope: rms gradient of the surface; curvature: half its rms Laplacian. Both grow as the "
        "pixels shrink, so they belong to the pixel size beside them."
    )
    return f"{table_html(ROUGHNESS, rows)}<p><small>{note}</small></p>"


def measurement_table(spectra: xr.Dataset, labels: Mapping[str, str]) -> str:
    """Return size, reliable wavelengths and their reasons of every measurement, in HTML."""
    rows = []
    for surface, label in labels.items():
        known = measurements(spectra.sel(surface=surface))
        for place in range(known.sizes["measurement"]):
            one = known.isel(measurement=place)
            name = measurement_name(one)
            rows.append([f"{label}: {name}" if len(labels) > 1 else name, *_measurement(one)])
    return table_html(MEASUREMENTS, rows)


def _measurement(one: xr.Dataset) -> list[str]:
    """Return the cells of a measurement after its name."""
    lengths = {
        name: _length(one[name].item())
        for name in ("size", "pixel_size", "shortest_reliable", "longest_reliable")
    }
    reasons = [str(one[f"{end}_reason"].item()) for end in ("shortest", "longest")]
    reliable = f"{lengths['shortest_reliable']} to {lengths['longest_reliable']}"
    tip = one["tip_radius"].item()
    return [
        str(one["kind"].item()),
        ", ".join(filter(None, (lengths["size"], lengths["pixel_size"]))),
        reliable if (one["reliable"] == 1).any() else "nowhere",
        "; ".join(reasons),
        print_length(tip) if np.isfinite(tip) else "not known",
        str(one["notes"].item()),
    ]


def _length(value: float) -> str:
    """Return a length (nm) with its unit, or nothing where there is none."""
    return print_length(value) if np.isfinite(value) else ""


def _digits(value: float) -> str:
    """Return three digits of a number, or nothing where there is none."""
    return f"{value:.3g}" if np.isfinite(value) else ""
