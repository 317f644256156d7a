"""Statistics of forces drawn from a known log-normal."""

import numpy as np
import pytest
from scipy.stats import lognorm

from hardcontact.adhesion.bootstrap import Bootstrap
from hardcontact.adhesion.force_distributions import STATISTICS, force_statistics
from hardcontact.statistics import bounds

KNOWN = lognorm(0.9, scale=6e-8)
FORCES = KNOWN.rvs(size=(5, 4, 200), random_state=np.random.default_rng(0))


def test_statistics_of_a_known_distribution():
    computed = force_statistics(FORCES, 3e-8, Bootstrap(0, 200, 0.95), "plastic", "uncd")
    expected = (KNOWN.mean(), KNOWN.median(), 0.9, 6e-8, KNOWN.cdf(3e-8))
    for (name, unit), value in zip(STATISTICS.items(), expected, strict=True):
        assert float(computed[name]) == pytest.approx(value, rel=0.1), name
        assert computed[name].attrs["units"] == unit
        low, high = bounds(computed, name)
        assert low < computed[name] < high, name
    assert float(computed.force_mean) == pytest.approx(FORCES.mean())
    assert float(computed.force_median) == pytest.approx(np.median(FORCES))
    assert float(computed.censored_fraction) == pytest.approx((FORCES < 3e-8).mean())


def test_missing_scans_do_not_count():
    padded = np.full((7, 5, 200), np.nan)
    padded[:5, 1:] = FORCES
    bootstrap = Bootstrap(0, 20, 0.95)
    assert force_statistics(padded, 3e-8, bootstrap).equals(
        force_statistics(FORCES, 3e-8, bootstrap)
    )


def test_interval_is_over_scans_not_over_contacts():
    """Alike contacts, scans that differ: many contacts do not narrow the interval."""
    levels = 1e-7 * np.array([1.0, 2.0, 3.0, 4.0, 5.0])
    forces = np.broadcast_to(levels[:, None, None], (5, 1, 1000))
    computed = force_statistics(forces, 3e-8, Bootstrap(0, 4000, 0.683))
    low, high = bounds(computed, "force_mean")
    assert float(high - low) / 2 == pytest.approx(levels.std() / np.sqrt(5), rel=0.15)
