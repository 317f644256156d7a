"""Forces on mirrored windows of synthetic surfaces, against the surfaces they are cut out of."""

from dataclasses import replace

import numpy as np
import pytest
import xarray as xr
from measurements import cut_scan

from hardcontact.base.arrays import generator
from hardcontact.contact.contact import Contact
from hardcontact.contact.geometry import join_bodies
from hardcontact.contact.numerical_limits import (
    FINITE_SCAN_RATIOS,
    LARGE_SIZE_RATIO,
    finite_scan_ratio,
)
from hardcontact.contact.pull_off import pull_off_dataset
from hardcontact.own.force_at_pair import add_sizes
from hardcontact.surfaces.height_map import mirror_scan
from hardcontact.surfaces.levelling import level_plane
from hardcontact.surfaces.spectrum import WAVEVECTORS, Spectrum, smooth_rolloff, spectral_moment
from hardcontact.surfaces.synthesis import random_surface
from hardcontact.theory.summits import search_size, spectrum_between

RADIUS, PIXEL = 250e3, 10e3 / 256


def mean_force(surface):
    contact = Contact(radius=RADIUS, preload=10e-6, hardness=25e9, window=10e3, contacts_per_row=4)
    bodies = join_bodies(surface, None, contact)
    return pull_off_dataset(bodies, contact, [5.6])["pull_off_force"].values[1].mean()


def window_over_whole_force(rms_height, pixels):
    """Return the mean force on windows relative to the surfaces of 10 µm they are cut out of."""
    large, small = [], []
    for draw in range(20):
        surface = random_surface(
            generator(5, draw), 256, PIXEL, lambda q: smooth_rolloff(q, 1.0, 930.0, 0.84)
        )
        factor = rms_height / surface.heights.std()
        surface = replace(surface, heights=factor * surface.heights)
        large.append(mean_force(surface))
        small.append(mean_force(mirror_scan(level_plane(cut_scan(surface, pixels)))))
    return np.mean(small) / np.mean(large)


@pytest.mark.parametrize("rms_height, pixels", [(17.0, 32), (17.0, 64), (2.0, 64), (0.3, 64)])
def test_forces_on_windows_exceed_those_on_large_surfaces_as_measured(rms_height, pixels):
    spectrum = Spectrum(WAVEVECTORS, smooth_rolloff(WAVEVECTORS, 1.0, 930.0, 0.84))
    sampled_spectrum = spectrum_between(spectrum, 2 * np.pi / 10e3, np.pi / PIXEL)
    scaled = Spectrum(
        sampled_spectrum.wavevector,
        sampled_spectrum.density * rms_height**2 / spectral_moment(sampled_spectrum, 0),
    )
    minimum, maximum = finite_scan_ratio(pixels * PIXEL, search_size(scaled, RADIUS, 400.0))
    # Twenty windows, whose forces scatter by a factor of two about their mean.
    assert 0.75 * minimum < window_over_whole_force(rms_height, pixels) < 1.25 * maximum


def test_a_large_scan_is_large_enough():
    assert finite_scan_ratio(LARGE_SIZE_RATIO * 3e3, 3e3) == finite_scan_ratio(100.0, 0) == (1, 1)
    assert finite_scan_ratio(0.9 * LARGE_SIZE_RATIO * 3e3, 3e3) == FINITE_SCAN_RATIOS[-1][1]


def test_the_share_of_a_window_matches_the_sum_over_its_pixels():
    rhos, window = np.array([2.0, 20.0, 200.0]), 5e3
    contact = Contact(radius=RADIUS, preload=10e-6, hardness=25e9, window=window)
    sizes = {"scan_size": ("surface", [1000.0]), "pixel_size": ("surface", [10.0])}
    sized_forces = add_sizes(
        xr.Dataset({"search_size": ("surface", [3000.0])}, {"rho": rhos, "surface": ["a"]}),
        xr.Dataset(sizes, {"surface": ["a"]}),
        contact,
    )
    np.testing.assert_array_equal(sized_forces.finite_scan_ratio, [dict(FINITE_SCAN_RATIOS)[0.5]])
    assert (sized_forces.pixel_area.item(), sized_forces.attrs["contact_area"]) == (
        100.0,
        contact.area,
    )
    squared_positions = (np.arange(-40e3, 40e3, 20) + 10) ** 2
    is_inside = np.abs(squared_positions) < (window / 2) ** 2
    for rho, share in zip(rhos, sized_forces.window_share.values, strict=True):
        weight = np.exp(-squared_positions / (2 * RADIUS * rho))
        assert share == pytest.approx((weight[is_inside].sum() / weight.sum()) ** 2, rel=1e-3)
    assert sized_forces.window_share[0] > 0.99 > 0.2 > sized_forces.window_share[-1]
