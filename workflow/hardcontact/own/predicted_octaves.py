"""The octaves of wavelengths that matter most to the force on the user's only map.

Forces are summed over the pixels of the map or, if this is not possible, come from the closed form.
"""

from collections.abc import Iterator
from enum import StrEnum

import numpy as np
import xarray as xr

from hardcontact.base.arrays import Floats
from hardcontact.base.number import Number
from hardcontact.contact.contact import Contact
from hardcontact.contact.pull_off import make_force_function
from hardcontact.inference.octaves import (
    AMPLITUDE_FACTORS,
    OCTAVE_LIMITS,
    STEP,
    octave_forces,
    octaves_within,
    strongest_octaves,
)
from hardcontact.own.own_spectrum import OwnSpectrum
from hardcontact.own.scan_contact import contact_on_scan, find_obstacle
from hardcontact.surfaces.height_map import HeightMap, mirror_in_float32
from hardcontact.surfaces.spectrum import Spectrum
from hardcontact.theory.closed_form import closed_form
from hardcontact.theory.prediction import trim_spectrum


class OctaveStatus(StrEnum):
    """Whether the effect of an octave is that on the sum over a scan, or on the closed form."""

    ON_SCAN, IN_CLOSED_FORM = "on_scan", "closed_form"


def predicted_octaves(own_spectrum: OwnSpectrum, contact: Contact) -> Iterator[Number]:
    """Yield the octaves that matter most to the force, among those whose middle the files show.

    Scans with steep sidewalls have none in closed form, because their heights are not Gaussian.
    """
    spectrum = trim_spectrum(own_spectrum.spectrum)
    longest, shortest = spectrum.wavelength[[0, -1]]
    octaves = OCTAVE_LIMITS[octaves_within(OCTAVE_LIMITS, shortest, longest)]
    scans = own_spectrum.scans
    obstacle, _ = find_obstacle(scans, contact, len(AMPLITUDE_FACTORS) * len(octaves))
    if len(octaves) and not obstacle:
        derivatives = derivatives_on_scan(scans[0], octaves, contact)
        status = OctaveStatus.ON_SCAN
    elif any("sidewalls" in scan.defects for scan in scans):
        return
    else:
        derivatives = derivatives_in_closed_form(spectrum, octaves, contact)
        status = OctaveStatus.IN_CLOSED_FORM
    sensitivity = xr.Dataset({"octave_sensitivity": ("octave", derivatives)}, {"octave": octaves})
    for number in strongest_octaves(sensitivity):
        yield number._replace(status=status)


def derivatives_on_scan(scan: HeightMap, octaves: Floats, contact: Contact) -> Floats:
    """Return d ln F / d ln a (octave,) of the mean force sum over contacts on a levelled map.

    Neighbouring octaves are given by their shortest wavelengths (nm).
    """
    limits = [*octaves, 2 * octaves[-1]]
    compute_forces = make_force_function(contact_on_scan(scan, contact))
    forces = octave_forces(mirror_in_float32(scan), limits, compute_forces).mean(axis=(-2, -1))
    return np.asarray(np.log(forces[:, 1] / forces[:, 0]) / (2 * STEP))


def derivatives_in_closed_form(spectrum: Spectrum, octaves: Floats, contact: Contact) -> Floats:
    """Return d ln F / d ln a (octave,) of the closed form for a spectrum."""
    wavelength = spectrum.wavelength

    def log_force(octave: float, factor: float) -> float:
        """Return the logarithm of the force with the amplitude of one octave times a factor."""
        is_inside = (octave <= wavelength) & (wavelength < 2 * octave)
        density = spectrum.density * np.where(is_inside, factor**2, 1.0)
        return float(np.log(closed_form(Spectrum(spectrum.wavevector, density), contact).force))

    weak, strong = AMPLITUDE_FACTORS
    changes = [log_force(octave, strong) - log_force(octave, weak) for octave in octaves]
    return np.array(changes) / (2 * STEP)
