"""The octaves of wavelengths that the force follows most, on a scan or from a spectrum."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import xarray as xr

from hardcontact.base.number import Number
from hardcontact.contact.contact import Contact
from hardcontact.inference.octaves import (
    FACTORS,
    OCTAVE_LIMITS,
    STEP,
    forces_with,
    middles_within,
    octave_forces,
    strongest_octaves,
)
from hardcontact.own.own_spectrum import OwnSpectrum
from hardcontact.own.scan_force import (
    MAX_PIXELS,
    pixels_per_contact,
    shortest_range_on,
    stitched_map,
    window_of_scan,
)
from hardcontact.surfaces.height_map import HeightMap
from hardcontact.surfaces.spectrum import Floats, Spectrum
from hardcontact.theory.closed_form import closed_form
from hardcontact.theory.prediction import trim_spectrum

#: Contacts along a side of their array. A trade of time: on a scan of 512 pixels 8 moved no
#: derivative by more than 0.03, and 20 by no more than 0.02.
CONTACTS = 12
#: Most contact pixels of all contacts with their images in the window. An octave takes two force
#: sums, so that fewer are quick than for the force on the scan.
MAX_CONTACT_PIXELS = 2**19


def predicted_octaves(user_spectrum: OwnSpectrum, contact: Contact) -> Iterator[Number]:
    """Yield the `strongest_octaves` whose middles the user's files show.

    They have the status "on_scan" if the only scan `permits_contacts`, otherwise "closed_form".
    There are none if there are steep edges, too, for which the closed form does not hold.
    """
    spectrum = trim_spectrum(user_spectrum.spectrum)
    longest, shortest = 2 * np.pi / spectrum.wavevector[[0, -1]]
    octaves = OCTAVE_LIMITS[middles_within(OCTAVE_LIMITS, shortest, longest)]
    scans = user_spectrum.scans
    if len(scans) == 1 and len(octaves) and permits_contacts(scans[0], contact):
        derivatives = derivatives_on_scan(scans[0], octaves, contact)
        status = "on_scan"
    elif any("edges" in scan.defects for scan in scans):
        return
    else:
        derivatives = derivatives_in_closed_form(spectrum, octaves, contact)
        status = "closed_form"
    sensitivity = xr.Dataset({"octave_sensitivity": ("octave", derivatives)}, {"octave": octaves})
    for number in strongest_octaves(sensitivity):
        yield number._replace(status=status)


def permits_contacts(scan: HeightMap, contact: Contact) -> bool:
    """Return whether a levelled scan is a map whose force sums are quick and resolve the range."""
    if scan.kind != "map" or scan.pixels > MAX_PIXELS:
        return False
    is_quick = pixels_per_contact(scan, contact) * CONTACTS**2 <= MAX_CONTACT_PIXELS
    return is_quick and shortest_range_on(scan, contact) <= contact.range


def derivatives_on_scan(scan: HeightMap, octaves: Floats, contact: Contact) -> Floats:
    """Return d ln F / d ln a (octave,) of the mean force sum over contacts on a levelled map.

    The octaves follow each other; they are given by their shortest wavelengths (nm).
    """
    contact = replace(contact, window=window_of_scan(scan, contact), count=CONTACTS)
    limits = [*octaves, 2 * octaves[-1]]
    forces = octave_forces(stitched_map(scan), limits, forces_with(contact)).mean(axis=(-2, -1))
    return np.asarray(np.log(forces[:, 1] / forces[:, 0]) / (2 * STEP))


def derivatives_in_closed_form(spectrum: Spectrum, octaves: Floats, contact: Contact) -> Floats:
    """Return d ln F / d ln a (octave,) of the closed form for a spectrum."""
    wavelength = 2 * np.pi / spectrum.wavevector

    def log_force(octave: float, factor: float) -> float:
        """Return the logarithm of the force with the amplitude of one octave times a factor."""
        is_inside = (octave <= wavelength) & (wavelength < 2 * octave)
        density = spectrum.density * np.where(is_inside, factor**2, 1.0)
        return float(np.log(closed_form(Spectrum(spectrum.wavevector, density), contact).force))

    weak, strong = ([log_force(octave, factor) for octave in octaves] for factor in FACTORS)
    return np.subtract(strong, weak) / (2 * STEP)
