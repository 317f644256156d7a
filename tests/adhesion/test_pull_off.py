"""Pull-off of pairs of scans and of filtered masters against the direct sum over every pixel."""

import os
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest
from direct_sum import direct_total
from periodic_maps import RADIUS, height_map, over, periodic_noise

from hardcontact.adhesion.pull_off import mean_pull_off_of_pair, pull_off_of_pair, window_change
from hardcontact.adhesion.traced_contact import traced_contact
from hardcontact.contact.bearing_area import contact_pixel_count
from hardcontact.contact.geometry import bodies, gap_map
from hardcontact.records import dataset, netcdf
from hardcontact.scales.filtered_pull_off import filtered_pull_off, mean_filtered_pull_off
from hardcontact.surfaces.filters import filtered

LOAD = {"preload": 10e-6, "hardness": 25e9}
CONTACT = LOAD | {"window": 4000.0, "count": 3}
LOADS = [
    {"name": "H25GPa-F10uN", "preload": 10e-6, "hardness": 25e9},
    {"name": "H25GPa-F40uN", "preload": 40e-6, "hardness": 25e9},
]
RHOS = [1.0, 5.6]


def pair(seed=1):
    return over(periodic_noise(128, 20.0, seed), periodic_noise(128, 0.5, seed + 1), 8.0, 320, 3)


def direct_force(gap, contact_pixels, rho, pixel_size, work=1.0):
    """Eq. 3 in SI units."""
    pressure = work / (rho * 1e-9)
    return pressure * (pixel_size * 1e-9) ** 2 * direct_total(gap, contact_pixels, rho)


def test_pull_off_of_a_pair_is_the_direct_sum_at_every_contact_and_range():
    arrays, bodies_of_pair = pull_off_of_pair(pair(), LOAD, RHOS), pair()
    forces = arrays.variables["pull_off_force"][1]
    approaches = arrays.variables["closest_approach"][1]
    count = contact_pixel_count(LOAD, 8.0)
    assert forces.shape == (2, 2, 3, 3) and count == 7
    assert arrays.variables["contact_pixels"][1] == [1, count]
    for place in np.ndindex(3, 3):
        gap = gap_map(bodies_of_pair, place)
        for model, contact_pixels in enumerate((1, count)):
            ordered = np.sort(gap, axis=None)
            assert approaches[model][place] == pytest.approx(ordered[contact_pixels - 1], abs=1e-9)
            for k, rho in enumerate(RHOS):
                expected = direct_force(gap, contact_pixels, rho, 8.0)
                assert forces[model, k][place] == pytest.approx(expected, rel=1e-9)
    np.testing.assert_allclose(
        arrays.variables["penetration"][1], approaches[1] - approaches[0], rtol=1e-12
    )


def test_mean_pull_off_of_a_pair_is_the_mean_over_its_contacts_at_each_load():
    means = mean_pull_off_of_pair(pair(), LOADS, RHOS).variables["pull_off_force"][1]
    for load, of_load in zip(LOADS, means, strict=True):
        forces = pull_off_of_pair(pair(), load, RHOS).variables["pull_off_force"][1]
        np.testing.assert_allclose(of_load, forces[1].mean(axis=(1, 2)), rtol=1e-12)


def test_window_change_is_that_of_the_direct_sum():
    pairs = [pair(seed) for seed in (1, 3)]
    count, rho, changes = contact_pixel_count(LOAD, 8.0), 5.6, []
    for one in pairs:
        wider = replace(one, geometry=replace(one.geometry, window=320 + 2 * 128))
        for place in np.ndindex(3, 3):
            narrow, wide = (
                direct_total(gap_map(bodies_of_pair, place), count, rho)
                for bodies_of_pair in (one, wider)
            )
            changes.append(abs(wide / narrow - 1))
    arrays = window_change(iter(pairs), LOAD, rho)
    assert arrays.variables["window_change"][1] == pytest.approx(max(changes), rel=1e-6)


SPHERES = [None, height_map(periodic_noise(96, 0.5, 5), 10.0)]


