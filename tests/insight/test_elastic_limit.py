"""Contacts that do not yield: their forces between the limits, their share, the areas solved."""

import numpy as np
import pytest
import xarray as xr
from direct_sum import direct_total
from periodic_maps import RADIUS, over, periodic_noise
from published_contact import MODULUS

from hardcontact.adhesion.pull_off import plastic_totals, pull_off_force
from hardcontact.contact.contact import Contact
from hardcontact.contact.geometry import gap_map
from hardcontact.contact.smooth_sphere import hertz_contact
from hardcontact.insight.elastic_limit import (
    SLOPE_OVER_PRESSURE,
    elastic_limit,
    elastic_limit_of_pair,
    slope_index,
)
from hardcontact.surfaces.spectrum import Spectrum, all_scales_moments

LOAD = Contact(radius=RADIUS, preload=10e-6, hardness=25e9)
PIXEL, RHO, WORK = 10.0, 5.6, 0.05
DESCRIBED = {
    "labels": {"smooth": "Smooth", "rough": "Rough"},
    "basis": {"smooth": "substitute", "rough": "substitute"},
}


def pair(rms, seed):
    return over(periodic_noise(64, rms, seed), periodic_noise(64, 0.3, 50 + seed), PIXEL, 128, 3)


def of_pair(bodies):
    return elastic_limit_of_pair(bodies, LOAD, MODULUS, RHO, WORK)


def test_forces_are_direct_sums_with_each_contact():
    bodies = pair(0.5, 1)
    limit = of_pair(bodies)
    bearing = LOAD.pixels(PIXEL)
    for place in np.ndindex(3, 3):
        one = limit.isel(contact_y=place[0], contact_x=place[1])
        larger = max(bearing, round(one.elastic_area.item() / PIXEL**2))
        recovered = bearing if one.plasticity_index >= 1 else 1
        for variant, count in zip(one.variant.values, (bearing, recovered, larger, 1), strict=True):
            total = direct_total(gap_map(bodies, place), count, RHO)
            expected = pull_off_force(total, RHO, PIXEL, WORK)
            assert one.pull_off_force.sel(variant=variant).item() == pytest.approx(
                expected, rel=1e-10
            )


def test_a_rough_surface_keeps_the_force_of_the_bearing_area():
    bodies = pair(60.0, 2)
    limit = of_pair(bodies)
    assert (limit.plasticity_index >= 1).all()
    (total,) = plastic_totals(bodies, [LOAD.pixels(PIXEL)], RHO)
    single = pull_off_force(total, RHO, PIXEL, WORK)
    for variant in ("bearing_area", "larger_area", "recovered"):
        np.testing.assert_allclose(limit.pull_off_force.sel(variant=variant), single, rtol=1e-12)


def test_a_smooth_sphere_has_the_area_of_hertz_and_the_rigid_force():
    bodies = over(np.zeros((64, 64)), None, PIXEL, 128, 2)
    limit = of_pair(bodies)
    radius = hertz_contact(LOAD.preload, RADIUS, MODULUS).radius
    np.testing.assert_allclose(limit.elastic_area, np.pi * radius**2, rtol=0.03)
    force = limit.pull_off_force
    np.testing.assert_array_equal(force.sel(variant="recovered"), force.sel(variant="rigid"))
    # A cap that Hertz' area cuts off a parabola is a²/2R = 0.07 nm high: exp(0.07/5.6).
    gain = np.exp(radius**2 / (2 * RADIUS) / RHO)
    assert (force.sel(variant="larger_area") <= force.sel(variant="rigid") * gain).all()
    assert (force.sel(variant="larger_area") > force.sel(variant="bearing_area")).all()


def test_every_octave_of_a_fourth_power_adds_the_same_to_the_squared_slope():
    q = np.geomspace(1e-3, 10, 401)
    spectra = {"flat": Spectrum(q, 5 * q**-4.0), "cut": Spectrum(q, 5 * q**-4.0 * (q < 0.1))}
    index = slope_index(spectra, MODULUS, 25e9)
    slope = index * SLOPE_OVER_PRESSURE * 25e9 / MODULUS
    expected = np.sqrt(5 * np.log(q / q[0]) / (2 * np.pi))
    np.testing.assert_allclose(slope.sel(surface="flat")[::-1], expected, rtol=1e-6, atol=1e-9)
    for name, spectrum in spectra.items():
        at_all_scales = all_scales_moments(spectrum)[1]
        assert slope.sel(surface=name)[0] == pytest.approx(at_all_scales)
    cut = slope.sel(surface="cut")
    assert cut.sel(shortest_wavelength=60, method="nearest") == pytest.approx(cut[0])


def solved(pairs):
    """Two contacts a scan whose solved area is twice the estimate; all pressures are low once."""
    places = np.array([[0, 2], [1, 1]])
    parts = {}
    for (surface, scan), one in pairs.items():
        area = 2 * one.elastic_area.values[tuple(places.T)]
        pressure = [20e9, 20e9] if surface == "smooth" else [20e9, 30e9]
        parts[surface, scan] = xr.Dataset(
            {"contact_area": ("contact", area), "mean_pressure": ("contact", pressure)},
            {"contact_y": ("contact", places[:, 0]), "contact_x": ("contact", places[:, 1])},
        )
    stacked = xr.concat(
        [
            xr.concat([parts[surface, scan] for scan in (1, 2, 3)], "scan")
            for surface in ("smooth", "rough")
        ],
        "surface",
    )
    names = {"surface": ["smooth", "rough"], "scan": [1, 2, 3]}
    return stacked.assign_coords(names).assign_attrs(hardness=25e9)


def test_shares_and_areas_of_all_surfaces():
    pairs = {
        (surface, scan): of_pair(pair(rms, scan))
        for surface, rms in (("smooth", 0.2), ("rough", 60.0))
        for scan in (1, 2, 3)
    }
    limit = elastic_limit(pairs, solved(pairs), DESCRIBED, 0.95)
    np.testing.assert_array_equal(limit.plastic_share, [0, 1])
    np.testing.assert_array_equal(limit.plastic_share_interval, [[0, 0], [1, 1]])
    np.testing.assert_array_equal(limit.solved_plastic_share, [0, 0.5])
    np.testing.assert_allclose(limit.solved_area, 2 * limit.estimated_area)
    assert limit.estimated_area.dims == ("surface", "scan", "contact")
    ratio = limit.force_ratio.sel(surface="smooth")
    assert ratio.sel(variant="recovered") < ratio.sel(variant="bearing_area").item() == 1
    assert ratio.sel(variant="larger_area") > 1
    assert limit.label.values.tolist() == ["Smooth", "Rough"] and limit.attrs["confidence"] == 0.95
