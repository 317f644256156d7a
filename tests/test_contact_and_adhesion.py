"""Contact and the force sum against the direct sum over every pixel pair."""

import numpy as np
import pytest

from hardcontact import adhesion, contact, sphere

RADIUS = 250e3  # nm


def periodic_surface(pixels, rms, seed):
    """Periodic noise with some correlation, (pixels, pixels) in nm."""
    rng = np.random.default_rng(seed)
    noise = np.fft.rfft2(rng.standard_normal((pixels, pixels)))
    order = np.hypot(np.fft.fftfreq(pixels)[:, None], np.fft.rfftfreq(pixels)) * pixels
    heights = np.fft.irfft2(noise / (1 + (order / 3) ** 2), s=(pixels, pixels))
    return heights / heights.std() * rms


def direct(substrate, roughness, position, pixel_size, window, touching, rho):
    gaps = contact.gap_map(substrate, position, pixel_size, RADIUS, window, roughness)
    return touching + adhesion.direct_sum(gaps, touching, rho), gaps


CASES = [
    # pixels, pixel size, rms, roughness pixels, window: tiles that fit and tiles that do not
    (128, 40.0, 20.0, 128, 320),
    (100, 50.0, 3.0, 100, 250),
    (96, 50.0, 60.0, 70, 200),
    (256, 20.0, 10.0, 256, 200),
]


