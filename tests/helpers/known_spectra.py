"""Spectra whose rms values are known, on the grid of the study, and contacts of a known area."""

import numpy as np

from hardcontact.contact.contact import Contact
from hardcontact.surfaces.spectrum import WAVEVECTORS, Spectrum


def self_affine_spectrum(rms=4.0, rolloff=1000.0, hurst=0.8, shortest=20.0):
    """Return a self-affine spectrum that ends at a shortest wavelength; all lengths in nm."""
    density = np.maximum(WAVEVECTORS * rolloff / (2 * np.pi), 1.0) ** (-2 - 2 * hurst)
    density[2 * np.pi / WAVEVECTORS < shortest] = 0
    height = np.sqrt(np.trapezoid(density * WAVEVECTORS**2, np.log(WAVEVECTORS)) / (2 * np.pi))
    return Spectrum(WAVEVECTORS, density * (rms / height) ** 2)


def gaussian_spectrum(rms=4.0, length=100.0):
    """Return the spectrum of a smooth surface with the autocorrelation rms² exp(-d²/(2 length²)).

    The variance of the slope of its profiles is (rms/length)².
    """
    return Spectrum(
        WAVEVECTORS, 2 * np.pi * (rms * length) ** 2 * np.exp(-((WAVEVECTORS * length) ** 2) / 2)
    )


def contact_of_area(radius, rho, work, area):
    """Return a contact whose preload an area in nm² carries, at a hardness of 1 N/nm²."""
    return Contact(radius=radius, rho=rho, work=work, preload=area, hardness=1e18)


#: The paper's contact: a preload of 10 µN over a hardness of 25 GPa is 400 nm².
PAPER_CONTACT = contact_of_area(radius=250e3, rho=5.6, work=0.0463, area=400.0)
