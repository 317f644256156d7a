"""Scatter over places and scans, what a mean needs, and the table of designed surfaces."""

import sys

import numpy as np
import pandas as pd
import pytest
from known_spectra import rough
from repository import ROOT
from scipy import stats

sys.path.insert(0, str(ROOT / "tests/benchmarks"))

import validate_statistics

from hardcontact.insight.closed_form import Contact
from hardcontact.insight.force_scatter import force_scatter, over_scans
from hardcontact.insight.pull_off_statistics import force_statistics
from hardcontact.numbers.random import generator
from hardcontact.records import dataset

CONTACT = Contact(250e3, 5.6, 1.0, 400.0)
TABLE = pd.read_csv(validate_statistics.DATASET.with_suffix(".csv"))


def test_scans_add_the_scatter_of_their_means():
    places = force_statistics(rough(4.0), CONTACT)
    assert over_scans(rough(4.0), CONTACT, 0.0).spread == pytest.approx(places.spread)
    ends = [force_statistics(rough(4.0 + change), CONTACT).force for change in (-0.1, 0.1)]
    slope = np.log(ends[1] / ends[0]) / 0.2
    expected = np.hypot(places.spread, slope * 4.0 * 0.05)
    assert over_scans(rough(4.0), CONTACT, 0.05).spread == pytest.approx(expected, rel=0.02)


def test_scans_far_apart_scatter_as_many_equally_probable_ones():
    heights = stats.norm.ppf((np.arange(41) + 0.5) / 41, 4.0, 2.0)
    laws = [force_statistics(rough(max(height, 0.0)), CONTACT) for height in heights]
    means = np.array([law.force for law in laws])
    squares = np.mean([law.force**2 * (1 + law.variation**2) for law in laws])
    expected = np.sqrt(squares) / means.mean()
    assert np.hypot(1, over_scans(rough(4.0), CONTACT, 0.5).variation) == pytest.approx(
        expected, rel=0.05
    )


def test_the_shape_is_that_of_mean_and_median_as_published():
    settings = {"tolerance": 0.1, "confidence": 0.9}
    found = force_scatter({"a": rough(20.0)}, CONTACT, [5.6], {"a": 0.0}, settings)
    law = force_statistics(rough(20.0), CONTACT)
    forces = law.quantile(np.linspace(0, 1, 20001)[1:-1])
    expected = np.sqrt(2 * np.log(forces.mean() / np.median(forces)))
    assert found["total_shape"].item() == pytest.approx(expected, rel=0.01)


def test_means_of_as_many_contacts_keep_within_the_tolerance():
    settings = {"tolerance": 0.1, "confidence": 0.9}
    found = force_scatter({"a": rough(10.0)}, CONTACT, [5.6], {"a": 0.0}, settings)
    needed = round(found["contacts_needed"].item())
    law = force_statistics(rough(10.0), CONTACT)
    forces = law.quantile(generator(1, "contacts").uniform(size=(2000, needed)))
    within = np.abs(forces.mean(axis=1) / law.force - 1) < 0.1
    assert needed > 50 and within.mean() == pytest.approx(0.9, abs=0.02)


def test_the_table_is_that_of_the_law():
    stored = dataset.read(validate_statistics.DATASET)
    for place in (0, 31, 69):
        rows = list(validate_statistics.compared(stored.isel(surface=place)))
        known = TABLE[TABLE["surface"] == place].reset_index(drop=True)
        pd.testing.assert_frame_equal(pd.DataFrame(rows)[list(known)], known, rtol=2e-3, atol=1e-3)


def test_forces_are_those_of_the_designed_surfaces():
    row = validate_statistics.design(52)[51]
    found = validate_statistics.computed(row)
    stored = dataset.read(validate_statistics.DATASET).isel(surface=51)
    for name in ("log_force", "level"):
        np.testing.assert_allclose(found[name], stored[name], atol=6e-4)
