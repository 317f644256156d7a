"""How often the long edge, from a scan and the spectrum measured on it, is inside its interval."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from hardcontact.adhesion.all_surfaces import stacked_forces, with_spectrum_shifts
from hardcontact.contact.contact import Contact
from hardcontact.numbers.random import generator
from hardcontact.own_surfaces.master_forces import Masters
from hardcontact.own_surfaces.open_edges import band_edges
from hardcontact.scales.filtered_masters import Filters, filtered_pull_off
from hardcontact.surfaces.height_map import HeightMap, level, mirror_stitch
from hardcontact.surfaces.joined_spectrum import drawn_spectra, joined_spectrum
from hardcontact.surfaces.scans import Measurement
from hardcontact.surfaces.spectrum import self_affine, spectrum_from
from hardcontact.surfaces.synthesis import large_scale_master, random_surface

pytestmark = pytest.mark.study

SIZE, PIXELS, TILES, REALIZATIONS = 2500.0, 64, 4, 4
PIXEL_SIZE, CELL = SIZE / PIXELS, 2 * TILES * SIZE
CUTOFFS = np.geomspace(300, 14_000, 12).tolist()
CONTACT = Contact(radius=30e3, preload=2e-6, hardness=25e9, window=5000.0, count=8, range=5.6)
FILTERS = Filters("large", 2 * TILES * PIXELS, CUTOFFS)
#: Roll-off wavelengths, a third and three times the size of a scan, with the plateau in nm⁴.
SURFACES = {SIZE / 3: 1.2e6, 3 * SIZE: 6e8}


def density(rolloff):
    return lambda q: self_affine(q, SURFACES[rolloff], rolloff, 0.8)


def forces(masters):
    """Forces on large-scale masters, by realization, as scales.nc has them."""
    found = {
        ("a", number, "large"): filtered_pull_off(master, FILTERS, [CONTACT]).isel(
            radius=0, load=0, rho=0
        )
        for number, master in enumerate(masters, 1)
    }
    stacked = stacked_forces(found).assign(
        label=("surface", ["a"]), basis=("surface", ["measured"])
    )
    return stacked.assign_attrs(rho=CONTACT.range, sphere_radius=CONTACT.radius)


@cache
def true_edge(rolloff):
    """The edge of the mean over many surfaces as large as a master, each of the true spectrum."""
    surfaces = (
        random_surface(generator(1, number), 2 * TILES * PIXELS, PIXEL_SIZE, density(rolloff))
        for number in range(60)
    )
    edges = band_edges(forces(surfaces), Masters({"a": 60}, TILES), 0.1, 0.95)
    return edges.edge.sel(side="large").item()


def interval(rolloff, number):
    """The interval of the long edge in nm from one scan of a surface; open ends are NaN."""
    surface = random_surface(generator(2, number), 16 * PIXELS, PIXEL_SIZE, density(rolloff))
    heights = surface.heights[:PIXELS, :PIXELS].astype(float)
    scan = level(HeightMap(heights, PIXEL_SIZE, False, "measured"))
    measured = Measurement(
        "a", "", "", "nm", "map", scan.heights, PIXEL_SIZE, 1.0, notes=(), undefined=0
    )
    spectrum = spectrum_from(joined_spectrum([measured], [None]))
    rngs = (generator(3, number, draw) for draw in range(REALIZATIONS))
    of_masters = {
        "as measured": [(spectrum, np.ones(1))] * REALIZATIONS,
        "drawn": [*drawn_spectra(rngs, [measured], [None])],
    }
    of_spectra = (
        forces(
            large_scale_master(
                generator(4, number, draw),
                mirror_stitch(replace(scan, heights=scan.heights * factor)),
                TILES,
                0.4 * SIZE,
                spectrum,
            )
            for draw, (spectrum, (factor,)) in enumerate(used)
        )
        for used in of_masters.values()
    )
    edges = band_edges(with_spectrum_shifts(*of_spectra), Masters({"a": 1}, TILES), 0.1, 0.95)
    return edges.edge_interval.sel(side="large").values.ravel()


@pytest.mark.parametrize("rolloff", SURFACES)
def test_the_interval_of_one_scan_holds_the_long_edge(rolloff):
    edge, trials = true_edge(rolloff), 20
    assert np.isfinite(edge)
    low, high = np.array([interval(rolloff, number) for number in range(trials)]).T
    held = ~(low > edge) & ~(high < edge)
    assert held.sum() >= 18
    assert np.isfinite(low).sum() + np.isfinite(high).sum() >= trials
