"""Conclusions from the numbers of the paper's study."""

import pytest

from hardcontact.base.number import Number
from hardcontact.report.paper_study.conclusions import features_by_scatter, most_sensitive_coatings


def test_most_sensitive_coatings_have_the_outermost_edges():
    edges = {"UNCD": (37, 1800), "NCD": (66, 2800), "MCD": (53, 2000)}
    coatings = {
        label: {"short_edge": Number("short_edge", short), "long_edge": Number("long_edge", long)}
        for label, (short, long) in edges.items()
    }
    assert most_sensitive_coatings(coatings) == {"short_edge": "UNCD", "long_edge": "NCD"}


@pytest.mark.parametrize(("published", "features"), [(1.8, "bumps"), (0.3, "pits")])
def test_features_are_those_with_the_nearer_scatter(published, features):
    scatter = {"bumps_log_force_std": 1.9, "pits_log_force_std": 0.2}
    scatter["featured_log_force_std_published"] = published
    numbers = {name: Number(name, value) for name, value in scatter.items()}
    assert features_by_scatter(numbers) == features
