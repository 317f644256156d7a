"""Forces on masters with known ratios to the unfiltered force, as in filtered_forces.nc."""

import numpy as np
import xarray as xr

CUTOFFS = np.array([10.0, 100.0, 1000.0, 2000.0, 4000.0])  # nm
#: Force ratios of the short and the long side at CUTOFFS.
SHORT = [1.02, 1.3, 1.6, np.nan, np.nan]
LONG = [np.nan, np.nan, 2.0, 1.3, 1.02]
MASTER_DIMS = ("surface", "realization", "side")


def master_ratios(ratios, cutoffs, surfaces=None, shortest=1.0):
    """Return ratios (surface, realization, side, cutoff) of masters with waves from `shortest`."""
    ratios = np.asarray(ratios)
    spectrum_ends = [[shortest, 20e3]] * len(ratios)  # nm
    return xr.Dataset(
        {
            "filtered_force_ratio": ((*MASTER_DIMS, "cutoff_wavelength"), ratios),
            "spectrum_end": (("surface", "side"), spectrum_ends),
        },
        {
            "surface": surfaces or list("ab"[: len(ratios)]), "side": ["short", "long"],
            "realization": np.arange(1, ratios.shape[1] + 1), "cutoff_wavelength": cutoffs,
        },
    )  # fmt: skip


def filtered_forces(curves, spread=0.0):
    """Return forces of ratios (surface, side, cutoff), with scatter of masters and contacts."""
    rng = np.random.default_rng(0)
    curves = np.array(curves)
    shape = (len(curves), 3, 2, 1, 4, 4)  # MASTER_DIMS, cutoff, contact_y, contact_x
    unfiltered = np.exp(0.3 * rng.standard_normal((*shape[:3], *shape[4:])))
    factor = np.exp(spread * rng.standard_normal(shape[:4] + (1, 1)))
    factor = factor * np.exp(0.5 * spread * rng.standard_normal(shape))
    ratio = np.exp(np.log(curves)[:, None, :, :, None, None] * factor)
    dataset = xr.Dataset(
        {
            "pull_off_force": (
                (*MASTER_DIMS, "cutoff_wavelength", "contact_y", "contact_x"),
                ratio * unfiltered[:, :, :, None],
            ),
            "unfiltered_pull_off_force": ((*MASTER_DIMS, "contact_y", "contact_x"), unfiltered),
            "spectrum_end": (("surface", "side"), [[1.0, 10e3]] * len(curves)),
            "label": ("surface", list("AB"[: len(curves)])),
            "source": ("surface", ["measured"] * len(curves)),
        },
        {
            "surface": list("ab"[: len(curves)]),
            "side": ["short", "long"],
            "realization": [1, 2, 3],
            "cutoff_wavelength": CUTOFFS,
        },
        {"rho": 5.0, "sphere_radius": 5e3},
    )
    contacts = ["contact_y", "contact_x"]
    return dataset.assign(
        filtered_force_ratio=dataset.pull_off_force.mean(contacts)
        / dataset.unfiltered_pull_off_force.mean(contacts)
    )
