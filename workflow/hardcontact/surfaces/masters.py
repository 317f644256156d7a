"""The master of either side of the scales, as the configuration describes it."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from hardcontact.surfaces.height_map import HeightMap
from hardcontact.surfaces.spectrum import Density
from hardcontact.surfaces.synthesis import large_scale_master, small_scale_master

__all__ = ["SIDES", "synthesized_master"]

#: How the master of a side is synthesized, and the key of the scales that says how large.
SYNTHESIS = {"small": (small_scale_master, "pixels"), "large": (large_scale_master, "tiles")}
SIDES = tuple(SYNTHESIS)


def synthesized_master(
    side: str,
    rng: np.random.Generator,
    stitched: HeightMap,
    scales: Mapping[str, Any],
    density: Density,
) -> HeightMap:
    """Return the master of one side.

    Parameters
    ----------
    side : str
        ``"small"`` adds roughness below the transition wavelength, ``"large"`` above.
    rng : numpy.random.Generator
        Of the roughness added.
    stitched : HeightMap
        The scan, periodic.
    scales : mapping
        ``transition`` in nm, and ``pixels`` of a small-scale or ``tiles`` of a large-scale master.
    density : callable
        C_iso in nm⁴ as a function of the wavevector in rad/nm.

    Returns
    -------
    HeightMap
        Periodic.
    """
    synthesize, size = SYNTHESIS[side]
    return synthesize(rng, stitched, scales[size], scales["transition"], density)
