"""Numbers with intervals, and arithmetic on them."""

import numpy as np
import pytest
import xarray as xr
from scipy import stats

from hardcontact.base.statistics import as_variables, interval_ends
from hardcontact.paper.claims import estimates
from hardcontact.paper.claims.estimates import as_estimate


def scalar(value, low=np.nan, high=np.nan):
    return as_estimate(xr.DataArray(value), low, high)


def ends(dataset):
    return [end.values.tolist() for end in interval_ends(dataset, "value")]


def test_a_variable_becomes_a_number_with_its_interval():
    contacts = xr.DataArray(
        np.random.default_rng(0).random((3, 2, 4)), dims=("scan", "sphere_scan", "contact")
    )
    dataset = xr.Dataset(
        {"force": contacts, "rms_height": contacts.isel(sphere_scan=0, contact=0, drop=True)}
        | as_variables("work", (), 1.0, [0.5, 2.0], {}, 0.95),
        attrs={"confidence": 0.7},
    )
    force = estimates.variable_estimate(dataset, "force")
    means = contacts.mean(("sphere_scan", "contact")).values
    assert float(force.value) == pytest.approx(means.mean())
    log_interval = stats.ttest_1samp(np.log(means), 0).confidence_interval(0.7)
    interval = means.mean() * np.exp(np.array(log_interval) - np.log(means).mean())
    np.testing.assert_allclose(force.value_interval, interval)
    assert ends(estimates.variable_estimate(dataset, "work")) == [0.5, 2.0]
    height = estimates.variable_estimate(dataset, "rms_height")
    assert height.value.dims == ("scan",) and height.value_interval.isnull().all()
    with pytest.raises(KeyError, match="confidence"):
        estimates.variable_estimate(dataset.drop_attrs(), "force")


def test_a_quotient_contains_all_ratios_of_the_intervals():
    ratio = estimates.quotient(scalar(4.0, 2.0, 8.0), scalar(2.0, 1.0, 4.0))
    assert (float(ratio.value), *ends(ratio)) == (2.0, 0.5, 8.0)
    below_zero = estimates.quotient(scalar(4.0, -2.0, 8.0), scalar(2.0, -1.0, 4.0))
    assert ends(below_zero) == [0.0, np.inf]
    assert estimates.quotient(scalar(4.0), scalar(2.0)).value_interval.isnull().all()


@pytest.mark.parametrize(
    ("signed", "absolute"),
    [((2, 1, 3), (2, 1, 3)), ((-2, -3, -1), (2, 1, 3)), ((-0.5, -2, 1), (0.5, 0, 2))],
)
def test_an_absolute_value_has_the_interval_of_its_magnitudes(signed, absolute):
    result = estimates.absolute_value(scalar(*map(float, signed)))
    assert (float(result.value), *ends(result)) == absolute
