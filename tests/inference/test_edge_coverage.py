"""Intervals from one scan contain the edges of the mean over many surfaces of its spectrum."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from measurements import cut_scan

from hardcontact.base.arrays import generator
from hardcontact.base.dataset import stack
from hardcontact.contact.contact import Contact
from hardcontact.inference.edges_of_scans import edges_of_scans
from hardcontact.inference.forces_on_masters import (
    Filters,
    add_force_ratios,
    add_spectrum_shifts,
    filtered_pull_off,
)
from hardcontact.inference.mean_forces import MasterScans
from hardcontact.scans.joined_spectrum import joined_spectrum, sample_spectra
from hardcontact.surfaces.height_map import HeightMap, mirror_scan
from hardcontact.surfaces.levelling import level_plane
from hardcontact.surfaces.spectrum import self_affine, smooth_rolloff, spectrum_of_dataset
from hardcontact.surfaces.synthesis import (
    long_edge_master,
    random_surface,
    short_edge_master,
)

SIZE = 2500.0
CONTACT = Contact(
    radius=30e3, preload=2e-6, hardness=25e9, window=2500.0, contacts_per_row=4, rho=5.6
)


def forces(masters, contact):
    """Return the forces on masters as in filtered_forces.nc, by realization and side."""
    filtered = {
        ("a", number, filters.side): filtered_pull_off(master, filters, [contact]).isel(
            radius=0, loading=0, rho=0, drop=True
        )
        for number, filters, master in masters
    }
    filtered_forces = add_force_ratios(stack(filtered, ["surface", "realization", "side"]))
    named_forces = filtered_forces.assign(
        label=("surface", ["A"]), source=("surface", ["measured"])
    )
    return named_forces.assign_attrs(rho=contact.rho, sphere_radius=contact.radius)


def assert_contained(low, high, edge, finite):
    """Expect nine of ten intervals to contain the edge, and a number of finite ends."""
    assert (~(low > edge) & ~(high < edge)).mean() >= 0.9
    # An interval that is open on both sides would hold anything.
    assert np.isfinite(low).sum() + np.isfinite(high).sum() >= finite


# Both edges, of a spectrum that is known

#: Factors of sqrt(2), to more than a factor of three beyond both edges: ends of intervals are
#: cutoffs, so that fewer of them would widen every interval, or bound it where they end.
SHORT_FILTERS = Filters("short", 256, [43.0, 60.0, 85.0, 120.0, 170.0, 240.0, 340.0, 480.0])
LONG_FILTERS = Filters("long", 128, [200.0, 280.0, 400.0, 560.0, 800.0, 1130.0, 1600.0, 2260.0])
#: Edges in nm of the mean over 300 other scans, by `edges_of_scans` of the draws 1000 to 1299;
#: 95 % of 2000 samples of these scans with replacement give 135 to 138 nm and 671 to 705 nm.
TRUE_EDGES = {"short": 137.0, "long": 688.0}


def known_density(wavevector):
    """C_iso in nm4: rms height 2.5 nm."""
    return smooth_rolloff(wavevector, 1e6, 740.0, 0.9)


@cache
def edges_of_draw(draw):
    """Return the edges from the masters of one scan."""
    rng = generator(11, draw)
    surface = random_surface(rng, 256, SIZE / 64, known_density)
    mirrored = mirror_scan(level_plane(cut_scan(surface, 64)))
    short = short_edge_master(rng, mirrored, 256, 160.0, known_density)
    long = long_edge_master(rng, mirrored, 1, 1000.0, known_density)
    filtered_forces = forces([(1, SHORT_FILTERS, short), (1, LONG_FILTERS, long)], CONTACT)
    master_scans = MasterScans({"a": 1}, 1, {"a": 99})
    return edges_of_scans(filtered_forces, None, master_scans, 0.1, 0.95).isel(surface=0)


@pytest.mark.study
@pytest.mark.parametrize("filters", [SHORT_FILTERS, LONG_FILTERS], ids=TRUE_EDGES)
def test_the_interval_from_one_scan_contains_the_edge_of_the_mean(filters):
    true_edge = TRUE_EDGES[filters.side]
    edges = [edges_of_draw(draw).sel(side=filters.side) for draw in range(20)]
    low, high = np.array([edge.edge_interval.values for edge in edges]).T
    assert_contained(low, high, true_edge, finite=24)
    assert np.nanmedian(high) < 3 * true_edge and np.nanmedian(low) > true_edge / 3
    # No end lies outside the cutoffs, and none is the edge itself.
    ends = np.array([[edge.edge.item(), *edge.edge_interval.values] for edge in edges])
    finite_ends = ends[np.isfinite(ends)]
    assert (finite_ends >= filters.cutoffs[0]).all() and (finite_ends <= filters.cutoffs[-1]).all()
    assert not (ends[:, 1:] == ends[:, :1]).any()


# The long edge, of a spectrum that is measured on the scan

PIXELS, TILES, REALIZATIONS = 64, 4, 4
PIXEL_SIZE = SIZE / PIXELS
LONG = Filters("long", 2 * TILES * PIXELS, np.geomspace(300, 14_000, 12).tolist())
WIDE = replace(CONTACT, window=5000.0, contacts_per_row=8)
#: The edge (nm) of the mean over 60 surfaces of the true spectrum, as large as a master.
LONG_EDGE = 1052.0


def wide_density(wavevector):
    """C_iso in nm4 whose roll-off is three times the size of a scan, so that no scan shows it."""
    return self_affine(wavevector, 6e8, 3 * SIZE, 0.8)


def interval_of_one_scan(number):
    """Return the interval of the long edge (nm) from one scan; open ends are NaN."""
    surface = random_surface(generator(2, number), 16 * PIXELS, PIXEL_SIZE, wide_density)
    heights = surface.heights[:PIXELS, :PIXELS].astype(float)
    scan = level_plane(HeightMap(heights, PIXEL_SIZE, tip_radius=1.0))
    measurements = [scan]
    spectrum = spectrum_of_dataset(joined_spectrum(measurements, [None]))
    rngs = (generator(3, number, draw) for draw in range(REALIZATIONS))

    def filtered_forces(spectra):
        """Return the forces on masters of spectra, each with a factor on the heights."""
        masters = (
            long_edge_master(
                generator(4, number, draw),
                mirror_scan(replace(scan, heights=scan.heights * factor)),
                TILES, 0.4 * SIZE, master_spectrum,
            )
            for draw, (master_spectrum, (factor,)) in enumerate(spectra)
        )  # fmt: skip
        return forces(((draw, LONG, master) for draw, master in enumerate(masters, 1)), WIDE)

    measured_forces = filtered_forces([(spectrum, np.ones(1))] * REALIZATIONS)
    sampled_forces = filtered_forces(sample_spectra(rngs, measurements, [None]))
    shifted_scales = add_spectrum_shifts(measured_forces, sampled_forces)
    master_scans = MasterScans({"a": 1}, TILES, {"a": 99})
    edges = edges_of_scans(shifted_scales, None, master_scans, 0.1, 0.95)
    return edges.edge_interval.sel(side="long").values.ravel()


@pytest.mark.study
def test_the_interval_from_one_scan_and_its_spectrum_contains_the_long_edge():
    low, high = np.array([interval_of_one_scan(number) for number in range(8)]).T
    assert_contained(low, high, LONG_EDGE, finite=8)
