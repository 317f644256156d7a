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
    tiny, huge = classical_models.rumpf(WORK, np.array([1e-9, 1e15]), SPHERE)
    assert tiny == pytest.approx(smooth) == pytest.approx(huge)
    high = classical_models.rumpf(WORK, 1e3, SPHERE)  # the plane is too far to attract
    asperity = hertz_jkr_dmt.dmt_pull_off(WORK, 1e3 * RADIUS / (RADIUS + 1e3))
    assert high == pytest.approx(asperity, rel=1e-3)


def test_rabinovich_s_force_has_the_limits_of_plane_and_asperity():
    def force(rms_height, peak_distance):
        roughness = Roughness(rms_height, 2 * np.pi * rms_height / peak_distance, np.nan)
        return classical_models.rabinovich(WORK, roughness, SPHERE)

    smooth = hertz_jkr_dmt.dmt_pull_off(WORK, RADIUS)
    assert force(1e-12, 500.0) == pytest.approx(2 * smooth)
    # Caps are 500/2 nm wide; the plane is too far to attract.
    cap_radius = (500.0 / 4) ** 2 / (2 * classical_models.PEAK_OVER_RMS * 50.0)
    asperity = hertz_jkr_dmt.dmt_pull_off(WORK, cap_radius * RADIUS / (RADIUS + cap_radius))
    assert force(50.0, 500.0) == pytest.approx(asperity, rel=0.05)
    assert force(50.0, 1e12) == pytest.approx(smooth, rel=1e-4)


def relative_pull_off(model, index):
    """Return the force at an elastic adhesion index relative to the force of a smooth sphere."""
    height = index ** (2 / 3) * (WORK * np.sqrt(1e-9) / MODULUS) ** (2 / 3) / 1e-9
    roughness = Roughness(height, np.nan, 1.0)
    assert classical_models.adhesion_index(WORK, roughness, MODULUS) == pytest.approx(index)
    smooth = {"fuller_tabor": hertz_jkr_dmt.jkr_pull_off, "maugis": hertz_jkr_dmt.dmt_pull_off}
    return CLASSICAL_MODELS[model].force(WORK, roughness, SPHERE) / smooth[model](WORK, RADIUS)


@pytest.mark.parametrize("index", [0.02, 0.5, 3.0])
def test_dmt_asperities_match_brute_force(index):
    def mean_tension(separation):
        def weighted_tension(height):  # relative to 2πβW
            density = exp(-(height**2) / 2) / sqrt(2 * pi)
            return (1 - 2 * index * (height - separation) ** 1.5 / (3 * pi)) * density

        return quad(weighted_tension, separation, 12, limit=200)[0]

    greatest = max(mean_tension(separation) for separation in np.linspace(-4.5, 4, 171))
    assert relative_pull_off("maugis", index) == pytest.approx(greatest, rel=2e-3)


@pytest.mark.parametrize("index", [0.02, 0.5, 3.0])
def test_jkr_asperities_match_brute_force(index):
    """In Greenwood's units (2017), δ = a² - sqrt(2πa) and P = 4a³/3 - sqrt(8πa³)."""
    radius = np.geomspace((np.pi / 8) ** (1 / 3), 30, 20001)  # from detachment on
    compression = radius**2 - np.sqrt(2 * np.pi * radius)
    tension = (np.sqrt(8 * np.pi * radius**3) - 4 / 3 * radius**3) / (1.5 * np.pi)
    spread = index ** (2 / 3)

    def mean_tension(separation):
        density = norm.pdf(separation + compression / spread) / spread
        return np.trapezoid(tension * density, compression)

    separations = np.linspace(-6, 6 + 2 / spread, 401)
    greatest = max(mean_tension(separation) for separation in separations)
    assert relative_pull_off("fuller_tabor", index) == pytest.approx(greatest, rel=2e-3)


def test_without_roughness_every_model_has_the_force_of_its_smooth_sphere():
    flat = Roughness(*(np.array([tiny]) for tiny in (1e-7, 1e-2, 1e-9)))
    smooth = dict.fromkeys(CLASSICAL_MODELS, hertz_jkr_dmt.dmt_pull_off(WORK, RADIUS))
    smooth["fuller_tabor"] = hertz_jkr_dmt.jkr_pull_off(WORK, RADIUS)
    for name, model in CLASSICAL_MODELS.items():
        assert model.force(WORK, flat, SPHERE) == pytest.approx(smooth[name], rel=2e-3), name


def test_close_packed_hemispheres_and_paraboloids_have_the_rms_heights_of_the_models():
    cell = 2 * np.sqrt(3)  # area per asperity of base radius 1, in a hexagonal packing
    hemisphere = quad(lambda r: 2 * np.pi * r * (1 - r**2), 0, 1)[0] / cell
    assert hemisphere**-0.5 == pytest.approx(classical_models.HEMISPHERE_OVER_RMS)
    assert hemisphere**-0.5 == pytest.approx(1.485, abs=5e-4)
    paraboloid = quad(lambda r: 2 * np.pi * r * (1 - r**2) ** 2, 0, 1)[0] / cell
    assert paraboloid**-0.5 == pytest.approx(classical_models.PEAK_OVER_RMS, rel=2e-3)
