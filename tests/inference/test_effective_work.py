"""Effective works of adhesion of the published forces."""

import numpy as np
import pytest
import xarray as xr
from paper_numbers import MEAN_FORCE
from published_contact import CONTACT, WORK

from hardcontact.contact import smooth_sphere
from hardcontact.inference.classical_comparison import (
    PerSurface,
    effective_works,
    pull_off_coefficients,
)
from hardcontact.numbers.statistics import bounds


def test_effective_works_of_the_published_forces():
    force = PerSurface(MEAN_FORCE, np.stack([0.9 * MEAN_FORCE, 1.1 * MEAN_FORCE], axis=-1))
    published = {"tabor_parameter": 0.81, "work_of_adhesion": WORK}
    works = effective_works(force, CONTACT, published, 0.95).isel(surface=0)
    work = works.effective_work_of_adhesion
    assert work.sel(tabor="printed") == pytest.approx(6.97e-3, rel=1e-3)  # 7.15 is printed
    assert work.sel(tabor="self_consistent") == pytest.approx(6.01e-3, rel=1e-3)
    own = work.sel(tabor="self_consistent").item()
    tabor = smooth_sphere.maugis_parameter(smooth_sphere.tabor_parameter(own, *CONTACT))
    coefficient = smooth_sphere.transition_coefficient(tabor)
    assert own * coefficient * np.pi * CONTACT.radius * 1e-9 == pytest.approx(MEAN_FORCE[0])
    low, high = bounds(works, "effective_work_of_adhesion")
    assert (low < work).all() and (work < high).all()
    np.testing.assert_allclose(low.sel(tabor="printed"), 0.9 * work.sel(tabor="printed"))


def test_transition_holds_the_fit_and_the_exact_pair():
    tabor = xr.DataArray([1e-3, 1e3], {"tabor_axis": [1e-3, 1e3]}, "tabor_axis")
    both = pull_off_coefficients(tabor)
    assert both.dims == ("transition", "tabor_axis") and both.attrs == {"units": "1"}
    assert list(both.transition.values) == ["fit", "maugis_dugdale"]
    np.testing.assert_allclose(both, [[2, 1.5], [2, 1.5]], rtol=1e-3)
