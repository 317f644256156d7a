"""Hertz against the numbers of the paper and its own consistency."""

import numpy as np
import pytest

from hardcontact.contact import hertz

MODULUS = hertz.effective_modulus(365e9, 0.29, 1010e9, 0.22)


def test_effective_modulus_of_ruby_on_diamond():
    assert MODULUS == pytest.approx(289.7e9, rel=1e-3)


def test_pressure_of_the_paper():
    contact = hertz.contact(10e-6, 250e3, MODULUS)
    assert contact.peak_pressure == pytest.approx(135e6, rel=0.02)
    assert contact.approach == pytest.approx(contact.radius**2 / 250e3)


def test_pressure_carries_the_load():
    contact = hertz.contact(3e-6, 5e3, 100e9)
    carried = 2 / 3 * contact.peak_pressure * np.pi * (contact.radius * 1e-9) ** 2
    assert carried == pytest.approx(3e-6)
