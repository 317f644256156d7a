"""What limits the answer of a surface, in words."""

import numpy as np
import xarray as xr

from hardcontact.answer.artificial import artificial_bands, reliable_measurements, share_inside
from hardcontact.answer.quantities import print_length
from hardcontact.answer.ratios import SIDES
from hardcontact.answer.sentences import is_open

__all__ = ["artificial_edges", "limits", "measurement_name"]

#: Measurements that a sentence names.
NAMED = 4

EDGES = {"small": "The short edge of the band", "large": "The long edge of the band"}


def limits(basis: str, spectra: xr.Dataset, edges: xr.Dataset, force: xr.Dataset) -> list[str]:
    """Return what limits the answer of a surface, the gravest first.

    Parameters
    ----------
    basis : str
        "measured" or "substitute".
    spectra, edges, force : xarray.Dataset
        Parts of spectra.nc, edges.nc and force.nc of the surface; force.nc may have
        `finite_scan_note`, what the size of the scans leaves out.

    Returns
    -------
    list of str
        A sentence each.
    """
    found = [*_of_basis(basis)]
    for side in SIDES:
        found += _of_edge(EDGES[side], edges.sel(side=side), is_open(edges, side))
    found += artificial_edges(spectra, edges)
    found += _of_scan_size(force)
    found += _of_intervals(edges, force)
    return [*found, *_of_spectrum(spectra)]


def artificial_edges(spectra: xr.Dataset, edges: xr.Dataset) -> list[str]:
    """Return which edges of the band of a surface, or their intervals, lie where no scan reaches.

    Parameters
    ----------
    spectra, edges : xarray.Dataset
        Parts of spectra.nc and edges.nc of the surface.

    Returns
    -------
    list of str
        A sentence each.
    """
    bands = artificial_bands(spectra)
    return [
        sentence
        for side, name in EDGES.items()
        for sentence in _of_artificial_edge(name, edges.sel(side=side), bands)
    ]


def _of_basis(basis: str) -> list[str]:
    if basis != "substitute":
        return []
    return [
        "The surface is a substitute: its scans are synthesised from published statistics, not "
        "measured."
    ]


def _of_edge(name: str, of_side: xr.Dataset, is_open_edge: bool) -> list[str]:
    """Return that an edge, or an end of its interval, lies beyond what was computed."""
    if is_open_edge:
        return [f"{name} is open: {of_side['edge_text'].item()}."]
    ends = {"low": "shorter", "high": "longer"}
    return [
        f"{name} may lie at {words} wavelengths than were computed: its interval is open there."
        for bound, words in ends.items()
        if of_side["interval_status"].sel(bound=bound).item() == "open"
    ]


def _of_artificial_edge(
    name: str, of_side: xr.Dataset, bands: list[tuple[float, float]]
) -> list[str]:
    """Return that an edge, its bound or part of its interval lies where no scan is reliable."""
    edge = float(of_side["edge"].fillna(of_side["edge_bound"]))
    if share_inside(edge, edge, bands):
        return [
            f"{name} lies at wavelengths where roughness is artificial, as no scan is reliable "
            "there: it says more about how the spectrum is continued than about the surface."
        ]
    low, high = of_side["edge_interval"].fillna(edge).values
    if share_inside(low, high, bands):
        return [f"The interval of {name[0].lower()}{name[1:]} reaches into artificial roughness."]
    return []


def _of_scan_size(force: xr.Dataset) -> list[str]:
    note = str(force["finite_scan_note"].item()) if "finite_scan_note" in force else ""
    return [note] if note else []


def _of_intervals(edges: xr.Dataset, force: xr.Dataset) -> list[str]:
    """Return that intervals are conditional on the scans at hand, or that there are none."""
    return [
        f"{name}: {part['interval_note'].item()}."
        for name, part, interval in (
            ("Intervals of the band", edges, "scale_ratio_interval"),
            ("Interval of the mean force", force, "force_interval"),
        )
        if part["conditional"].item() or not np.isfinite(part[interval]).any()
    ]


def _of_spectrum(spectra: xr.Dataset) -> list[str]:
    """Return what bounds the reliable wavelengths, what lies beyond, and which tips are unknown."""
    known = reliable_measurements(spectra)
    finest = known.isel(measurement=int(known["shortest_reliable"].values.argmin()))
    widest = known.isel(measurement=int(known["longest_reliable"].values.argmax()))
    found = [
        f"Roughness below {print_length(finest['shortest_reliable'].item())} is artificial; this "
        f"limit is set by: {finest['shortest_reason'].item()} ({measurement_name(finest)}).",
        f"Roughness above {print_length(widest['longest_reliable'].item())} is artificial; this "
        f"limit is set by: {widest['longest_reason'].item()} ({measurement_name(widest)}).",
    ]
    note = str(spectra["tail_note"].item())
    found += [f"How the spectrum is continued where no scan is reliable: {note}."] if note else []
    unknown = known.isel(measurement=np.isnan(known["tip_radius"].values))
    names = [
        measurement_name(unknown.isel(measurement=one))
        for one in range(unknown.sizes["measurement"])
    ]
    if names:
        more = f" and {len(names) - NAMED} more" if len(names) > NAMED else ""
        found.append(
            "What a blunt tip hides is not known where no tip radius is stated: "
            f"{', '.join(names[:NAMED])}{more}."
        )
    return found


def measurement_name(one: xr.Dataset) -> str:
    """Return the file of a measurement and, if it is a container, the dataset in it."""
    path, dataset = (str(one[name].item()) for name in ("path", "dataset"))
    return f"{path}: {dataset}" if dataset else path
