"""Which regime a surface is in, from its spectrum: what sets the force and both edges of the band.

Three comparisons of lengths, all of the closed form (`closed_form`) at one sphere, range and load:

- sigma/rho against m/sigma: the attraction comes from many points, or is frozen to single peaks.
- The diameter 2 sqrt(F/(pi H)) of the contact against the short edge. The closed form knows the
  range of adhesion, but not that a contact flattens what is smaller than itself: where its edge is
  shorter than the contact, the contact sets the edge, otherwise the range.
- The reach sqrt(2 R rho) of the attraction against the roll-off of the spectrum. Roughness that is
  longer than the reach lifts sphere and attraction alike, and beyond the roll-off there is none:
  the shorter of the two stops the long edge.
"""

from collections.abc import Mapping

import numpy as np
import xarray as xr

from hardcontact.adhesion.closed_form import Contact, closed_form, edges
from hardcontact.surfaces.spectrum import Spectrum, roll_off

__all__ = ["CONTACT", "RANGE", "REACH", "ROLL_OFF", "edge_regimes"]

#: What sets the short edge.
CONTACT, RANGE = "contact", "range"
#: What stops the long edge.
ROLL_OFF, REACH = "roll-off", "reach"


def edge_regimes(spectra: Mapping[str, Spectrum], contact: Contact, tolerance: float) -> xr.Dataset:
    """Return the regime of every surface, and the lengths that decide it.

    Parameters
    ----------
    spectra : mapping of str to Spectrum
        By surface.
    contact : Contact
        Sphere, attraction, area.
    tolerance : float
        Relative change of the force that counts.

    Returns
    -------
    xarray.Dataset
        Over surface, lengths in nm: ``rough_height`` (sigma), ``approach`` (m), ``freezing``,
        (sigma/rho)/(m/sigma), ``regime`` of `closed_form`, ``predicted_edge`` (surface, side), NaN
        where there is none, ``short_edge_from``, empty there, and ``long_edge_from``. Of all:
        ``contact_diameter`` and ``attraction_reach``.
    """
    diameter = 2 * np.sqrt(contact.area / np.pi)
    reach = np.sqrt(2 * contact.radius * contact.rho)
    forms = [closed_form(one, contact) for one in spectra.values()]
    predicted = np.array([edges(one, contact, tolerance) for one in spectra.values()])
    short = np.select([np.isnan(predicted[:, 0]), predicted[:, 0] < diameter], ["", CONTACT], RANGE)
    ends = np.array([roll_off(one) for one in spectra.values()])
    nm, one = {"units": "nm"}, {"units": "1"}
    return xr.Dataset(
        {
            "rough_height": ("surface", [form.rms_height for form in forms], nm),
            "approach": ("surface", [form.closest_approach for form in forms], nm),
            "freezing": ("surface", [form.freezing for form in forms], one),
            "regime": ("surface", [form.regime for form in forms]),
            "predicted_edge": (("surface", "side"), predicted, nm),
            "short_edge_from": ("surface", short),
            "long_edge_from": ("surface", np.where(reach < ends, REACH, ROLL_OFF)),
            "contact_diameter": ((), diameter, nm),
            "attraction_reach": ((), reach, nm),
        },
        {"surface": list(spectra), "side": ["small", "large"]},
    )
