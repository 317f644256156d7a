"""Force and indents of contacts at one place of the sphere."""

import numpy as np
import xarray as xr

from figure_inputs.building import bounded, generator, named

PRELOADS, STAGES = [1e-5, 2e-5], [1, 2, 5, 20, 400]
BY = ("surface", "preload", "stage")


def repeated_contact() -> xr.Dataset:
    """Return numbers at both preloads on NCD, at the smaller one on the others."""
    rng = generator()
    there = np.ones((4, 2))
    there[[0, 1, 3], 1] = np.nan
    growth = there[..., None] * np.array([1, 1.2, 1.5, 2, 4])
    sizes = there[:, :, None, None] * rng.uniform(5, 90, (4, 2, 2, 30))
    place = np.arange(-20, 20) * 5.0
    pit = np.clip(9 - (place[:, None] ** 2 + place**2) / 100, 0, None)
    indents = ("surface", "preload", "scan", "indent")
    return (
        named()
        .assign_coords(preload=PRELOADS, stage=STAGES, x=place, y=place)
        .assign(
            bounded("force_ratio", BY, growth)
            | bounded("depth", BY, 2 * growth, unit="nm")
            | bounded("lateral_size", BY, 30 * growth, unit="nm")
            | bounded("median_size", BY, 10 * growth, unit="nm")
            | bounded("separate_share", BY, 1 / growth)
            | bounded("mean_ratio", BY[:2], there)
        )
        .assign(
            indent_size=(indents, sizes),
            indent_depth=(indents, sizes / 20),
            indentation=(("surface", "preload", "y", "x"), there[..., None, None] * pit),
        )
        .assign_attrs(published_depth=[2.0, 10.0], published_lateral_size=[150.0, 300.0])
    )
