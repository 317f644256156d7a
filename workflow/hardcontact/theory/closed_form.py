"""The pull-off force of a sphere on a Gaussian surface, in closed form from the surface's spectrum.

The force relative to the force of DMT, 2 pi R W, has three terms, averaged over positions: the
attraction of all points below the sphere (surface term), of the summits that touch (summit term),
and of the area in contact (contact term). workflow/report/theory.md (The mean force) derives them.
Summits (`summits`) are rough themselves: the same terms give the force on a rough summit relative
to a smooth one.
"""

from dataclasses import dataclass, replace
from enum import StrEnum

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike
from scipy import special

from hardcontact.base.arrays import Floats
from hardcontact.base.formatting import format_quantity
from hardcontact.contact.contact import Contact
from hardcontact.contact.hertz_jkr_dmt import dmt_pull_off, smooth_pull_off
from hardcontact.inference.edges import CUTOFF, find_edges, logarithmic_limits
from hardcontact.surfaces.spectrum import Spectrum, spectral_moment
from hardcontact.theory.summits import (
    ApexDistribution,
    apex_distribution,
    find_rough_spectrum,
    spectrum_between,
)

#: Share of the force on a smooth surface, without the area in contact, above which a surface counts
#: as smooth.
SMOOTH_SHARE = 0.9
#: Largest number of nested generations: summits on summits on the surface.
MAX_GENERATIONS = 8
#: Waves shorter than this number of half-widths of a summit are roughness on it. Chosen on designed
#: surfaces: resources/validation/README.md says what other values would change.
MAX_WAVELENGTH_PER_HALF_WIDTH = 2.5
#: Smallest rms height on a summit that counts as roughness, in ranges of adhesion. Ten times this
#: value would hardly change a force (resources/validation/README.md).
MIN_ROUGHNESS_PER_RANGE = 0.005
#: Number of cutoffs, from end to end of the spectrum, at which edges are looked for.
CUTOFF_COUNT = 60


class Regime(StrEnum):
    """Whether roughness hardly changes the force, many points carry it, or a few summits do."""

    SMOOTH, MANY_POINTS, FEW_SUMMITS = "smooth", "many_points", "few_summits"


@dataclass(frozen=True)
class ClosedForm:
    """The mean pull-off force, with the apex height and the regime."""

    force: float  #: In N.
    dmt_ratio: float  #: Force relative to the force of DMT.
    rms_height: float  #: In nm, without the waves that the sphere follows.
    apex_height: float  #: Mean height of the apex in nm, positive above the mean plane.
    weibull_modulus: float  #: 0 if the apex is below the mean plane, infinite without roughness.
    regime: Regime


def contact_term(contact: Contact) -> float:
    """Return the contact term: the force of the area in contact relative to the force of DMT."""
    return contact.area / (2 * np.pi * contact.radius * contact.rho)


def wide_contact_message(contact: Contact) -> str:
    """Return a message if the contact area alone attracts as strongly as a smooth sphere, or ""."""
    term = contact_term(contact)
    if term < 1:
        return ""
    return (
        f"preload: expected less than {format_quantity(contact.preload / term, 'N')} at this "
        f"hardness, radius and range, found {format_quantity(contact.preload, 'N')}: the contact "
        "alone would stick like a smooth sphere"
    )


def smooth_force(contact: Contact) -> float:
    """Return the force (N) on a smooth surface: of DMT, plus that of the area in contact."""
    return float(smooth_pull_off(contact.work, contact.radius, contact.area, contact.rho))


def surface_term(apex_level: ArrayLike, relative_rms: ArrayLike) -> Floats:
    """Return the surface term exp(s²/2 - ts) Φ(t - s) at levels t and relative rms heights s.

    A level t is the height of the apex relative to the rms height, s the rms height relative to the
    range of adhesion.
    """
    t = np.asarray(apex_level)
    s = np.asarray(relative_rms)
    return np.asarray(np.exp(s**2 / 2 - t * s + special.log_ndtr(t - s)))


def closed_form(
    spectrum: Spectrum, contact: Contact, *, rough_close_points: bool = True
) -> ClosedForm:
    """Return the mean pull-off force over contacts of a sphere on a Gaussian surface.

    The force is that of DMT times the sum of surface term, summit term and contact term (Eq. 1 of
    theory.md). The sphere rests on the highest summits, at a level that differs between positions,
    so the first two terms are means over the distribution of this level. If `rough_close_points`,
    points just below the sphere lie on rough summits, too.
    """
    dmt_force = float(dmt_pull_off(contact.work, contact.radius))
    rough_spectrum = find_rough_spectrum(spectrum, contact.radius)
    if rough_spectrum is None:
        force = smooth_force(contact)
        return ClosedForm(force, force / dmt_force, 0.0, 0.0, np.inf, Regime.SMOOTH)
    sigma = float(np.sqrt(spectral_moment(rough_spectrum, 0)))
    apex = apex_distribution(rough_spectrum, contact.radius, contact.area)
    mean_surface_term, summit_term = _mean_terms(rough_spectrum, apex, contact, rough_close_points)
    dmt_ratio = mean_surface_term + summit_term + contact_term(contact)
    apex_height = float(sigma * apex.mean())
    weibull_modulus = max(contact.rho * apex_height / sigma**2, 0.0)
    regime = Regime.FEW_SUMMITS if weibull_modulus < 1 else Regime.MANY_POINTS
    if mean_surface_term + summit_term > SMOOTH_SHARE:
        regime = Regime.SMOOTH
    return ClosedForm(dmt_force * dmt_ratio, dmt_ratio, sigma, apex_height, weibull_modulus, regime)