@pytest.mark.parametrize("case", CASES)
@pytest.mark.parametrize("touching", [1, 9, 90, 4097, 9000])
def test_lowest_gaps_are_those_of_the_whole_window(case, touching):
    pixels, pixel_size, rms, period, window = case
    substrate, roughness = periodic_surface(pixels, rms, 1), periodic_surface(period, 0.5, 2)
    positions = sphere.contact_positions(pixels, 3)
    found = contact.all_lowest_gaps(
        substrate, positions, pixel_size, RADIUS, window, touching, roughness
    )
    for (i, j), (gaps, offsets) in found.items():
        position = positions[[i, j]]
        _, whole = direct(substrate, roughness, position, pixel_size, window, touching, 1.0)
        np.testing.assert_allclose(gaps, np.sort(whole.ravel())[:touching], atol=1e-9)
        places = whole[tuple((offsets + window // 2).T)]
        np.testing.assert_allclose(places, gaps, atol=1e-9)
        assert len(np.unique(offsets, axis=0)) == touching


@pytest.mark.parametrize("case", CASES)
@pytest.mark.parametrize("touching", [1, 17])
def test_rough_sphere_force_is_the_direct_sum(case, touching):
    pixels, pixel_size, rms, period, window = case
    substrate, roughness = periodic_surface(pixels, rms, 3), periodic_surface(period, 0.7, 4)
    positions, rhos = sphere.contact_positions(pixels, 3), [0.5, 2.0, 10.0]
    arguments = (pixel_size, RADIUS, window)
    contacts = contact.all_lowest_gaps(substrate, positions, *arguments, touching, roughness)
    outside = adhesion.rough_sphere_sums(
        substrate, roughness, positions, contacts, *arguments, rhos
    )
    for k, rho in enumerate(rhos):
        for (i, j), (gaps, _) in contacts.items():
            args = (substrate, roughness, positions[[i, j]], pixel_size, window)
            assert outside[k, i, j] + touching == pytest.approx(
                direct(*args, touching, rho)[0], rel=1e-9
            )
            assert adhesion.rough_total(outside[k, i, j], gaps, 1, rho) == pytest.approx(
                direct(*args, 1, rho)[0], rel=1e-9
            )


@pytest.mark.parametrize("case", CASES)
@pytest.mark.parametrize("touching", [1, 9])
def test_smooth_sphere_force_is_the_direct_sum(case, touching):
    pixels, pixel_size, rms, _, window = case
    substrate, flat = periodic_surface(pixels, rms, 5), np.zeros((1, 1))
    positions, rho = sphere.contact_positions(pixels, 3), 5.6
    sums, h_max = adhesion.smooth_sphere_sums(substrate, positions, pixel_size, RADIUS, window, rho)
    contacts = contact.all_lowest_gaps(substrate, positions, pixel_size, RADIUS, window, touching)
    for (i, j), (gaps, _) in contacts.items():
        expected, _ = direct(substrate, flat, positions[[i, j]], pixel_size, window, touching, rho)
        assert adhesion.plastic_total(sums[i, j], h_max, gaps, rho) == pytest.approx(
            expected, rel=1e-12
        )


@pytest.mark.parametrize("case", CASES)
def test_rough_sphere_force_at_every_load_is_the_direct_sum(case):
    # The sums made for the largest load hold those of all smaller ones.
    pixels, pixel_size, rms, period, window = case
    substrate, roughness = periodic_surface(pixels, rms, 10), periodic_surface(period, 0.7, 11)
    positions, most = sphere.contact_positions(pixels, 2), 24
    arguments = (pixel_size, RADIUS, window)
    contacts = contact.all_lowest_gaps(substrate, positions, *arguments, most, roughness)
    rhos = [0.5, 5.6]
    outside = adhesion.rough_sphere_sums(
        substrate, roughness, positions, contacts, *arguments, rhos
    )
    for (i, j), (gaps, _) in contacts.items():
        whole = contact.gap_map(substrate, positions[[i, j]], pixel_size, RADIUS, window, roughness)
        for count in range(1, most + 1):
            for rho, sums in zip(rhos, outside[:, i, j], strict=True):
                assert adhesion.rough_total(sums, gaps, count, rho) == pytest.approx(
                    count + adhesion.direct_sum(whole, count, rho), rel=1e-9
                )


@pytest.mark.parametrize("case", CASES)
@pytest.mark.parametrize("rough", [False, True])
def test_several_loads_at_once_are_each_load_alone(case, rough):
    pixels, pixel_size, rms, period, window = case
    substrate = periodic_surface(pixels, rms, 12)
    roughness = periodic_surface(period, 0.7, 13) if rough else None
    positions, rho, loads = sphere.contact_positions(pixels, 3), 5.6, [9, 1, 40]
    arguments = (substrate, roughness, positions, pixel_size, RADIUS, window)
    totals = adhesion.plastic_totals(*arguments, loads, rho)
    assert totals.shape == (3, 3, 3)
    seen = np.zeros((1, 1)) if roughness is None else roughness
    for touching, of_load in zip(loads, totals, strict=True):
        alone = adhesion.plastic_totals(*arguments, [touching], rho)
        np.testing.assert_allclose(of_load, alone[0], rtol=1e-9)
        for i, j in np.ndindex(3, 3):
            place = (substrate, seen, positions[[i, j]], pixel_size, window, touching, rho)
            assert of_load[i, j] == pytest.approx(direct(*place)[0], rel=1e-9)


def test_touching_image_pixels_are_counted_once_each():
    # One peak that the window holds several times: its images touch too, and must stay apart.
    substrate = np.zeros((64, 64))
    substrate[10, 10] = 1000.0
    flat, touching, rho = np.zeros((64, 64)), 3, 2.0
    positions = np.array([42, 0])
    arguments = (40.0, RADIUS, 256)
    contacts = contact.all_lowest_gaps(substrate, positions, *arguments, touching, flat)
    outside = adhesion.rough_sphere_sums(substrate, flat, positions, contacts, *arguments, [rho])
    for i, j in contacts:
        expected, _ = direct(substrate, flat, positions[[i, j]], 40.0, 256, touching, rho)
        assert outside[0, i, j] + touching == pytest.approx(expected, rel=1e-12)


def test_smooth_rigid_limit_is_two_pi_r_w():
    # Eq. 3 on a flat: the sum becomes the integral 2 pi R rho, whatever rho. 72.7 uN.
    pixel_size, work = 25.0, 46.3e-3
    window = sphere.window_pixels(12500, pixel_size)
    for rho in (0.5, 2.0, 5.6):
        sums, h_max = adhesion.smooth_sphere_sums(
            np.zeros((250, 250)), np.array([60]), pixel_size, RADIUS, window, rho
        )
        force = adhesion.pull_off_force(
            adhesion.plastic_total(sums[0, 0], h_max, np.zeros(1), rho), rho, pixel_size, work
        )
        assert force == pytest.approx(2 * np.pi * RADIUS * 1e-9 * work, rel=1e-4)
        assert force == pytest.approx(72.7e-6, rel=1e-3)


def test_contact_pixel_count_is_the_load_over_hardness_and_pixel_area():
    assert contact.contact_pixel_count(10e-6, 25e9, 2500 / 512) == 17  # 16.8 rounded up
    assert contact.contact_pixel_count(10e-6, 25e9, 5000 / 8192) == 1074  # 1073.7
    assert contact.contact_pixel_count(10e-6, 25e9, 20.0) == 1  # exactly one pixel


def test_plastic_contact_has_exactly_the_pixels_that_carry_the_load():
    substrate = periodic_surface(128, 20.0, 6)
    gaps, _ = contact.lowest_gaps(contact.Tiles.of(substrate), (50, 70), 40.0, RADIUS, 320, 33)
    whole = contact.gap_map(substrate, (50, 70), 40.0, RADIUS, 320, np.zeros((1, 1)))
    assert np.count_nonzero(whole <= gaps[-1]) == 33


def test_force_decays_with_the_range_of_adhesion_on_parting():
    force = adhesion.force_separation(1e-6, 5.6, [0.0, 5.6])
    np.testing.assert_allclose(force, [-1e-6, -1e-6 / np.e])


def test_results_do_not_depend_on_threads():
    substrate = periodic_surface(512, 20.0, 7).astype(np.float32)
    positions = sphere.contact_positions(512, 5)
    one, two = (
        adhesion.smooth_sphere_sums(substrate, positions, 10.0, RADIUS, 800, 5.6, threads)[0]
        for threads in (1, 2)
    )
    np.testing.assert_array_equal(one, two)


def test_a_sum_out_of_range_is_an_error_not_a_number():
    with pytest.raises(ValueError, match="too small"):
        adhesion.pull_off_force(np.array([1.0, np.nan]), 0.01, 5.0, 1.0)


@pytest.mark.parametrize("pixels", [3, 4, 9])
def test_part_around_the_lowest_point_ends_at_the_edges(pixels):
    size, before = 9, pixels // 2
    for y, x in np.ndindex(size, size):
        gap = np.arange(1.0, size**2 + 1).reshape(size, size)
        gap[y, x] = 0.0
        part = contact.around_lowest(gap, pixels)
        assert part.shape == (pixels, pixels)
        place = np.unravel_index(part.argmin(), part.shape)
        for index, at in zip((y, x), place, strict=True):
            to_the_end = size - index
            assert at == max(min(before, index), pixels - to_the_end)
        rows = gap[y - place[0] : y - place[0] + pixels]
        np.testing.assert_array_equal(part, rows[:, x - place[1] : x - place[1] + pixels])
