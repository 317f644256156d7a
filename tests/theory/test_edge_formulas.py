"""Formulas of the edges: limits, derivatives, summits of random surfaces, the closed form."""

import sys
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest
from known_spectra import rough, rounded
from repository import ROOT
from scipy import special

sys.path.insert(0, str(ROOT / "tests/benchmarks"))

import validate_edges

from hardcontact.base.random import generator
from hardcontact.contact.contact import contact_of_area
from hardcontact.surfaces.synthesis import random_surface
from hardcontact.theory import edge_formulas as formulas
from hardcontact.theory.closed_form import edges, gaussian_share
from hardcontact.theory.prediction_errors import EDGE_FOUND, validation
from hardcontact.theory.summits import ApexLevels, apex_levels, moment, rough_waves

HURST, ROLL_OFF = 0.8, 1000.0
#: Wide contact on a gentle surface: no summit stands out, and many points attract.
WIDE = contact_of_area(radius=250e3, rho=6.0, work=1.0, area=4e4)
GENTLE = rough(3.0, ROLL_OFF, HURST, shortest=2.0)


def test_level_is_the_inverse_of_the_height_above_it():
    levels = np.array([-40.0, -2.0, 0.0, 3.3, 9.0])
    assert formulas.level_of_area(formulas.height_above(levels)) == pytest.approx(levels, abs=1e-4)
    heights = np.random.default_rng(1).standard_normal(400_000)
    for level in (-1.0, 0.5, 2.0):
        mean = np.maximum(heights - level, 0).mean()
        assert formulas.height_above(level) == pytest.approx(mean, rel=0.02)


def level_of_gap(gap):
    """Return the level t (rms heights) to which a surface is flattened, by its mean gap."""
    levels = np.linspace(-12, 6, 2000)
    return np.interp(gap, formulas.height_above(-levels), levels)


def test_the_mean_gap_is_that_of_a_flattened_surface():
    heights = generator(1, "flattened").standard_normal(400_000)
    indices = [100, 200, 250]
    waves = rough_waves(rough(4.0), 250e3)
    _, variance, gap = formulas.gaps_on_summits(waves, 250e3, 400.0)
    for sigma, mean_gap in zip(np.sqrt(variance[indices]), gap[indices], strict=True):
        flattened = sigma * np.maximum(level_of_gap(mean_gap / sigma) - heights, 0).mean()
        assert mean_gap == pytest.approx(flattened, rel=0.02, abs=1e-3 * sigma)


def test_the_elasticity_of_many_points_is_the_derivative_of_the_mean_force():
    def log_force(sigma):
        level = formulas.level_of_area(WIDE.area / (2 * np.pi * WIDE.radius * sigma))
        return np.log(gaussian_share(sigma, level * sigma, WIDE.range))

    sigma, step = 3.0, 1e-2
    slope = (log_force(sigma * np.exp(step)) - log_force(sigma * np.exp(-step))) / (2 * step)
    level = float(formulas.level_of_area(WIDE.area / (2 * np.pi * WIDE.radius * sigma)))
    elasticity = formulas.elasticity(sigma, ApexLevels(np.array([level]), np.ones(1), 1e-3), WIDE)
    assert elasticity == pytest.approx(-slope, rel=0.03)


def test_the_elasticity_of_single_peaks_follows_from_their_number():
    """For rigid bodies F ~ 1/(1 - k), k = t rho/sigma: E = k/(1 - k)."""
    contact, level = contact_of_area(250e3, 1.0, 1.0, 1e-30), 8.0
    for modulus in (0.05, 0.2):
        sigma = level / modulus
        elasticity = formulas.elasticity(
            sigma, ApexLevels(np.array([level]), np.ones(1), 50.0), contact
        )
        assert elasticity == pytest.approx(modulus / (1 - modulus), rel=0.03)


