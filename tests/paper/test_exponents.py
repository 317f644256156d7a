"""Exponents of forces and edges against power laws."""

import numpy as np
import pytest
import xarray as xr
from scipy import stats

from hardcontact.base.statistics import interval_ends
from hardcontact.paper.exponents import edge_exponents, force_exponent

RADII, AREAS = [1e4, 1e5, 1e6], [50.0, 400.0, 3200.0]
#: The contact touches another area on the larger pixels of long-edge masters.
LONG_AREAS = np.power(AREAS, 0.9).tolist()
CUTOFFS = np.geomspace(10, 2e4, 60)


def power_law(radius_exponent, contact_exponent):
    """Return edges in nm over RADII and AREAS; exponents may differ by realization."""
    radius = xr.DataArray(RADII, {"radius": RADII}, "radius")
    area = xr.DataArray(AREAS, {"contact_area": AREAS}, "contact_area")
    return 600 * np.sqrt(radius / 1e5) ** radius_exponent * np.sqrt(area / 400) ** contact_exponent


def curves(*exponents, scatter=0.0):
    """Return ratios of three realizations whose edges are a known power law.

    The exponents of the realizations scatter about the given exponents, and each edge scatters
    about the power law of its exponents.
    """
    cutoff = xr.DataArray(CUTOFFS, {"cutoff_wavelength": CUTOFFS}, "cutoff_wavelength")
    noise = np.random.default_rng(5).standard_normal(3)
    noise = xr.DataArray(scatter * (noise - noise.mean()), dims="realization")
    scattered_edge = power_law(*(exponent + noise for exponent in exponents))
    # ln(ratio) is linear in ln(cutoff) and ln(1.1) at the edge, on either side.
    sign = xr.DataArray([1, -1], {"side": ["short", "long"]}, "side")
    distance = sign * np.log(cutoff / (scattered_edge * np.exp(noise)))
    ratio = np.exp(np.maximum(np.log(1.1) * (1 + 2 * distance), 0)).expand_dims(surface=["a"])
    return xr.Dataset(
        {
            "filtered_force_ratio": ratio,
            "spectrum_end": (("surface", "side"), [[5.0, 4e4]]),
            "touching_area": (
                ("surface", "realization", "side", "contact_area"),
                [[[AREAS, LONG_AREAS]] * 3],
            ),
        }
    )


@pytest.mark.parametrize("exponents", [(1.0, 0.0), (0.2, 0.9), (0.0, -0.8)])
def test_exponents_of_a_known_power_law_are_recovered(exponents):
    fitted = edge_exponents(curves(*exponents, scatter=0.02), 0.1, 0.95).sel(surface="a")
    exponent = fitted["edge_exponent"]
    radius_exponent, area_exponent = exponents
    np.testing.assert_allclose(
        exponent, [exponents, (radius_exponent, area_exponent / 0.9)], atol=0.02
    )
    low, high = interval_ends(fitted, "edge_exponent")
    assert (low <= exponent).all() and (exponent <= high).all()


def test_the_exponent_of_a_force_in_the_radius_is_recovered():
    radius = xr.DataArray(RADII, {"radius": RADII}, "radius")
    power = xr.DataArray([0.3, 0.4, 0.5], {"realization": [1, 2, 3]}, "realization")
    factor = xr.DataArray([[1.0, 3.0]], dims=("contact_y", "contact_x"))
    axes = {"side": ["short", "long"], "surface": ["a"], "contact_area": AREAS}
    forces = (1e-6 * factor * (radius / 1e5) ** power).expand_dims(axes)
    # Forces at another side or contact area differ.
    is_other = (forces["side"] == "short") | (forces["contact_area"] != 400)
    data = xr.Dataset({"unfiltered_pull_off_force": forces.where(~is_other, 1.0)})
    exponent = force_exponent(data, 400.0, 0.95)
    assert exponent["force_exponent"].item() == pytest.approx(0.4)
    half_width = stats.t.ppf(0.975, 2) * 0.1 / np.sqrt(3)
    np.testing.assert_allclose(
        interval_ends(exponent, "force_exponent"), [[0.4 - half_width], [0.4 + half_width]]
    )
