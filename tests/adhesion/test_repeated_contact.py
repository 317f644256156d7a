"""Force of repeated contact against the direct sum, and against the study's single contacts."""

import numpy as np
import pytest
from direct_sum import direct_total
from periodic_maps import over, periodic_noise

from hardcontact.adhesion.force_sum import plastic_totals
from hardcontact.adhesion.repeated_contact import repeated_totals
from hardcontact.contact.gap_map import gap_map

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
