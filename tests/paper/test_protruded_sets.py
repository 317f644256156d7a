"""Protrusions in sets: forces on coatings with protrusions, and fits of sets to these forces."""

from dataclasses import replace

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from small_pool import SOURCES, raw_scan

from hardcontact.contact.geometry import bodies
from hardcontact.contact.pull_off import pull_off_forces
from hardcontact.inference.published_fit import Pair, PublishedFit
from hardcontact.paper import protruded_sets
from hardcontact.paper.protruded_sets import (
    compute_protruded_forces,
    empty_protruded_forces,
    fit_protruded_sets,
)
from hardcontact.surfaces.height_map import mirror_stitch
from hardcontact.surfaces.protrusions import Protrusions, PublishedRoughness, add_protrusions

RANGES = np.geomspace(0.5, 20, 9)
PAIR = Pair(5.0, 0.05)


ROUGHNESS = PublishedRoughness(10.0, 0.5, 0.7, 3.0)


@pytest.mark.parametrize("protruded_body", ["uncd", "ruby"])
def test_a_draw_does_not_depend_on_the_other_draws(protruded_body):
    draws = compute_protruded_forces([1, 2], 2, SOURCES, ROUGHNESS, protruded_body)
    draw = compute_protruded_forces([2], 2, SOURCES, ROUGHNESS, protruded_body)
    assert draws["pull_off_force"].sizes == {"draw": 2, "rho": 3, "contact": 2 * 2 * 2}
    xr.testing.assert_equal(draws.sel(draw=[2]), draw)


@pytest.mark.parametrize("protruded_body", ["uncd", "ruby"])
def test_protrusions_without_height_change_no_force(protruded_body, monkeypatch):
    flat_protrusions = Protrusions(density=50.0, height=0.0, width=50.0)
    monkeypatch.setattr(protruded_sets, "sample_protrusions", lambda *_: flat_protrusions)
    draw = compute_protruded_forces([1], 2, SOURCES, ROUGHNESS, protruded_body)
    np.testing.assert_allclose(draw["mean_force_ratio"], 1, rtol=1e-9)


def test_protrusions_of_the_sphere_are_the_same_for_all_coatings_and_keep_their_height():
    ncd_sources = SOURCES._replace(surface="ncd")
    draws = [
        compute_protruded_forces([2], 1, sources, ROUGHNESS, "ruby")
        for sources in (SOURCES, ncd_sources)
    ]
    for name in protruded_sets.PROTRUSION_UNITS:
        assert draws[0][name].item() == draws[1][name].item()
    assert (draws[0]["pull_off_force"] != draws[1]["pull_off_force"]).any()


@pytest.mark.parametrize("sphere_is_bumpy", [False, True])
def test_protrusions_of_the_sphere_act_as_those_of_the_substrate(sphere_is_bumpy):
    """Forces depend on the sum of both heights, whichever surface has them."""
    contact = replace(SOURCES.contact, count=1)
    scan = mirror_stitch(raw_scan(1))
    flat = replace(raw_scan(1), heights=np.zeros((64, 64)))
    protrusions = Protrusions(density=20.0, height=3.0, width=40.0)
    bumps = mirror_stitch(add_protrusions(np.random.default_rng(1), flat, protrusions, 10.0))
    combined_pair = bodies(replace(scan, heights=scan.heights + bumps.heights), None, contact)
    substrate, sphere = (scan, bumps) if sphere_is_bumpy else (bumps, scan)
    # The apex is in the middle of the scan of the sphere, above the position of the contact.
    shift = sphere.pixels // 4 - combined_pair.geometry.positions[0]
    sphere = replace(sphere, heights=np.roll(sphere.heights, (shift, shift), axis=(0, 1)))
    separate_pair = bodies(substrate, sphere, contact)
    forces = [
        pull_off_forces(pair, [contact], SOURCES.ranges) for pair in (combined_pair, separate_pair)
    ]
    np.testing.assert_allclose(forces[0], forces[1], rtol=1e-6)


def test_the_fit_recovers_the_pair_of_the_measured_forces():
    """Forces fall as exp(-m/rho), and the measured forces are made from a known pair."""
    heights = {"smooth": 12.0, "rough": 40.0, "rougher": 70.0}
    curves = {name: 1e-3 * np.exp(-height / RANGES) for name, height in heights.items()}
    measured_forces = {
        name: PAIR[1] * 1e-3 * np.exp(-height / PAIR[0]) for name, height in heights.items()
    }
    forces = pd.DataFrame({"mean_force": measured_forces, "median_force": measured_forces})
    curves["smooth"] = curves["smooth"] * 3  # replaced by the protruded surface
    curves["rough"] = curves["rough"] * 2  # halved by protrusions on the sphere
    sets = xr.Dataset(
        {
            "mean_force": (("set", "surface", "rho"), [list(curves.values())] * 2),
            "sphere_factor": (("surface", "rho"), np.full((3, RANGES.size), 0.5)),
        },
        {"set": [1, 2], "surface": list(heights), "rho": RANGES},
    )
    # Two contacts with this mean on a smooth sphere, which roughness of the sphere halves.
    mean_on_smooth_sphere = 2 * 1e-3 * np.exp(-heights["smooth"] / RANGES)
    smooth = xr.Dataset(
        {
            "pull_off_force": (
                ("draw", "rho", "contact"),
                (mean_on_smooth_sphere[:, None] * [0.5, 1.5])[None],
            ),
            "mean_force_ratio": (("draw", "rho"), np.ones((1, RANGES.size))),
            "protrusion_density": ("draw", [1.0]),
            "protrusion_height": ("draw", [4.0]),
            "protrusion_width": ("draw", [50.0]),
        },
        {"draw": [7], "rho": RANGES},
        {"surface": "smooth"},
    )
    halved = smooth.assign(mean_force_ratio=smooth["mean_force_ratio"] / 2).assign_attrs(
        surface="rough"
    )
    protruded = [smooth, halved]
    fits = fit_protruded_sets(protruded, "smooth", sets, PublishedFit(forces, PAIR)).sel(draw=7)
    np.testing.assert_allclose(fits["range_of_adhesion"], PAIR[0], rtol=0.01)
    np.testing.assert_allclose(fits["work_of_adhesion"], PAIR[1], rtol=0.03)
    np.testing.assert_allclose(fits["mean_force_at_fit"], measured_forces["smooth"], rtol=0.03)
    assert fits["agrees"].values.tolist() == [1, 1]
    forces.loc["smooth", "median_force"] /= 3  # the median of two contacts is their mean
    fits_of_skewed = fit_protruded_sets(protruded, "smooth", sets, PublishedFit(forces, PAIR))
    assert fits_of_skewed["agrees"].values.tolist() == [[0, 0]]
    assert fits["mean_force_at_published"].item() == pytest.approx(
        measured_forces["smooth"], rel=1e-3
    )
    assert fits["log_force_std_at_published"].item() == pytest.approx(np.log(3) / 2)
    fits_of_no_draw = fit_protruded_sets(
        [empty_protruded_forces("smooth", RANGES)], "smooth", sets, PublishedFit(forces, PAIR)
    )
    assert fits_of_no_draw["agrees"].sizes == {"draw": 0, "set": 2}
