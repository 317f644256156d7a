"""Fixtures of the tests of predictions."""

import pytest


@pytest.fixture
def few_cutoffs(monkeypatch):
    """Search edges between a few cutoffs, in a third of the time."""
    monkeypatch.setattr("hardcontact.theory.closed_form.CUTOFFS", 20)
