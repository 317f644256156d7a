"""Models and their readings of roughness, on roughness that is known."""

import numpy as np
import pytest
from published_contact import AFM, CONTACT, MODULUS, RADIUS, WORK
from scipy.integrate import quad

from hardcontact.contact import smooth_sphere
from hardcontact.inference import classical_models
from hardcontact.inference.classical_models import MODELS, Roughness


def test_without_roughness_every_model_has_the_force_of_its_smooth_sphere():
    flat = Roughness(*(np.array([tiny]) for tiny in (1e-7, 1e-2, 1e-9)))
    for name, model in MODELS.items():
        smooth = (
            smooth_sphere.jkr_pull_off if name == "fuller_tabor" else smooth_sphere.dmt_pull_off
        )
        expected = smooth(WORK, RADIUS)
        assert model.force(WORK, flat, CONTACT) == pytest.approx(expected, rel=2e-3), name


def test_geometry_of_close_packed_asperities():
    """Rms of hexagonally packed hemispheres and paraboloids, heights from their base."""
    cell = 2 * np.sqrt(3)  # of asperities of base radius 1
    hemisphere = quad(lambda r: 2 * np.pi * r * (1 - r**2), 0, 1)[0] / cell
    assert hemisphere**-0.5 == pytest.approx(classical_models.HEMISPHERE_OVER_RMS)
    assert hemisphere**-0.5 == pytest.approx(1.485, abs=5e-4)
    paraboloid = quad(lambda r: 2 * np.pi * r * (1 - r**2) ** 2, 0, 1)[0] / cell
    assert paraboloid**-0.5 == pytest.approx(classical_models.PEAK_OVER_RMS, rel=2e-3)


def test_published_roughness_leaves_no_elastic_adhesion():
    index = classical_models.adhesion_index(WORK, AFM.height, 1 / AFM.curvature, MODULUS)
    assert index[0] == pytest.approx(1602, rel=1e-3) and (index > 1000).all()
    for name in ("fuller_tabor", "maugis"):
        assert (MODELS[name].force(WORK, AFM, CONTACT) < 1e-15).all()
