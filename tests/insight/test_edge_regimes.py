"""Local exponents and causes of edges that are known, and where designed surfaces lie."""

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from known_spectra import rough

from hardcontact.insight.closed_form import Contact, closed_form
from hardcontact.insight.edge_formulas import formula_edges
from hardcontact.insight.edge_scaling import (
    CLOSED_FORM,
    COMPUTED,
    CONTACT,
    FORMULA,
    RANGE,
    designed_edges,
    formula_scaling,
)

SPHERE = Contact(radius=250e3, rho=5.6, work=1.0, area=400.0)
SPECTRA = {"a": rough(30.0), "b": rough(100.0, 2500.0)}
RADII, AREAS, RANGES = [1e5, 2e5], [1.0, 4.0, 40e3, 160e3], [1.4, 5.6]
EXPONENTS = {"radius": 0.25, "rho": 0.5, "contact": 0.75}


def scaling(opened=()):
    """Return edges that are products of powers of all lengths, those of places without one open."""
    coordinates = {"surface": list(SPECTRA), "radius": RADII, "area": AREAS, "rho": RANGES}
    grid = xr.Dataset(coords=coordinates | {"side": ["small", "large"]})
    edge = grid["radius"] ** 0.125 * grid["rho"] ** 0.25 * grid["area"] ** 0.375
    edge = edge * xr.DataArray([1.0, 30.0], {"side": grid["side"]}) + 0 * (grid["surface"] == "a")
    edge = edge.transpose("side", "surface", "radius", "area", "rho").copy()
    for place in opened:
        edge.loc[place] = np.nan
    data = grid.assign(edge=edge, edge_bound=("side", [1000.0, 10.0]))
    data["contact_area"] = ("side", "area"), [AREAS, AREAS]
    return data.assign_attrs(tolerance=0.1)


def test_local_exponents_are_those_of_a_power_law_and_formulas_those_of_their_edges():
    found = formula_scaling(scaling(), SPECTRA, SPHERE)
    for length, expected in EXPONENTS.items():
        local = found["local_exponent"].sel(length=length, origin=COMPUTED)
        assert np.nanmin(local) == pytest.approx(expected) == np.nanmax(local)
    place = {"surface": "b", "radius": 2e5, "rho": 5.6}
    edges = [formula_edges(SPECTRA["b"], Contact(2e5, 5.6, 1.0, area), 0.1) for area in AREAS]
    of_area = found.sel(place).transpose(..., "area")
    for side, values in (
        ("small", [one.short for one in edges]),
        ("large", [one[1] for one in edges]),
    ):
        assert of_area["formula_edge"].sel(side=side).values == pytest.approx(values)
        local = of_area["local_exponent"].sel(side=side, length="contact", origin=FORMULA)
        rises = 2 * np.diff(np.log(values)) / np.diff(np.log(AREAS))
        assert local.values[1:] == pytest.approx(rises)
        assert np.isnan(local.values[0])
    form = closed_form(SPECTRA["b"], SPHERE)
    assert found["over_range"].sel(surface="b").item() == pytest.approx(form.rms_height / 5.6)
    level = found["approach_level"].sel(surface="b").item()
    assert level == pytest.approx(form.closest_approach / form.rms_height)


def test_exponents_of_open_edges_are_bounds():
    place = {"surface": "a", "radius": 1e5, "rho": 5.6}
    opened = [{"side": side, "area": 4.0} | place for side in ("small", "large")]
    found = formula_scaling(scaling(opened), SPECTRA, SPHERE).sel(place)
    local = found.sel(length="contact")
    # A short edge beyond the last cutoff rises at least, an open long one at most so much.
    assert local["local_bound"].sel(side="small").values.tolist() == [0, 1, -1, 0]
    assert local["local_bound"].sel(side="large").values.tolist() == [0, -1, 1, 0]
    edge = scaling()["edge"].sel(place).sel(side="small", area=1.0).item()
    rise = local["local_exponent"].sel(side="small", origin=COMPUTED, area=4.0).item()
    assert rise == pytest.approx(np.log(1000.0 / edge) / np.log(2.0))


def test_wide_contacts_set_the_short_edge_and_narrow_ones_leave_it_to_the_range():
    found = formula_scaling(scaling(), SPECTRA, SPHERE)
    wide = found["level"]["area"] > 1e3
    assert (found["level"].sel(area=wide) < 0).all() and (found["level"].sel(area=~wide) > 0).all()
    steps = found["cause_steps"].sel(length="radius")
    assert steps.sum() == found["level"].size / 2
    of_formula = found["cause_exponent"].sel(origin=FORMULA)
    for cause, more, less in ((CONTACT, "contact", "rho"), (RANGE, "rho", "contact")):
        of_cause = of_formula.sel(cause=cause)
        assert of_cause.sel(length=more) > of_cause.sel(length=less)
    assert found["cause_bounds"].sum() == 0


def test_designed_surfaces_have_their_errors_and_spectra_without_edges_have_none():
    computed = pd.DataFrame({
        "surface": [0, 1], "held_back": [0, 1], "short_edge": [20.0, 30.0], "long_edge": [1e3, 2e3],
        "short_edge_is": ["found", "at most"], "long_edge_is": ["at least", "found"],
        "predicted_short_edge": [10.0, 10.0], "predicted_long_edge": [1e3, 1e3],
    })  # fmt: skip
    formulas = pd.DataFrame({
        "surface": ["0", "1", "crn"], "over_range": [1.0, 5.0, 9.0], "level": [3.0, 2.0, 1.0],
        "contact_over_rolloff": 0.01, "short_edge": [40.0, 30.0, 50.0], "long_edge": 1e3,
    })  # fmt: skip
    found = designed_edges(computed, formulas)
    errors = found["designed_error"]
    assert errors.sel(prediction=FORMULA, side="small").values.tolist()[:2] == [0.5, 1.0]
    assert errors.sel(prediction=CLOSED_FORM, side="large").values.tolist()[:2] == [1.0, 2.0]
    assert errors.sel(designed="crn").isnull().all()
    assert found["designed_bound"].values.tolist() == [[0, -1, 0], [1, 0, 0]]
    assert found["held_back"].values.tolist() == [0, 1, 0]
    assert found["designed_level"].values.tolist() == [3.0, 2.0, 1.0]
