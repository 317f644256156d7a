"""Force maps of random scans."""

from functools import cache

import xarray as xr
from paper_numbers import LABELS, SUBSTRATES
from periodic_maps import height_map, periodic_noise

from figure_inputs.building import RADIUS, SCANS
from hardcontact.insight.scan_maps import MapSettings, force_maps
from hardcontact.insight.surface_maps import maps_of_scans
from hardcontact.surfaces.topography import mirror_stitch

SETTINGS: MapSettings = {
    "radius": RADIUS,
    "contact": {"window": 3000.0, "count": 4},
    "ranges": [2.0, 5.6],
    "reference_rho": 5.6,
    "tolerance": 0.05,
    "confidence": 0.9,
}
RMS = [3.0, 6.0, 12.0, 24.0]  # nm, of the substrates


def maps() -> xr.Dataset:
    """Return the maps of three scans a surface, 32 pixels along an edge."""
    return _computed().copy(deep=True)


@cache
def _computed() -> xr.Dataset:
    scans = {
        (surface, scan): force_maps(
            mirror_stitch(height_map(periodic_noise(64, rms, scan)[:32, :32], 20.0)), SETTINGS
        )
        for surface, rms in zip(SUBSTRATES, RMS, strict=True)
        for scan in range(1, SCANS + 1)
    }
    named = {"label": ("surface", LABELS), "basis": ("surface", ["substitute"] * len(LABELS))}
    return maps_of_scans(scans, SETTINGS).assign(named)
