"""Classical models of rough spheres against their limits and brute force."""

from math import exp, pi, sqrt

import numpy as np
import pytest
from paper_numbers import MODULUS, RADIUS, SPHERE, WORK
from scipy.integrate import quad
from scipy.stats import norm

from hardcontact.contact import hertz_jkr_dmt
from hardcontact.paper import classical_models
from hardcontact.paper.classical_models import CLASSICAL_MODELS, Roughness


def test_rumpf_s_force_has_the_limits_of_plane_and_asperity():
    smooth = hertz_jkr_dmt.dmt_pull_off(WORK, RADIUS)
    force = classical_models.rumpf(WORK, np.array([1e-9, 1e-3, 1e15]), SPHERE)
    assert force[0] == pytest.approx(smooth) == pytest.approx(force[2])
    large = classical_models.rumpf(WORK, 1e3, SPHERE)  # the plane is too far to attract
    asperity = hertz_jkr_dmt.dmt_pull_off(WORK, 1e3 * RADIUS / (RADIUS + 1e3))
    assert large == pytest.approx(asperity, rel=1e-3)


def test_rabinovich_s_force_has_the_limits_of_plane_and_asperity():
    def force(height, distance):
        roughness = Roughness(height, 2 * np.pi * height / distance, np.nan)
        return classical_models.rabinovich(WORK, roughness, SPHERE)

    smooth = hertz_jkr_dmt.dmt_pull_off(WORK, RADIUS)
    assert force(1e-12, 500.0) == pytest.approx(2 * smooth)
    # A cap is half as wide as the distance of peaks, 500 nm, for an rms height of 50 nm.
    cap_radius = (500.0 / 4) ** 2 / (2 * classical_models.PEAK_OVER_RMS * 50.0)
    single = classical_models.rumpf(WORK, cap_radius, SPHERE._replace(spacing=1e-6))
    assert force(50.0, 500.0) == pytest.approx(single, rel=0.05)
    assert force(50.0, 1e12) == pytest.approx(smooth, rel=1e-4)


def relative_pull_off(model, index):
    """Pull-off force at this elastic adhesion index, relative to that of a smooth sphere."""
    height = index ** (2 / 3) * (WORK * np.sqrt(1e-9) / MODULUS) ** (2 / 3) / 1e-9
    roughness = Roughness(height, np.nan, 1.0)
    assert classical_models.adhesion_index(WORK, roughness, MODULUS) == pytest.approx(index)
    smooth = {"fuller_tabor": hertz_jkr_dmt.jkr_pull_off, "maugis": hertz_jkr_dmt.dmt_pull_off}
    return CLASSICAL_MODELS[model].force(WORK, roughness, SPHERE) / smooth[model](WORK, RADIUS)


@pytest.mark.parametrize("index", [0.02, 0.5, 3.0])
def test_dmt_asperities_match_brute_force(index):
    def tension(separation):
        def force(z):  # of an asperity of radius β, relative to 2πβW
            density = exp(-(z**2) / 2) / sqrt(2 * pi)
            return (1 - 2 * index * (z - separation) ** 1.5 / (3 * pi)) * density

        return quad(force, separation, 12, limit=200)[0]

    greatest = max(tension(separation) for separation in np.linspace(-4.5, 4, 171))
    assert relative_pull_off("maugis", index) == pytest.approx(greatest, rel=2e-3)


@pytest.mark.parametrize("index", [0.02, 0.5, 3.0])
def test_jkr_asperities_match_brute_force(index):
    """In the variables of Greenwood: δ = a² - sqrt(2πa), P = 4a³/3 - sqrt(8πa³)."""
    radius = np.geomspace((np.pi / 8) ** (1 / 3), 30, 20001)  # from detachment on
    compression = radius**2 - np.sqrt(2 * np.pi * radius)
    tension = (np.sqrt(8 * np.pi * radius**3) - 4 / 3 * radius**3) / (1.5 * np.pi)
    spread = index ** (2 / 3)

    def mean(separation):
        density = norm.pdf(separation + compression / spread) / spread
        return np.trapezoid(tension * density, compression)

    separations = np.linspace(-6, 6 + 2 / spread, 401)
    greatest = max(mean(separation) for separation in separations)
    assert relative_pull_off("fuller_tabor", index) == pytest.approx(greatest, rel=2e-3)


def test_without_roughness_every_model_has_the_force_of_its_smooth_sphere():
    flat = Roughness(*(np.array([tiny]) for tiny in (1e-7, 1e-2, 1e-9)))
    smooth = dict.fromkeys(CLASSICAL_MODELS, hertz_jkr_dmt.dmt_pull_off(WORK, RADIUS))
    smooth["fuller_tabor"] = hertz_jkr_dmt.jkr_pull_off(WORK, RADIUS)
    for name, model in CLASSICAL_MODELS.items():
        assert model.force(WORK, flat, SPHERE) == pytest.approx(smooth[name], rel=2e-3), name


def test_close_packed_asperities_have_the_rms_height_of_the_models():
    """Rms of hexagonally packed hemispheres and paraboloids, heights from their base."""
    cell = 2 * np.sqrt(3)  # of asperities of base radius 1
    hemisphere = quad(lambda r: 2 * np.pi * r * (1 - r**2), 0, 1)[0] / cell
    assert hemisphere**-0.5 == pytest.approx(classical_models.HEMISPHERE_OVER_RMS)
    assert hemisphere**-0.5 == pytest.approx(1.485, abs=5e-4)
    paraboloid = quad(lambda r: 2 * np.pi * r * (1 - r**2) ** 2, 0, 1)[0] / cell
    assert paraboloid**-0.5 == pytest.approx(classical_models.PEAK_OVER_RMS, rel=2e-3)
