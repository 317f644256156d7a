"""Trials of the rule for scan sizes: spectra as asked for, errors as recomputed."""

from functools import cache

import numpy as np
import pytest
import xarray as xr
from scan_windows import contacts_on

from hardcontact.insight.scan_size_trials import (
    Case,
    ScanSizeRule,
    creases,
    random_spectra,
    scan_size_trials,
    window_excess,
)
from hardcontact.surfaces.spectral_models import self_affine
from hardcontact.surfaces.spectrum import WAVEVECTORS, Spectrum, all_scales_moments, roll_off

TRIALS = {
    "size": 2000.0,
    "pixels": 64,
    "realizations": 2,
    "count": 5,
    "radii": [2e3, 2e4],
    "contacts": contacts_on(2000.0, 5e3, [500.0, 1000.0]),
    "excess": 1.1,
    "seed": 3,
    "confidence": 0.95,
}


def spectrum(plateau):
    return Spectrum(WAVEVECTORS, self_affine(WAVEVECTORS, plateau, 900.0, 0.8))


@cache
def computed():
    return scan_size_trials({"a": spectrum(1e6), "b": spectrum(1e8)}, TRIALS)


def test_random_spectra_lie_within_their_bounds_and_differ():
    drawn = random_spectra(np.random.default_rng(1), 6)
    heights = [all_scales_moments(one)[0] for one in drawn]
    rolls = [roll_off(one) for one in drawn]
    assert min(heights) > 1.99 and max(heights) < 121 and len(set(heights)) == 6
    # The table has forty points a decade.
    assert min(rolls) > 280 and max(rolls) < 4300


def test_a_surface_without_roughness_has_no_excess():
    found = window_excess("flat", spectrum(1e-6), 5e3, TRIALS)
    np.testing.assert_allclose(found["excess"], 1, atol=1e-3)
    np.testing.assert_allclose(found["excess_interval"], 1, atol=1e-2)


def test_predictions_errors_and_sizes_are_those_of_the_rule():
    data = computed()
    rule = ScanSizeRule(data["strength"].item(), data["exponent"].values)
    for surface in ("a", "b"):
        one = data.sel(surface=surface)
        case = Case(one["scan_size"].values[:, None], one["rms_height"].item(),
                    one["roll_off"].item(), 5e3, one["rho"].values)  # fmt: skip
        np.testing.assert_allclose(one["predicted_excess"], rule.excess(case))
        at_needed = case._replace(size=one["size_needed"].values)
        np.testing.assert_allclose(rule.excess(at_needed), 1.1)
    left = np.log(data["excess"] / data["predicted_excess"])
    error = data["error"].sel(tested="surfaces")
    np.testing.assert_allclose(error.sel(kind="corrected"), np.sqrt((left**2).mean()))
    known = np.sqrt((np.log(data["known_excess"]) ** 2).mean())
    np.testing.assert_allclose(data["error"].values[0, 1], known)


def test_random_surfaces_are_predicted_without_themselves():
    data = computed()
    left = np.log(data["known_excess"] / data["predicted_known_excess"])
    without = data["error"].sel(tested="random surfaces", kind="corrected")
    np.testing.assert_allclose(without, np.sqrt((left**2).mean()))


def test_touching_places_are_as_far_from_the_apex_as_their_density_says():
    """They are as dense as exp(-t r²/2Rσ): their rms distance is the draw length."""
    height, approach, radius, shape = 50.0, 150.0, 250e3, (1, 3, 2000)
    squared = np.random.default_rng(1).exponential(2 * radius * height**2 / approach, shape)
    of_contact = {
        "crease_force": np.broadcast_to([[[0.1], [0.3], [0.8]]], shape),
        "crease_contact": np.zeros(shape),
        "contact_distance": squared**0.5,
        "closest_approach": np.full(shape, approach),
    }
    of_scan = {"crease_area": 0.15, "rms_height": height}
    over = ("surface", "scan", "contact")
    asperities = xr.Dataset(
        {name: (over, values) for name, values in of_contact.items()}
        | {name: (over[:2], [[value] * 3]) for name, value in of_scan.items()},
        attrs={"sphere_radius": radius},
    ).expand_dims(rho=[1.0, 5.6])
    found = creases(asperities, 5.6, 0.95).squeeze("surface")
    assert found.crease_force == pytest.approx(0.4)
    assert found.crease_force_interval.values == pytest.approx([0, 1])  # of three scans
    assert found.contact_distance == pytest.approx(found.draw_length.item(), rel=0.03)
