"""Intervals from one scan contain the edges of the mean over many surfaces of its spectrum."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from measurements import cut_scan
from scipy import stats

from hardcontact.base.arrays import generator
from hardcontact.base.dataset import stack
from hardcontact.contact.contact import Contact
from hardcontact.inference.edges import edges_of_shared_scans
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
from hardcontact.surfaces.spectral_models import self_affine, smooth_rolloff
from hardcontact.surfaces.spectrum import spectrum_of_dataset
from hardcontact.surfaces.synthesis import long_edge_master, random_surface, short_edge_master

SIZE = 2500.0  # nm, of a scan
CONTACT = Contact(
    radius=30e3, preload=2e-6, hardness=25e9, window=2500.0, contacts_per_row=4, rho=5.6
)
TOLERANCE = 0.1


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


def ratio_intervals(filtered_forces, tiles):
    """Return the intervals (side, end) of the force ratios at the only cutoff of each side.

    Such an interval contains 1 + TOLERANCE if the interval of the edge contains the cutoff.
    """
    master_scans = MasterScans(scan_counts={"a": 1}, tiles=tiles, touched_patches={"a": 99})
    edges = edges_of_shared_scans(filtered_forces, None, master_scans, TOLERANCE, confidence=0.95)
    return edges.filtered_force_ratio_interval.isel(surface=0).max("cutoff_wavelength")


def assert_contained(intervals):
    """Expect most intervals at the true edge to be bounded and to contain the tolerance."""
    low, high = np.transpose(intervals)
    count = ((low <= 1 + TOLERANCE) & (high >= 1 + TOLERANCE)).sum()
    # Correct intervals fail by chance in one of a hundred runs.
    assert count >= stats.binom.ppf(0.01, len(low), 0.95), (low, high)
    assert np.isfinite(high).mean() >= 0.8


# Both edges, of a spectrum that is known

#: Edges in nm of the mean over 300 other scans, from `edges_of_shared_scans` of the trials 1000 to
#: 1299; 95 % of 2000 samples of these scans with replacement give 135 to 138 nm and 671 to 705 nm.
TRUE_EDGES = {"short": 137.0, "long": 688.0}
FILTERS = {side: Filters(side, 256, [edge]) for side, edge in TRUE_EDGES.items()}


def known_density(wavevector):
    """Return C_iso (nm⁴) of a surface with an rms height of 2.5 nm."""
    return smooth_rolloff(wavevector, plateau=1e6, rolloff=740.0, hurst=0.9)


@cache
def intervals_of_trial(trial):
    """Return the intervals of the force ratios at both true edges from one scan."""
    rng = generator(11, trial)
    surface = random_surface(rng, 256, SIZE / 64, known_density)
    mirrored = mirror_scan(level_plane(cut_scan(surface, 64)))
    short = short_edge_master(rng, mirrored, 256, transition=160.0, spectrum=known_density)
    long = long_edge_master(rng, mirrored, 1, transition=1000.0, spectrum=known_density)
    filtered_forces = forces([(1, FILTERS["short"], short), (1, FILTERS["long"], long)], CONTACT)
    return ratio_intervals(filtered_forces, 1)


@pytest.mark.study
@pytest.mark.parametrize("side", TRUE_EDGES)
def test_the_interval_from_one_scan_contains_the_edge_of_the_mean(side):
    assert_contained([intervals_of_trial(trial).sel(side=side) for trial in range(30)])


# The long edge, of a spectrum that is measured on the scan

PIXELS, TILES, REALIZATIONS = 64, 2, 4
PIXEL_SIZE = SIZE / PIXELS
#: The edge (nm) of the mean over 150 surfaces of the true spectrum, as large as a master; 95 % of
#: samples of these surfaces with replacement give 950 to 1111 nm.
LONG_EDGE = 1027.0
LONG_FILTERS = Filters("long", 2 * TILES * PIXELS, [LONG_EDGE])
WIDE_CONTACT = replace(CONTACT, window=5000.0)


def wide_density(wavevector):
    """Return C_iso (nm⁴) with a roll-off of three times SIZE, so that no scan shows it."""
    return self_affine(wavevector, plateau=6e8, rolloff=3 * SIZE, hurst=0.8)


def interval_of_one_scan(number):
    """Return the interval of the force ratio at the true edge from one scan."""
    surface = random_surface(generator(2, number), 16 * PIXELS, PIXEL_SIZE, wide_density)
    heights = surface.heights[:PIXELS, :PIXELS].astype(float)
    scan = level_plane(HeightMap(heights, PIXEL_SIZE, tip_radius=1.0))
    spectrum = spectrum_of_dataset(joined_spectrum([scan], [None]))
    rngs = (generator(3, number, realization) for realization in range(REALIZATIONS))

    def filtered_forces(spectra):
        """Return the forces on masters of spectra, each with a factor on the heights."""
        masters = (
            long_edge_master(
                generator(4, number, realization),
                mirror_scan(replace(scan, heights=scan.heights * factor)),
                TILES, 0.4 * SIZE, master_spectrum,
            )
            for realization, (master_spectrum, (factor,)) in enumerate(spectra)
        )  # fmt: skip
        numbered_masters = (
            (realization, LONG_FILTERS, master) for realization, master in enumerate(masters, 1)
        )
        return forces(numbered_masters, WIDE_CONTACT)

    measured_forces = filtered_forces([(spectrum, np.ones(1))] * REALIZATIONS)
    sampled_forces = filtered_forces(sample_spectra(rngs, [scan], [None]))
    shifted_forces = add_spectrum_shifts(measured_forces, sampled_forces)
    return ratio_intervals(shifted_forces, TILES).sel(side="long")


@pytest.mark.study
def test_the_interval_from_one_scan_and_its_spectrum_contains_the_long_edge():
    assert_contained([interval_of_one_scan(number) for number in range(16)])
