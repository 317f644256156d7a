"""The Hurst exponent of the shortest waves."""

import numpy as np
import pytest
from known_spectra import BINS

from hardcontact.surfaces.hurst_exponent import fit_hurst_exponent


@pytest.mark.parametrize("sharpness", [1, 2, 4, 20])
@pytest.mark.parametrize("rolloff", [200.0, 400.0, 1000.0])
def test_the_rolloff_does_not_bias_the_hurst_exponent(rolloff, sharpness):
    def bent(q):
        return (1 + (q * rolloff / 2 / np.pi) ** (2 * sharpness)) ** (-1.7 / sharpness)

    fit = fit_hurst_exponent(BINS, bent(BINS), np.full(BINS.shape, 1e-4))
    assert fit.exponent == pytest.approx(0.7, abs=0.1)
    np.testing.assert_allclose([fit.shortest, fit.longest], 2 * np.pi / BINS[[-1, -11]])
