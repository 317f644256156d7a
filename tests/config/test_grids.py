"""Grids of substitutes: how far their contacts can lie apart in height."""

import numpy as np
import pandas as pd
import pytest
from refusals import assert_says, refusal
from repository import ROOT

from hardcontact.config.checks import SUBSTITUTE_RELIEF, surface_grid
from hardcontact.config.grids import master_megabytes, refuse_beyond_memory
from hardcontact.contact.bearing_area import all_lowest_gaps
from hardcontact.contact.contact import Contact
from hardcontact.contact.geometry import bodies
from hardcontact.surfaces.spectrum import WAVEVECTORS, Spectrum
from hardcontact.surfaces.substitute_spectra import described_rms_height, from_description
from hardcontact.surfaces.synthesis import random_surface

CONFIG = {"scan": {"pixels": 512, "size": 5000.0}, "scales": {"large": {"tiles": 2}}}
HEADER = (
    "longest_nm,shortest_nm,model,plateau_nm4,rolloff_nm,hurst,hurst_change,table,basis,source\n"
)


def rows(path):
    return pd.DataFrame({"source": ["substitute"], "path": [str(path)]})


@pytest.mark.parametrize("name", ["crn_rougher", "crn_smoother_upper"])
def test_contacts_on_a_described_surface_lie_within_its_relief(name):
    path = ROOT / f"resources/spectra/{name}.csv"
    grid = surface_grid(CONFIG, name, rows(path))
    density = Spectrum(WAVEVECTORS, from_description(path, None, None)[0])
    contact = Contact(radius=250e3, preload=1e-5, hardness=25e9, window=12.5e3, count=8)
    for seed in range(2):
        surface = random_surface(np.random.default_rng(seed), 256, 20e3 / 256, density)
        pair = bodies(surface, None, contact)
        highest_gap = max(one.gaps[0] for one in all_lowest_gaps(pair, 1).values())
        apart = float(surface.heights.max() + highest_gap)
        assert 0.2 * grid.relief < apart < grid.relief


def test_rms_height_is_that_of_the_waves_of_the_domain(tmp_path):
    path = tmp_path / "one.csv"
    path.write_text(f"{HEADER}inf,0.1,self-affine,1e9,1000,1.0,,,measured,none\n")
    # (1/2 pi) of C_0 q_r^2 over the plateau, up to the domain, and over the slope, q^-4.
    roll_off, longest = 2 * np.pi / 1000, 2 * np.pi / 4000
    variance = 1e9 / (2 * np.pi) * ((roll_off**2 - longest**2) / 2 + roll_off**2 / 2)
    assert described_rms_height(path, 4000.0) == pytest.approx(variance**0.5, rel=0.02)


def test_a_substitute_of_the_paper_keeps_its_bound():
    grid = surface_grid(CONFIG, "mcd", rows(ROOT / "resources/spectra/mcd.csv"))
    assert grid.relief == SUBSTITUTE_RELIEF


# Memory of masters: the default's as before, the largest within a machine of 24 GB


def test_memory_grows_with_pixels_and_the_largest_master_fits_into_20_gb():
    assert 4000 < master_megabytes(16384, 3000) < 6000
    assert 15000 < master_megabytes(32768, 3000) < 20000


def test_a_master_beyond_the_memory_is_refused():
    refuse_beyond_memory("scales.small.pixels", 32768, 24000)
    refuse_beyond_memory("scales.small.pixels", 16384, 100)  # accepted everywhere, as before
    message = refusal(refuse_beyond_memory, "scales.small.pixels", 32768, 8000)
    assert_says(message, "scales.small.pixels", "16384", "8 GB", "32768")