@pytest.mark.parametrize("sphere", SPHERES)
@pytest.mark.parametrize("side, cutoff", [("small", 100.0), ("large", 400.0), ("small", None)])
def test_filtered_pull_off_is_the_direct_sum_over_the_filtered_master(sphere, side, cutoff):
    master = height_map(periodic_noise(128, 20.0, 4), 8.0)
    parameters = {
        "side": side,
        "cutoff": cutoff,
        "pixels": 160,
        "radius": RADIUS,
        "rho": 5.6,
        "contact": CONTACT,
    }
    arrays = filtered_pull_off(master, sphere, parameters)
    force = arrays.variables["pull_off_force"][1]
    surface = filtered(master, side, cutoff, 160)
    under = bodies(surface, sphere, RADIUS, {"window": 4000.0, "count": 3})
    count = contact_pixel_count(LOAD, under.geometry.pixel_size)
    assert arrays.attributes["contact_pixels"] == count
    for place in np.ndindex(3, 3):
        expected = direct_force(gap_map(under, place), count, 5.6, under.geometry.pixel_size)
        assert force[place] == pytest.approx(expected, rel=1e-9)
    assert arrays.attributes["shortest_wavelength"] == pytest.approx(2 * 6.4)
    assert arrays.attributes["longest_wavelength"] == pytest.approx(1024.0)


@pytest.mark.parametrize("sphere", SPHERES)
@pytest.mark.parametrize("side, end", [("small", 12.8), ("large", 1024.0)])
def test_mean_filtered_pull_off_is_the_mean_of_each_cutoff_and_load(sphere, side, end):
    master, cutoffs = height_map(periodic_noise(128, 20.0, 4), 8.0), [100.0, 400.0]
    common = {"side": side, "radius": RADIUS, "rho": 5.6}
    several = common | {
        "scales": {"pixels": 160, "cutoffs": cutoffs},
        "loads": LOADS,
        "window": 4000.0,
        "count": 3,
    }
    arrays = mean_filtered_pull_off(master, sphere, several)
    unfiltered = arrays.variables["unfiltered_pull_off_force"][1]
    forces = arrays.variables["pull_off_force"][1]
    assert forces.shape == (2, 2)
    assert arrays.variables["unfiltered_wavelength"][1] == pytest.approx(end)
    for cutoff, of_cutoff in zip([None, *cutoffs], [unfiltered, *forces], strict=True):
        for load, force in zip(LOADS, of_cutoff, strict=True):
            one = common | {"cutoff": cutoff, "pixels": 160, "contact": CONTACT | load}
            alone = filtered_pull_off(master, sphere, one).variables["pull_off_force"][1]
            assert force == pytest.approx(alone.mean(), rel=1e-12)


def test_loads_are_selected_by_name(tmp_path):
    arrays = mean_pull_off_of_pair(pair(), LOADS, RHOS)
    netcdf.write(arrays, tmp_path / "loads.nc")
    forces = dataset.read(tmp_path / "loads.nc").pull_off_force
    expected = arrays.variables["pull_off_force"][1]
    np.testing.assert_array_equal(forces.sel(load="H25GPa-F40uN"), expected[1])


def test_traced_contact_is_one_of_the_pair():
    traced = traced_contact(pair(), (1, 2), LOAD, 5.6, 46.3e-3)
    arrays = pull_off_of_pair(pair(), LOAD, [5.6])
    force = 46.3e-3 * arrays.variables["pull_off_force"][1][1, 0, 1, 2]
    assert traced.attributes["pull_off_force"] == pytest.approx(force, rel=1e-9)
    gap, pressure = (traced.variables[name][1] for name in ("gap", "adhesive_pressure"))
    assert gap.shape == pressure.shape == (320, 320)
    assert np.count_nonzero(gap <= 0) == 7
    # Where pixels touch the pressure is the largest there is, W/rho; it adds up to the force.
    assert pressure.max() == pytest.approx(46.3e-3 / 5.6e-9)
    assert pressure.sum(dtype=float) * 64e-18 == pytest.approx(force, rel=1e-5)
    assert traced.variables["force"][1][0] == -traced.attributes["pull_off_force"]


@pytest.mark.parametrize("module", ["adhesion.pull_off", "scales.filtered_pull_off"])
def test_jobs_that_are_run_a_thousand_times_start_with_numpy_and_netcdf_alone(module):
    heavy = ["xarray", "pandas", "scipy", "SurfaceTopography", "matplotlib"]
    code = (
        f"import sys, hardcontact.{module}\n"
        f"print([name for name in {heavy} if name in sys.modules])"
    )
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    run = subprocess.run(
        [sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=True
    )
    assert run.stdout.strip() == "[]"
