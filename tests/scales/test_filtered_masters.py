"""Forces at cutoffs: a wave counts until the cutoff passes its length, on either side."""

import numpy as np
import pytest

from hardcontact.scales.filtered_masters import forces_at_cutoffs
from hardcontact.surfaces.height_map import HeightMap

#: Wavelength in nm and amplitude of the only wave of a master of 640 nm.
WAVELENGTH, AMPLITUDE = 80.0, 2.0
CUTOFFS = [40.0, 60.0, 120.0, 240.0]


def curves(side):
    x = np.arange(64) * 10.0
    wave = AMPLITUDE * np.cos(2 * np.pi * x / WAVELENGTH)
    master = HeightMap(np.tile(wave, (64, 1)), 10.0, periodic=True, basis="substitute")
    moments = (("moment",), [2, 4], {})
    return forces_at_cutoffs(
        master,
        side,
        {"pixels": 64, "cutoffs": CUTOFFS},
        lambda surface: np.array([(surface.heights**power).mean() for power in (2, 4)]),
        {"moment": moments},
    )


@pytest.mark.parametrize(
    ("side", "kept", "end"), [("small", [1, 1, 0, 0], 20.0), ("large", [0, 0, 1, 1], 640.0)]
)
def test_a_wave_is_kept_on_its_side_of_the_cutoffs(side, kept, end):
    found = curves(side)
    dims, values, attributes = found.variables["pull_off_force"]
    # The mean of cos² is 1/2, that of cos⁴ is 3/8.
    whole = np.array([AMPLITUDE**2 / 2, 3 * AMPLITUDE**4 / 8])
    assert dims == ("cutoff_wavelength", "moment") and attributes["units"] == "N"
    np.testing.assert_allclose(values, np.outer(kept, whole), atol=1e-4)
    np.testing.assert_allclose(found.variables["unfiltered_pull_off_force"][1], whole, rtol=1e-6)
    assert found.variables["unfiltered_wavelength"][1] == end
    assert list(found.coordinates["cutoff_wavelength"][1]) == CUTOFFS
