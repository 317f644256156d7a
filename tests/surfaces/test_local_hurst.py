"""Local Hurst exponents: known ones come back from their own C_1D; those of chromium nitride."""

import os

import numpy as np
import pandas as pd
import pytest
from measurements import profile_of
from repository import ROOT

from hardcontact.surfaces import spectral_models
from hardcontact.surfaces.local_hurst import fitted_local_hurst, local_power_laws
from hardcontact.surfaces.measured_spectrum import profile_from_isotropic
from hardcontact.surfaces.spectrum import WAVEVECTORS
from hardcontact.surfaces.substitute_spectra import from_description

#: Where the digitised points lie, which are not part of the project.
POINTS = os.environ.get("HARDCONTACT_CRN_PSD", "")
#: Wavevectors in rad/nm where the end of the table, 0.1 nm, hardly counts.
MEASURED = 2 * np.pi / np.logspace(5, 1, 33)
EDGES = np.array([2e4, 1e3, 100.0])
#: The descriptions of chromium nitride, with the surface and the statistic of their points.
COATINGS = {
    f"{surface}{ending}": (surface, statistic)
    for surface in ("crn_smoother", "crn_rougher")
    for ending, statistic in {
        "": "median", "_lower": "lower_quartile", "_upper": "upper_quartile"
    }.items()
}  # fmt: skip
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


def described(name):
    """Return the description of a coating: C_iso, and the bands that are fitted, with their edges.

    The first band is constant down to its edge, the last continues beyond the source.
    """
    density, bands, calibrated = from_description(
        ROOT / f"resources/spectra/{name}.csv", NO_TABLE1, None
    )
    assert calibrated == [] and bands.basis.tolist() == [
        *["measured"] * (len(bands) - 1),
        "assumed",
    ]
    fitted = bands.iloc[:-1]
    return density, fitted, np.append(fitted.rolloff_nm[0], fitted.longest_nm[1:])


@pytest.mark.parametrize("name", COATINGS)
def test_description_of_a_coating_is_what_a_fit_to_its_published_spectrum_gives(name):
    if not POINTS:
        pytest.skip("HARDCONTACT_CRN_PSD does not say where the digitised points are")
    _, bands, edges = described(name)
    points, (surface, statistic) = pd.read_csv(POINTS), COATINGS[name]
    points = points[(points.surface == surface) & (points.statistic == statistic)]
    points = points[points.wavevector_per_nm > WAVEVECTORS[0] * (1 - 1e-3)]
    fit = fitted_local_hurst(
        points.wavevector_per_nm.to_numpy(float), points.c1d_nm3.to_numpy(float), edges
    )
    np.testing.assert_allclose(bands.hurst, fit.hurst, atol=2e-3)
    assert bands.plateau_nm4[0] == pytest.approx(fit.plateau, rel=2e-3)
    rms, largest = np.sqrt((fit.misfit**2).mean()), np.abs(fit.misfit).max()
    stated = f"misfit of ln C_1D {rms:.2f} rms and {largest:.2f} at most over {len(points)} points"
    assert bands.source.str.endswith(stated).all()


@pytest.mark.parametrize("name", COATINGS)
def test_description_of_a_coating_makes_the_spectrum_that_was_fitted(name):
    density, bands, edges = described(name)
    fitted = local_power_laws(bands.plateau_nm4[0], bands.hurst.to_numpy(), edges).density
    inside = WAVEVECTORS < 2 * np.pi / 0.11
    # Edges lie between points of the table of spectra: each band begins up to half a cell off.
    np.testing.assert_allclose(density[inside], fitted[inside], rtol=0.15)
