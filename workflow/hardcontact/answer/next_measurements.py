"""What would narrow the answer of a surface, in words: scans, tips and forces that it lacks."""

from itertools import chain

import numpy as np
import xarray as xr

from hardcontact.adhesion.finite_scan import LARGE_ENOUGH, finite_scan
from hardcontact.answer.artificial import artificial_bands, artificial_words, reliable_measurements
from hardcontact.answer.datasets import Datasets
from hardcontact.answer.limits import DESCRIPTION, FEW_PIXELS, place_of_edge
from hardcontact.answer.sentences import differing_sides, is_open
from hardcontact.numbers.printing import print_length


def next_measurements(of_surface: Datasets) -> list[str]:
    """Return what to measure next, from the parts of one surface and the fit of all."""
    edges, force, spectra = of_surface.edges, of_surface.force, of_surface.spectra
    return list(
        chain(
            _shorter_waves(edges, force, spectra),
            _larger_scans(of_surface.topography, edges, force, spectra),
            _finer_pixels(force),
            _more_places(force),
            _tips(spectra),
            [] if of_surface.fit is not None else [OWN_FORCES],
        )
    )


OWN_FORCES = (
    "Pull-off forces of your own (`--forces`): the predicted force is in proportion to the work of "
    "adhesion, which only they can tell."
)


def _shorter_waves(edges: xr.Dataset, force: xr.Dataset, spectra: xr.Dataset) -> list[str]:
    """Return the wavelengths between short edge and contact scans that no scan shows."""
    edge = edges.sel(side="small")
    shortest = float(np.nanmin([edge["edge_bound"], edge["edge"], *edge["edge_interval"].values]))
    open_below = is_open(edges, "small") or np.isnan(edge["edge_interval"].sel(bound="low"))
    longest = float(force["transition"].sel(side="small"))
    gaps = [
        (max(low, shortest), min(high, longest))
        for low, high in artificial_bands(spectra)
        if max(low, shortest) < min(high, longest)
    ]
    told = "it tells where the short edge lies"
    if "small" in differing_sides(force):
        told += ", and which of both forces holds"
    further = ", and below" if open_below else ""
    return (
        [
            "A map with a sharper tip on a smaller area, or a cross section in an electron "
            f"microscope, that is reliable {artificial_words(gaps)}{further}: {told}."
        ]
        if gaps
        else []
    )


def _larger_scans(
    topography: xr.Dataset, edges: xr.Dataset, force: xr.Dataset, spectra: xr.Dataset
) -> list[str]:
    """Return how wide a map must be to hold the peaks of a contact and the longest waves."""
    size, height = topography["scan_size"].item(), topography["all_scales_rms_height"].item()
    draw_size = finite_scan(size, height, force.attrs["sphere_radius"]).draw_size
    needed = LARGE_ENOUGH * draw_size
    texts = []
    if size < needed:
        texts.append(
            f"A map of {print_length(needed)} or more: as large as contacts need to find their "
            "highest peaks."
        )
    if is_open(edges, "large") or (
        place_of_edge(edges.sel(side="large"), artificial_bands(spectra)) != "outside"
    ):
        texts.append(
            "A larger map, or a long line scan by a stylus: it tells where the long edge lies."
        )
    return texts


def _finer_pixels(force: xr.Dataset) -> list[str]:
    """Return the pixels that resolve the area in contact, if those of the scans do not."""
    area = force.attrs["contact_area"]
    if area >= FEW_PIXELS * force["pixel_area"].item():
        return []
    return [
        f"Pixels of {print_length(np.sqrt(area / FEW_PIXELS))} or less: {FEW_PIXELS} of them then "
        "carry the preload."
    ]


def _more_places(force: xr.Dataset) -> list[str]:
    """Return that scans of other places are needed, if intervals come from parts of a scan."""
    if np.isfinite(force["force_interval"]).all() and not force["conditional"].item():
        return []
    return [
        "Scans of the same size of other places, three in all or more: intervals then follow from "
        "scans that share nothing."
    ]


def _tips(spectra: xr.Dataset) -> list[str]:
    """Return that a tip radius is not stated."""
    known = reliable_measurements(spectra)
    scans = known.isel(measurement=known["kind"].values.astype(str) != DESCRIPTION)
    if np.isfinite(scans["tip_radius"]).all():
        return []
    return [
        "The radius of each tip that a file does not state (`--tip`): what the tip hides is then "
        "not taken for smooth."
    ]
