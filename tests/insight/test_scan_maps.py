"""Datasets of force maps: from single contacts, and their numbers over scans."""

import numpy as np
import pytest
import xarray as xr
from periodic_maps import height_map, periodic_noise
from scipy import stats

from hardcontact.adhesion.pull_off import pull_off_of_pair
from hardcontact.contact.geometry import bodies
from hardcontact.insight.scan_maps import force_maps, rigid_pull_off
from hardcontact.insight.surface_maps import maps_of_scans
from hardcontact.surfaces.topography import mirror_stitch

SETTINGS = {
    "radius": 250e3,
    "contact": {"window": 3000.0, "count": 4},
    "ranges": [2.0, 5.6],
    "reference_rho": 5.6,
    "tolerance": 0.05,
    "confidence": 0.9,
}
LOAD = {"preload": 10e-6, "hardness": 25e9}


def stitched(seed, rms=8.0, pixels=48):
    return mirror_stitch(height_map(periodic_noise(2 * pixels, rms, seed)[:pixels, :pixels], 16.0))


def some_maps(scans=3, settings=SETTINGS):
    surfaces = {"flat": 4.0, "high": 16.0}
    return {
        (name, scan): force_maps(stitched(scan, rms), settings)
        for name, rms in surfaces.items()
        for scan in range(1, scans + 1)
    }


def test_map_of_a_scan_is_that_of_its_contacts():
    scan, one = stitched(1), force_maps(stitched(1), SETTINGS)
    pair = bodies(scan, None, 250e3, SETTINGS["contact"])
    single = pull_off_of_pair(pair, LOAD, [2.0, 5.6])["pull_off_force"].values[0]
    np.testing.assert_allclose(one["contacts_mean"], single.mean(axis=(1, 2)), rtol=1e-12)
    first = pair.geometry.positions[pair.geometry.positions < 48]
    drawn = one["pull_off_force"].values[np.ix_(first, first)]
    np.testing.assert_allclose(drawn, single[1][: len(first), : len(first)], rtol=1e-6)
    np.testing.assert_array_equal(one["heights"], scan.heights[:48, :48].astype("float32"))
    assert float(one["scan_size"]) == 768.0
    mean = one["pull_off_force"].mean(dtype=float)
    assert float(one["map_mean"].sel(rho=5.6)) == pytest.approx(float(mean), rel=1e-6)


def test_distributions_hold_every_force_once():
    one = force_maps(stitched(1), SETTINGS)
    decades = np.diff(np.log10(one["relative_force"])).mean()
    np.testing.assert_allclose(one["distribution"].sum("relative_force") * decades, 1.0)
    (force,) = rigid_pull_off(bodies(stitched(1), None, 250e3, SETTINGS["contact"]), [5.6])
    logarithm = np.log(force / (2 * np.pi * 250e-6)).mean()
    share = one["distribution"].sel(rho=5.6, sample="array of contacts") * decades
    assert float((share * np.log(one["relative_force"])).sum()) == pytest.approx(logarithm, abs=0.1)


def test_contacts_at_random_follow_from_the_variation():
    one = force_maps(stitched(1), SETTINGS)
    error = 0.05 / stats.norm.ppf(0.95)
    needed = one["contacts_needed"].sel(sampling="random")
    np.testing.assert_allclose(needed, (one["variation"] / error) ** 2)
    single = one["array_error"].sel(contacts=1)
    np.testing.assert_allclose(single, one["variation"])


def test_numbers_of_surfaces_are_those_of_their_scans():
    scans = some_maps()
    maps = maps_of_scans(scans, SETTINGS)
    assert maps["heights"].dims == ("surface", "row", "column")
    np.testing.assert_array_equal(
        maps["pull_off_force"].sel(surface="high"), scans["high", 1]["pull_off_force"]
    )
    means = np.array([float(scans["high", scan]["map_mean"].sel(rho=2.0)) for scan in (1, 2, 3)])
    scatter = means.std(ddof=1) / means.mean()
    at = {"surface": "high", "rho": 2.0}
    assert float(maps["between_scans"].sel(at)) == pytest.approx(scatter)
    needed = (scatter * stats.norm.ppf(0.95) / 0.05) ** 2
    assert float(maps["scans_needed"].sel(at)) == pytest.approx(needed)
    within = [float(scans["high", scan]["variation"].sel(rho=2.0)) for scan in (1, 2, 3)]
    worth = 1 + np.mean(np.square(within)) / scatter**2
    assert float(maps["worth_of_scan"].sel(at)) == pytest.approx(worth)
    least, most = maps["worth_of_scan_interval"].sel(at).transpose("bound")
    assert least < worth < most
    low, high = maps["scans_needed_interval"].sel(at).transpose("bound")
    assert needed * 2 / stats.chi2.ppf(0.95, 2) == pytest.approx(float(low))
    assert low < needed < high
    for name in ("variation", "correlation_length", "correlated_places"):
        values = [float(scans["high", scan][name].sel(rho=2.0)) for scan in (1, 2, 3)]
        assert float(maps[name].sel(at)) == pytest.approx(np.mean(values), nan_ok=True)
    assert maps["contacts_needed_interval"].attrs["confidence"] == 0.9
    assert all("units" in variable.attrs for variable in maps.data_vars.values())


def test_a_single_scan_has_no_intervals():
    maps = maps_of_scans(some_maps(1), SETTINGS)
    assert maps["contacts_needed"].sel(sampling="random").notnull().all()
    for name in ("contacts_needed_interval", "scans_needed", "scans_needed_interval"):
        assert maps[name].isnull().all()


def test_surfaces_may_have_different_numbers_of_scans():
    scans = some_maps()
    alone = maps_of_scans({key: one for key, one in scans.items() if key[0] == "high"}, SETTINGS)
    fewer = maps_of_scans({key: scans[key] for key in scans if key != ("flat", 3)}, SETTINGS)
    for name in ("variation", "contacts_needed", "scans_needed", "array_error", "worth_of_scan"):
        xr.testing.assert_allclose(fewer[name].sel(surface="high"), alone[name].sel(surface="high"))
        assert fewer[name].sel(surface="flat", rho=2.0).notnull().any()


def test_pixels_that_touch_are_those_of_the_scan_or_of_its_mirror_images():
    heights = np.zeros((32, 32))
    heights[[3, 28], [20, 9]] = 200.0
    one = force_maps(mirror_stitch(height_map(heights, 16.0)), SETTINGS)
    assert int(one["touched_pixels"]) == 2


def test_scans_of_different_sizes_are_padded():
    scans = {("small", 1): stitched(1, 4.0, 32), ("large", 1): stitched(1, 4.0, 48)}
    maps = maps_of_scans({key: force_maps(one, SETTINGS) for key, one in scans.items()}, SETTINGS)
    small = maps["heights"].sel(surface="small").dropna("row", how="all")
    assert small.sizes["row"] == 32 and maps.sizes["row"] == 48
    assert list(maps["contacts"].values) == sorted(maps["contacts"].values)
