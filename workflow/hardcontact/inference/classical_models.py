"""Classical models of rough adhesion, applied to the roughness of Table 1.

The models need radii, heights and distances of asperities, which Table 1 does not give; how they
follow from rms height, slope and curvature is assumed and is described with each model. Lengths in
nm, forces in N, works of adhesion in J/m².
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from hardcontact.inference.rough_sphere import fuller_tabor, maugis_rough_dmt, rabinovich, rumpf
from hardcontact.inference.smooth_sphere import Values

__all__ = ["Contact", "MODELS", "Model", "Roughness"]

# Close-packed hemispheres of radius r, heights from their base: rms² = π r²/4√3.
HEMISPHERE_OVER_RMS = (4 * np.sqrt(3) / np.pi) ** 0.5


class Contact(NamedTuple):
    """Sphere and materials, the same for all models.

    Attributes
    ----------
    radius : float
        Of the sphere, in nm.
    modulus : float
        Effective modulus E* in Pa.
    spacing : float
        Equilibrium spacing in nm.
    """

    radius: float
    modulus: float
    spacing: float


class Roughness(NamedTuple):
    """Three rows of Table 1.

    Attributes
    ----------
    height, slope, curvature : array (..., surface)
        Rms values in nm, 1 and nm⁻¹.
    """

    height: np.ndarray
    slope: np.ndarray
    curvature: np.ndarray


class Model(NamedTuple):
    """A classical model of the adhesion of a rough sphere.

    Attributes
    ----------
    label : str
        Its name in figures.
    force : callable
        The pull-off force in N for a work of adhesion, a Roughness and a Contact.
    proportional : bool
        Whether the force is proportional to the work of adhesion.
    roughness : str
        How its asperities follow from rms values.
    verified : str
        Against which source its equations were checked.
    """

    label: str
    force: Callable[[Values, Roughness, Contact], Values]
    proportional: bool
    roughness: str
    verified: str


def _rumpf_height(work: Values, roughness: Roughness, contact: Contact) -> Values:
    radius = HEMISPHERE_OVER_RMS * roughness.height
    return rumpf(work, contact.radius, radius, contact.spacing)


def _rumpf_curvature(work: Values, roughness: Roughness, contact: Contact) -> Values:
    return rumpf(work, contact.radius, 1 / roughness.curvature, contact.spacing)


def _rabinovich(work: Values, roughness: Roughness, contact: Contact) -> Values:
    distance = 2 * np.pi * roughness.height / roughness.slope
    return rabinovich(work, contact.radius, roughness.height, distance, contact.spacing)


def _fuller_tabor(work: Values, roughness: Roughness, contact: Contact) -> Values:
    radius = 1 / roughness.curvature
    return fuller_tabor(work, contact.radius, roughness.height, radius, contact.modulus)


def _maugis(work: Values, roughness: Roughness, contact: Contact) -> Values:
    radius = 1 / roughness.curvature
    return maugis_rough_dmt(work, contact.radius, roughness.height, radius, contact.modulus)


ASPERITIES = (
    "Gaussian asperity heights of standard deviation rms height, asperity radius 1/rms curvature "
    "(both assumed)"
)
UNVERIFIED = "unverified against the primary source"

MODELS = {
    "rumpf_height": Model(
        "Rumpf (height)",
        _rumpf_height,
        True,
        "hemispheres of radius 1.485 rms height (close-packed; assumed)",
        UNVERIFIED,
    ),
    "rumpf_curvature": Model(
        "Rumpf (curvature)",
        _rumpf_curvature,
        True,
        "hemispheres of radius 1/rms curvature (assumed)",
        UNVERIFIED,
    ),
    "rabinovich": Model(
        "Rabinovich",
        _rabinovich,
        True,
        "rms height; distance of peaks 2 pi rms height / rms slope, that of one wavelength "
        "(assumed)",
        f"definition of the asperity: abstract of the primary source; coefficients: {UNVERIFIED}",
    ),
    "fuller_tabor": Model(
        "Fuller–Tabor",
        _fuller_tabor,
        False,
        ASPERITIES,
        f"assumptions and JKR equations: Greenwood, Tribol. Lett. 65 (2017) 159; {UNVERIFIED}",
    ),
    "maugis": Model("Maugis", _maugis, False, ASPERITIES, UNVERIFIED),
}
