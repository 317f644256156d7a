"""Fig. 3: forces at the fitted range and work, log-normals published and computed."""

import numpy as np
import pytest
from figure_inputs.adhesion import RANGE, RHO, WORK, adhesion, inference
from figure_inputs.published_tables import published_pull_off
from figure_rows import select

from hardcontact.figures import fig3


def table():
    return fig3.table(adhesion(), inference(), published_pull_off())


def test_forces_are_scaled_to_the_fitted_range_and_work():
    data = adhesion()
    fitted = fig3._forces_at_fit(data, inference())["uncd"]
    at_one = data["pull_off_force"].sel(surface="uncd", contact_model="plastic", rho=RHO[0])
    # The synthetic forces of this surface grow as rho, which log-log interpolation keeps exactly.
    assert np.sort(fitted) == pytest.approx(np.sort(at_one.values.ravel()) * RANGE / RHO[0] * WORK)


def test_table_holds_published_and_computed_lognormals():
    shape = select(table(), surface="polished_uncd", quantity="lognormal_shape").set_index("origin")
    assert shape["value"]["published"] == pytest.approx(np.sqrt(2 * np.log(8.8 / 1.75)))
    assert shape["value"]["computed"] == 0.8
    assert (shape["low"]["computed"], shape["high"]["computed"]) == pytest.approx((0.64, 0.96))
    assert np.isnan(shape["low"]["published"])


def test_logarithmic_histogram_holds_every_force():
    rows = select(table(), surface="mcd", panel="2")
    widths = rows["force_high"] - rows["force_low"]
    assert (rows["value"] * widths).sum() == pytest.approx(1)


def test_missing_scans_are_left_out():
    data = adhesion()
    data["pull_off_force"][2, 1:] = np.nan
    forces = fig3._forces_at_fit(data, inference())
    assert np.isfinite(forces["ncd"]).all() and 3 * forces["ncd"].size == forces["mcd"].size
