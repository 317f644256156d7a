"""Forces on filtered masters: against the direct sum, and on a flat surface in closed form."""

from dataclasses import replace

import numpy as np
import pytest
import xarray as xr
from direct_sum import direct_force, gap_of_bodies
from periodic_maps import CONTACT, CONTACTS_BY_LOADING, periodic_map, periodic_noise
from scipy.special import erf

from hardcontact.base.dataset import stack
from hardcontact.contact.contact import Contact
from hardcontact.contact.geometry import join_bodies
from hardcontact.inference.forces_on_masters import Filters, add_force_ratios, filtered_pull_off
from hardcontact.surfaces.filters import filtered_series


def master_forces(forces, cutoffs):
    """Return forces on a master, in the mean over contacts (cutoff,) in N, and 4 N unfiltered."""
    spread = np.array([[0.5, 1.5], [1.0, 1.0]])
    return xr.Dataset(
        {
            "pull_off_force": (
                ("cutoff_wavelength", "contact_y", "contact_x"), np.multiply.outer(forces, spread)
            ),
            "unfiltered_pull_off_force": (("contact_y", "contact_x"), 4 * spread),
            "spectrum_end": 1.0,
        },
        {"cutoff_wavelength": cutoffs},
    )  # fmt: skip


def test_ratios_are_taken_of_mean_forces_over_contacts():
    masters = {
        (surface, realization, side): master_forces([2.0, realization], cutoffs)
        for surface, count in (("a", 1), ("b", 2))
        for realization in range(1, count + 1)
        for side, cutoffs in (("short", [43.0, 20.0]), ("long", [500.0, 1e3]))
    }
    filtered_forces = add_force_ratios(stack(masters, ["surface", "realization", "side"]))
    assert filtered_forces.cutoff_wavelength.values.tolist() == [20.0, 43.0, 500.0, 1e3]
    ratios = filtered_forces.filtered_force_ratio
    empty = [np.nan, np.nan]
    # 2/4 at 43 and 500 nm, realization/4 at 20 nm and 1 µm
    np.testing.assert_array_equal(
        ratios.sel(surface="b").transpose("side", "realization", ...),
        [
            [[0.25, 0.5, *empty], [0.5, 0.5, *empty]],
            [[*empty, 0.5, 0.25], [*empty, 0.5, 0.5]],
        ],
    )
    assert ratios.sel(surface="a", realization=2).isnull().all()


SPHERES = [None, periodic_map(periodic_noise(96, 0.5, 5), 10.0)]


@pytest.mark.parametrize("sphere", SPHERES)
@pytest.mark.parametrize("side, end", [("short", 12.8), ("long", 1024.0)])
def test_the_force_on_every_filtered_master_is_the_direct_sum(sphere, side, end):
    master, cutoffs = periodic_map(periodic_noise(128, 20.0, 4), 8.0), [100.0, 400.0]
    filters = Filters(side, 160, cutoffs)
    dataset = filtered_pull_off(master, filters, CONTACTS_BY_LOADING, sphere).isel(radius=0, rho=0)
    assert dataset["spectrum_end"].item() == pytest.approx(end)
    forces_by_cutoff = [dataset["unfiltered_pull_off_force"], *dataset["pull_off_force"]]
    for cutoff, forces in zip([None, *cutoffs], forces_by_cutoff, strict=True):
        (substrate,) = filtered_series(master, side, [cutoff], 160)
        bodies = join_bodies(substrate, sphere, CONTACT)
        pixel_size = bodies.geometry.pixel_size
        for index in np.ndindex(3, 3):
            gap = gap_of_bodies(bodies, index)
            for contact in CONTACTS_BY_LOADING:
                count = contact.pixel_count(pixel_size)
                direct_sum = direct_force(gap, count, 5.6, pixel_size)
                force = forces.sel(loading=contact.loading_name).values[index]
                # Sums on a smooth sphere are in single precision.
                assert force == pytest.approx(direct_sum, rel=1e-6 if sphere is None else 1e-9)


CONTACTS = [
    Contact(radius=500.0, preload=preload, hardness=25e9, window=640.0, contacts_per_row=3)
    for preload in (2.5e-6, 20e-6)
]
FILTERS = Filters("short", 64, [40.0, 80.0])
RADII_AND_RANGES = ([500.0, 2000.0], [2.0, 5.0])  # nm


def noise_master(rms):
    heights = rms * np.random.default_rng(3).standard_normal((64, 64))
    return periodic_map(heights, 10.0)


def test_a_flat_surface_gives_the_force_of_a_smooth_sphere_at_every_radius_range_and_area():
    forces = filtered_pull_off(noise_master(0.0), FILTERS, CONTACTS, None, *RADII_AND_RANGES)
    mean_force = forces["unfiltered_pull_off_force"].mean(["contact_y", "contact_x"]).values
    radius, rho = (np.array(values) for values in RADII_AND_RANGES)
    radius = radius[:, None]
    # 2 pi R W without the attraction outside the window of 640 nm.
    rigid = 2 * np.pi * radius * 1e-9 * erf(640 / np.sqrt(8 * radius * rho)) ** 2
    np.testing.assert_allclose(mean_force[:, 0], rigid, rtol=2e-3)
    # Eight pixels touch: the apex, its neighbours, and three of the four at the distance sqrt(2).
    gaps = np.array([0, *[100] * 4, *[200] * 3]) / (2 * radius[..., None])
    approach = np.exp(gaps.max(-1) / rho)
    flattened = (np.exp((gaps.max(-1, keepdims=True) - gaps) / rho[:, None]) - 1).sum(-1)
    plastic = approach * rigid - flattened * 100 / rho * 1e-9
    np.testing.assert_allclose(mean_force[:, 1], plastic, rtol=2e-3)


def test_every_combination_equals_its_single_contact():
    forces = filtered_pull_off(noise_master(3.0), FILTERS, CONTACTS, None, *RADII_AND_RANGES)
    single_contact = replace(CONTACTS[1], radius=2000.0, rho=5.0)
    single = filtered_pull_off(noise_master(3.0), FILTERS, [single_contact])
    for name in ("pull_off_force", "unfiltered_pull_off_force"):
        np.testing.assert_allclose(
            forces[name].isel(radius=1, loading=1, rho=1),
            single[name].isel(radius=0, loading=0, rho=0),
        )
    assert forces["contact_area"].values == pytest.approx([100.0, 800.0])
    assert forces["touching_area"].values == pytest.approx([100.0, 800.0])
