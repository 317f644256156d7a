"""Force of repeated contact against the direct sum, and against the study's single contacts."""

import numpy as np
import pytest
from direct_sum import direct_total
from known_spectra import rough
from periodic_maps import over, periodic_noise

from hardcontact.adhesion.pull_off import plastic_totals
from hardcontact.contact.geometry import gap_map
from hardcontact.insight.repeated_contact import (
    LARGEST,
    Adhesion,
    indents_at_random_places,
    large_surface,
    repeated_contact,
    repeated_forces,
    repeated_totals,
)

CASES = {  # pixels of substrate and roughness, window
    "periods like the study's": (128, 128, 320),
    "periods that differ": (128, 100, 320),
    "window smaller than a period": (128, 128, 96),
}


def places(bodies):
    return np.stack(np.meshgrid(*[bodies.geometry.positions] * 2, indexing="ij"), -1).reshape(-1, 2)


@pytest.mark.parametrize("case", CASES)
@pytest.mark.parametrize("rho", [1.0, 5.6])
def test_every_force_is_the_direct_sum_over_the_indented_sphere(case, rho):
    pixels, period, window = CASES[case]
    bodies = over(periodic_noise(pixels, 5.0, 1), periodic_noise(period, 0.5, 2), 20.0, window, 3)
    sums = repeated_totals(bodies, places(bodies), 40, rho)
    before = np.zeros((window, window))
    for place, (total, indentation) in zip(np.ndindex(3, 3), sums, strict=True):
        gap = gap_map(bodies, place) + before
        assert total == pytest.approx(direct_total(gap, 40, rho), rel=1e-11)
        before = indentation.depth.copy()


@pytest.mark.parametrize("rough", [False, True])
def test_the_first_force_is_that_of_the_single_contact(rough):
    roughness = periodic_noise(100, 0.5, 2) if rough else None
    bodies = over(periodic_noise(128, 5.0, 1), roughness, 20.0, 320, 2)
    single = plastic_totals(bodies, [40], 5.6)[0].ravel()
    first = [
        next(iter(repeated_totals(bodies, [position], 40, 5.6)))[0] for position in places(bodies)
    ]
    np.testing.assert_allclose(first, single, rtol=1e-12)


LOAD = {"preload": 10e-6, "hardness": 25e9}


def small_pair(seed, rms=3.0):
    rough, smooth = periodic_noise(64, rms, seed), periodic_noise(64, 0.3, 50 + seed)
    return over(rough, smooth, 10.0, 128, 3)


def of_pair(seed, orders=2):
    pair, rng = small_pair(seed), np.random.default_rng(seed)
    forces = repeated_forces(pair, LOAD, Adhesion(5.6, 0.05), rng, orders)
    return forces.merge(indents_at_random_places(pair, LOAD, rng, 9))


def test_an_order_begins_with_the_single_contact_and_visits_every_place_once():
    forces = of_pair(1)
    np.testing.assert_allclose(
        forces.pull_off_force[:, 0], forces.single_pull_off_force[:, 0], rtol=1e-12
    )
    single = np.sort(forces.single_pull_off_force, axis=1)
    np.testing.assert_array_equal(single[0], single[1])
    assert len(np.unique(single[0])) == 9


def test_a_flat_under_a_smooth_sphere_keeps_its_force_and_its_indent():
    pair = over(np.zeros((64, 64)), None, 10.0, 128, 3)
    rng = np.random.default_rng(1)
    flat = repeated_forces(pair, LOAD, Adhesion(5.6, 0.05), rng, 1)
    np.testing.assert_allclose(flat.pull_off_force, flat.single_pull_off_force, rtol=1e-10)
    indented = indents_at_random_places(pair, LOAD, rng, 9)
    assert (indented.indented_area == indented.indented_area[0]).all()
    assert (indented.indents == 1).all()
    np.testing.assert_allclose(indented.separate_share, 1 / indented.stage)


def test_indents_grow_and_their_map_holds_the_deepest():
    indented = of_pair(2)
    for name in ("depth", "indented_area"):
        assert (indented[name].diff("stage") >= 0).all()
    last = indented.isel(stage=-1)
    assert indented.indentation.max() == last.depth == indented.indent_depth.max()
    assert last.median_size == np.median(indented.indent_size) and last.separate_share <= 1
    assert indented.indented_area[0] <= 4 * 100.0  # four contact pixels of 10 nm
    assert indented.stage.values.tolist()[:2] == [1, 2] and indented.stage[-1] == 9


def test_a_large_surface_has_pixels_of_the_scan_and_a_limit():
    surface = large_surface(np.random.default_rng(1), rough(4, 500, 0.8, 40), 1000.0, 10.1)
    assert (surface.pixels, surface.pixel_size) == (100, 10.1) and surface.periodic
    huge = large_surface(np.random.default_rng(1), rough(4, 500, 0.8, 40), 1e9, 10.0)
    assert huge.pixels == LARGEST


def test_summary_of_scans():
    described = {"labels": {"a": "A"}, "basis": {"a": "substitute"}}
    pairs = {("a", 1e-5, scan): of_pair(scan) for scan in (1, 2, 3)}
    summary = repeated_contact(pairs, described, 0.95)
    whole = [
        float(pair.pull_off_force.sum() / pair.single_pull_off_force.sum())
        for pair in pairs.values()
    ]
    assert summary.mean_ratio.item() == pytest.approx(np.mean(whole))
    low, high = summary.mean_ratio_interval.values.ravel()
    assert low < summary.mean_ratio.item() < high
    # The contacts since the stage before, of all orders.
    stage = int(summary.stage[-1])
    before = int(summary.stage[-2])
    last = [
        float(
            pair.pull_off_force[:, before:stage].sum()
            / pair.single_pull_off_force[:, before:stage].sum()
        )
        for pair in pairs.values()
    ]
    assert summary.force_ratio.isel(stage=-1).item() == pytest.approx(np.mean(last))
    assert summary.force_ratio.isel(stage=0).item() == pytest.approx(1, rel=1e-12)
    depth = np.mean([pair.depth[-1] for pair in pairs.values()])
    assert summary.depth.isel(stage=-1).item() == pytest.approx(depth)
    assert summary.label.values.tolist() == ["A"] and summary.attrs["confidence"] == 0.95


def test_maps_are_of_the_first_scan_of_each_surface_and_preload():
    keys = [("b", 1e-5, 1), ("b", 1e-5, 2), ("a", 1e-5, 1), ("a", 2e-5, 1)]
    pairs = dict(zip(keys, map(of_pair, (1, 2, 3, 1)), strict=True))
    described = {name: {"a": "A", "b": "B"} for name in ("labels", "basis")}
    summary = repeated_contact(pairs, described, 0.95)
    assert summary.surface.values.tolist() == ["b", "a"]
    for surface, preload, scan in (keys[0], *keys[2:]):
        found = summary.indentation.sel(surface=surface, preload=preload)
        expected = pairs[surface, preload, scan].indentation
        assert np.nanmax(found) == expected.max() and np.nansum(found) == expected.sum()
    assert summary.indentation.sel(surface="b", preload=2e-5).isnull().all()
