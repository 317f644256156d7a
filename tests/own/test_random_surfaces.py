"""Six of the forty surfaces of tests/benchmarks/validate_random_surfaces.py."""

import pytest
from validate_random_surfaces import (
    FAMILIES,
    forces_with_intervals,
    predicted_numbers,
    random_case,
    true_force,
)


@pytest.mark.study
@pytest.mark.filterwarnings("ignore:roughness")  # Pillars are a caution: the closed form fails.
@pytest.mark.parametrize("family", FAMILIES)
def test_no_interval_excludes_the_force_on_pixels_four_times_finer(family):
    case = random_case(family, 0, 128)
    force = true_force(case)
    for predicted in forces_with_intervals(predicted_numbers(case)).values():
        assert predicted.low <= force <= predicted.high, predicted