def _mean_terms(
    spectrum: Spectrum,
    apex: ApexDistribution,
    contact: Contact,
    rough_close_points: bool,
    generations_left: int = MAX_GENERATIONS,
) -> tuple[float, float]:
    """Return the surface term and the summit term, averaged over levels of the apex.

    A summit may be rough itself. `summit_ratio`, beta in theory.md, is the force on it relative to
    a smooth summit: the sum of the same two terms for the roughness on the summit. So this function
    calls itself, until a summit is smooth or no generation is left. `summit_ratio` multiplies the
    summit term and, if `rough_close_points`, the share of close points in the surface term.
    """
    relative_rms = np.sqrt(spectral_moment(spectrum, 0)) / contact.rho
    summit_ratio = 1.0
    rough_summit = _roughness_on_summit(spectrum, apex, contact)
    if rough_summit is not None and generations_left:
        summit_spectrum, summit_contact = rough_summit
        summit_apex = apex_distribution(summit_spectrum, summit_contact.radius, summit_contact.area)
        terms = _mean_terms(
            summit_spectrum, summit_apex, summit_contact, rough_close_points, generations_left - 1
        )
        summit_ratio = min(sum(terms), 1.0)
    surface_terms = surface_term(apex.levels, relative_rms)
    if rough_close_points:
        surface_terms = surface_terms * (1 - (1 - summit_ratio) * _close_share(apex, relative_rms))
    return apex.mean(surface_terms), summit_ratio * apex.mean(special.ndtr(-apex.levels))


def _close_share(apex: ApexDistribution, relative_rms: float) -> Floats:
    """Return the share (n,) of close points in the attraction (theory.md, Close points).

    The gap of a close point is less than eta, the mean height of a summit. If the sphere were lower
    by eta, close points would no longer attract, and all others e^(eta/rho) times as strongly. With
    M for `both_terms`, the others therefore have the share e^(-eta/rho) M(m - eta)/M(m).
    """
    summit_height = 1 / max(apex.mean(), 1.0)  # eta relative to the rms height

    def both_terms(level: Floats) -> Floats:
        """Return the sum of surface term and summit term at levels of the apex."""
        return surface_term(level, relative_rms) + special.ndtr(-level)

    other_points = np.exp(-summit_height * relative_rms) * both_terms(apex.levels - summit_height)
    return np.asarray(1 - other_points / both_terms(apex.levels))


def _roughness_on_summit(
    spectrum: Spectrum, apex: ApexDistribution, contact: Contact
) -> tuple[Spectrum, Contact] | None:
    """Return spectrum and contact of a rough summit (theory.md, Rough summits), None if smooth.

    Its spectrum has the waves that are short beside the summit. Its contact is that of a sphere
    with the radius of the summit, which cannot carry more than hardness times its area.
    """
    min_wavevector = 2 * np.pi / (MAX_WAVELENGTH_PER_HALF_WIDTH * apex.half_width)
    summit_spectrum = spectrum_between(spectrum, min_wavevector, np.inf)
    min_variance = (MIN_ROUGHNESS_PER_RANGE * contact.rho) ** 2
    if summit_spectrum is None or spectral_moment(summit_spectrum, 0) < min_variance:
        return None
    sigma = np.sqrt(spectral_moment(spectrum, 0))
    radius = min(apex.half_width**2 * max(apex.mean(), 1.0) / (2 * sigma), contact.radius)
    summit_load = contact.hardness * np.pi * apex.half_width**2 * 1e-18  # nm² to m²
    summit_contact = replace(contact, radius=radius, preload=min(contact.preload, summit_load))
    return summit_spectrum, summit_contact


def filtered_spectrum(spectrum: Spectrum, side: str, cutoff: float) -> Spectrum:
    """Return a spectrum without waves below (``"short"``) or above (``"long"``) a cutoff in nm."""
    limit = 2 * np.pi / cutoff
    lowest, highest = (0.0, limit) if side == "short" else (limit, np.inf)
    filtered = spectrum_between(spectrum, lowest, highest)
    return filtered or Spectrum(spectrum.wavevector, np.zeros_like(spectrum.density))


def critical_band(spectrum: Spectrum, contact: Contact, tolerance: float) -> tuple[float, float]:
    """Return the short and the long edge (nm) of the band of wavelengths that decide the force.

    From either end of the spectrum, more and more waves are removed, until the force has changed by
    the tolerance. The edge lies between the last two cutoffs. It is NaN if no cutoff changes the
    force so much.
    """
    wavelengths = spectrum.wavelength[spectrum.density > 0]
    if not len(wavelengths):
        return np.nan, np.nan
    cutoffs = np.geomspace(wavelengths[-1], wavelengths[0], CUTOFF_COUNT)
    limits = logarithmic_limits(tolerance)
    # Rough close points improve forces on held-out surfaces, but not edges.
    unfiltered = closed_form(spectrum, contact, rough_close_points=False).dmt_ratio

    def edge_of_side(side: str, side_cutoffs: Floats) -> float:
        """Return the edge of a side; no wave is removed at the first cutoff."""
        curve = [0.0]  # ln of the force relative to that with all waves
        for cutoff in side_cutoffs[1:]:
            filtered = filtered_spectrum(spectrum, side, cutoff)
            dmt_ratio = closed_form(filtered, contact, rough_close_points=False).dmt_ratio
            curve.append(np.log(dmt_ratio / unfiltered))
            if not limits[0] <= curve[-1] <= limits[1]:
                break
        coordinates = {CUTOFF: side_cutoffs[: len(curve)], "side": side}
        return float(find_edges(xr.DataArray(curve, coordinates, [CUTOFF]), limits)["edge"])

    return edge_of_side("short", cutoffs), edge_of_side("long", cutoffs[::-1])
