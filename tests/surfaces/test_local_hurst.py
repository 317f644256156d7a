"""Local Hurst exponents: known ones come back from their own C_1D; those of chromium nitride."""

import os

import numpy as np
import pandas as pd
import pytest
from measurements import profile_of
from repository import ROOT

from hardcontact.study import chromium_nitride
from hardcontact.surfaces import spectral_models
from hardcontact.surfaces.local_hurst import fitted_local_hurst, local_power_laws
from hardcontact.surfaces.profile_conversion import profile_from_isotropic
from hardcontact.surfaces.spectrum import WAVEVECTORS, Spectrum
from hardcontact.surfaces.substitute_spectra import from_description

#: Where the digitised points lie, which are not part of the project.
POINTS = os.environ.get("HARDCONTACT_CRN_PSD", "")
#: Wavevectors in rad/nm where the end of the table, 0.1 nm, hardly counts.
MEASURED = 2 * np.pi / np.logspace(5, 1, 33)
EDGES = np.array([2e4, 1e3, 100.0])
NO_TABLE1 = pd.DataFrame({"value": [], "uncertainty": []})


def two_slopes(q):
    """C_iso constant above 20 µm, q^-3 to 1 µm, q^-4.4 below."""
    first, second = (np.maximum(q * edge / (2 * np.pi), 1.0) for edge in (2e4, 1e3))
    return 1e9 * first**-3.0 * second**-1.4


@pytest.mark.parametrize("hurst", [0.2, 0.7, 1.2])
def test_profiles_of_a_power_law_are_those_of_its_closed_form(hurst):
    expected = MEASURED ** (-2 - 2 * hurst) * spectral_models.profile_from_isotropic_power_law(
        MEASURED, hurst
    )
    found = profile_from_isotropic(lambda q: q ** (-2 - 2 * hurst), MEASURED)
    np.testing.assert_allclose(found, expected, rtol=1e-3)


def test_profiles_of_two_slopes_are_those_of_another_integration():
    found = profile_from_isotropic(two_slopes, MEASURED)
    np.testing.assert_allclose(found, profile_of(two_slopes, MEASURED), rtol=2e-3)


def test_local_exponents_come_back_from_the_profiles_of_two_slopes():
    fit = fitted_local_hurst(MEASURED, profile_of(two_slopes, MEASURED), EDGES)
    assert fit.plateau == pytest.approx(1e9, rel=0.02)
    np.testing.assert_allclose(fit.hurst, [0.5, 1.2, 1.2], atol=0.03)
    assert np.abs(fit.misfit).max() < 0.03
    # Read off C_1D as if each band stood alone, the first exponent would be far off at the bend.
    slope = np.gradient(np.log(profile_of(two_slopes, MEASURED)), np.log(MEASURED))
    bend = np.argmin(np.abs(MEASURED - 2 * np.pi / 1.3e3))
    assert abs((-slope[bend] - 1) / 2 - 0.5) > 0.1


def test_scatter_of_a_spectrum_is_its_misfit():
    scatter = np.tile([0.2, -0.2], 17)[:33]
    fit = fitted_local_hurst(MEASURED, profile_of(two_slopes, MEASURED) * np.exp(scatter), EDGES)
    np.testing.assert_allclose(fit.misfit, -scatter, atol=0.1)


@pytest.mark.parametrize("surface", chromium_nitride.EDGES)
@pytest.mark.parametrize("statistic", chromium_nitride.STATISTICS)
def test_description_of_a_coating_is_its_published_spectrum(surface, statistic, tmp_path):
    if not POINTS:
        pytest.skip("HARDCONTACT_CRN_PSD does not say where the digitised points are")
    name = f"{surface}{chromium_nitride.STATISTICS[statistic]}"
    density, bands, _ = from_description(ROOT / f"resources/spectra/{name}.csv", NO_TABLE1, None)
    wavevector, profile = chromium_nitride.points(pd.read_csv(POINTS), surface, statistic)
    found = profile_from_isotropic(Spectrum(WAVEVECTORS, density), wavevector)
    misfit = np.log(found / profile)
    stated = bands.source[0].split("misfit of ln C_1D ")[1]
    rms, largest = (float(stated.split()[place]) for place in (0, 3))
    # Edges lie between points of the table of spectra, so that a band begins up to half a cell off.
    assert np.sqrt((misfit**2).mean()) == pytest.approx(rms, abs=0.03)
    assert np.abs(misfit).max() == pytest.approx(largest, abs=0.08)


@pytest.mark.parametrize("surface", chromium_nitride.EDGES)
def test_description_of_a_fit_is_its_spectrum(surface, tmp_path):
    edges = np.array(chromium_nitride.EDGES[surface])
    hurst = np.linspace(0.1, 1.0, len(edges))
    fit = chromium_nitride.LocalHurst(2e12, hurst, np.array([0.1, -0.1]))
    path = tmp_path / "described.csv"
    chromium_nitride.description(fit, surface, "median").to_csv(path, index=False)
    density, bands, calibrated = from_description(path, NO_TABLE1, None)
    assert calibrated == [] and set(bands.basis) == {"measured", "assumed"}
    assert "misfit of ln C_1D 0.10 rms and 0.10 at most over 2 points" in bands.source[0]
    expected = local_power_laws(2e12, hurst, edges).density
    inside = WAVEVECTORS < 2 * np.pi / 0.11
    np.testing.assert_allclose(density[inside], expected[inside], rtol=0.06)