def test_edges_of_many_points_match_the_power_law_and_the_closed_form():
    edge_pair = formulas.formula_edges(GENTLE, WIDE, 0.1)
    waves = rough_waves(GENTLE, WIDE.radius)
    sigma = np.sqrt(moment(waves, 0))
    level = apex_levels(waves, WIDE.radius, WIDE.area).mean()
    slack = level + 1 / level - sigma / WIDE.range
    share = 2 * np.log(1.1) * WIDE.range / (sigma * slack)
    # Both are first orders in the change of the force and in 1/t.
    assert edge_pair.long == pytest.approx(
        ROLL_OFF * np.sqrt(HURST / (1 + HURST) / share), rel=0.15
    )
    assert edge_pair.short == pytest.approx(
        ROLL_OFF * (share * (1 + HURST)) ** (0.5 / HURST), rel=0.25
    )
    surface = rough(5.0, ROLL_OFF, HURST, shortest=2.0)
    contact = contact_of_area(250e3, 20.0, 1.0, 400.0)
    edge_pair = formulas.formula_edges(surface, contact, 0.1)
    assert edge_pair[:2] == pytest.approx(edges(surface, contact, 0.1), rel=0.2)


def test_the_mean_curvature_of_summits_matches_random_surfaces():
    spectrum = rounded(1.0, 16.0)
    curvatures = []
    for number in range(3):
        h = random_surface(generator(1, "summits", number), 512, 1.0, spectrum).heights
        shifted = {(y, x): np.roll(h, (y, x), (0, 1)) for y in (-1, 0, 1) for x in (-1, 0, 1)}
        is_summit = h == np.max(list(shifted.values()), axis=0)
        neighbours = sum(shifted[shift] for shift in ((0, 1), (1, 0), (0, -1), (-1, 0)))
        curvatures.append(((4 * h - neighbours) / 2)[is_summit])
    curvature = formulas.SUMMIT_CURVATURE * np.sqrt(moment(rough_waves(spectrum, 1e9), 4)) / 2
    assert np.concatenate(curvatures).mean() == pytest.approx(curvature, rel=0.05)


@pytest.mark.parametrize("area", [30.0, 300.0, 6000.0])
def test_exponents_of_the_short_edge_match_the_theory(area):
    """2/(H + 2e) against sqrt(rho), 2e/(H + 2e) against sqrt(A), with e = (h - t) Phi/(t + L)."""
    spectrum = rough(60.0, 20e3, HURST, shortest=0.5)
    contact = contact_of_area(5e9, 1.0, 1.0, area)
    edge = formulas.formula_edges(spectrum, contact, 0.1).short
    step = 0.4
    waves = rough_waves(spectrum, contact.radius)
    wavelength, variance, gap = formulas.gaps_on_summits(waves, contact.radius, area)
    level = np.interp(np.log(edge), np.log(wavelength), level_of_gap(gap / np.sqrt(variance)))
    flattened = (formulas.hazard(level) - level) * special.ndtr(level)
    e = flattened / formulas.height_above(-level)
    for name, exponent in (("range", 2 / (HURST + 2 * e)), ("preload", 2 * e / (HURST + 2 * e))):
        short = [
            formulas.formula_edges(
                spectrum, replace(contact, **{name: getattr(contact, name) * factor}), 0.1
            ).short
            for factor in (np.exp(-step), np.exp(step))
        ]
        # The derivative by ln sqrt(x) is twice the derivative by ln x.
        assert np.log(short[1] / short[0]) / step == pytest.approx(exponent, abs=0.07)


def test_the_table_repeats_the_formulas_which_predict_held_out_edges():
    table = pd.read_csv(validate_edges.TABLE).set_index("surface")
    recomputed = pd.DataFrame(validate_edges.rows(3)).set_index("surface")
    pd.testing.assert_frame_equal(table.loc[recomputed.index], recomputed, rtol=1e-3)
    for name, max_error in (("short_edge", 1.3), ("long_edge", 1.5)):
        held_out = validation()[validation()[f"{name}_status"] == EDGE_FOUND]
        formula = table[name][held_out["surface"].astype(str)].to_numpy()
        assert np.exp(np.median(abs(np.log(held_out[name] / formula)))) < max_error


def test_an_almost_smooth_surface_has_no_edges():
    assert np.isnan(formulas.formula_edges(rough(0.01), WIDE, 0.1)).all()
