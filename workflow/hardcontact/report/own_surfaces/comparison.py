"""The force on one surface relative to that on another, and the octaves that cause the ratio.

The ratio holds for any work of adhesion that both surfaces have. An octave contributes to its
logarithm the change of the octave's ln(amplitude) times the mean sensitivity d ln F / d ln a.
"""

import math
from collections.abc import Iterator

import numpy as np

from hardcontact.base.arrays import Floats
from hardcontact.base.number import Number, NumberStatus
from hardcontact.inference.octaves import OCTAVES_NAMED
from hardcontact.report.own_surfaces.datasets import Datasets, forces_at_range
from hardcontact.report.own_surfaces.reliable_wavelengths import shown_octaves
from hardcontact.report.quantities import number_of
from hardcontact.surfaces.spectrum import spectrum_of_dataset

#: Wavevectors per octave at which a spectrum is integrated.
WAVEVECTORS_PER_OCTAVE = 33


def comparison_numbers(data: Datasets, reference: Datasets) -> Iterator[Number]:
    """Yield the ratio of the forces on a surface and a reference, and the octaves that cause it.

    ``force_over_reference_octave_1`` is the shortest wavelength of the octave that contributes
    most, ``force_over_reference_octave_1_factor`` its factor in the ratio. Scans are independent,
    so that the errors of both logarithms add in squares.
    """
    force = number_of(forces_at_range(data.force), "force")
    reference_force = number_of(forces_at_range(reference.force), "force")
    ratio = force.value / reference_force.value
    fall, rise = np.hypot(_log_distances(force), _log_distances(reference_force)[::-1])
    low, high = float(ratio * np.exp(-fall)), float(ratio * np.exp(rise))
    status = NumberStatus.PLAIN if np.isfinite([low, high]).any() else NumberStatus.NO_INTERVAL
    yield Number("force_over_reference", ratio, "1", low, high, status)
    octaves, contributions = octave_contributions(data, reference)
    # Some octaves may change the ratio in the opposite direction.
    shares = contributions * np.log(ratio)
    strongest = [index for index in np.argsort(-shares)[:OCTAVES_NAMED] if shares[index] > 0]
    for rank, index in enumerate(strongest, start=1):
        name = f"force_over_reference_octave_{rank}"
        yield Number(name, float(octaves[index]), "nm")
        yield Number(f"{name}_factor", math.exp(contributions[index]))


def _log_distances(number: Number) -> Floats:
    """Return the distances (2,) of both ends of an interval from its value, in logarithms."""
    with np.errstate(divide="ignore"):
        return np.abs(np.log(np.array([number.low, number.high]) / number.value))


def octave_contributions(data: Datasets, reference: Datasets) -> tuple[Floats, Floats]:
    """Return octaves (nm) that scans of both surfaces show, and their contributions to ln(F/F')."""
    is_shown = shown_octaves(data) & shown_octaves(reference)
    octaves = data.sensitivity["octave"].values[is_shown]
    name = "octave_sensitivity"
    sensitivities = [data.sensitivity[name].values, reference.sensitivity[name].values]
    amplitude_ratio = _octave_amplitudes(data, octaves) / _octave_amplitudes(reference, octaves)
    contributions = np.mean(sensitivities, axis=0)[is_shown] * np.log(amplitude_ratio)
    is_known = np.isfinite(contributions)
    return octaves[is_known], contributions[is_known]


def _octave_amplitudes(data: Datasets, octaves: Floats) -> Floats:
    """Return the rms heights (octave,) in nm of the waves of each octave of one surface."""
    spectrum = spectrum_of_dataset(data.spectra)
    q = 2 * np.pi / octaves[:, None] * np.geomspace(0.5, 1, WAVEVECTORS_PER_OCTAVE)
    return np.asarray(np.sqrt(np.trapezoid(q * spectrum(q), q) / (2 * np.pi)))
