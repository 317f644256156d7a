"""Variants whose range, work and edge are known."""

import numpy as np
import pytest
import xarray as xr
from known_forces import RHOS, TABLE, power_curves
from paper_numbers import SUBSTRATES

from hardcontact.base.dataset import stack
from hardcontact.base.statistics import Sampling
from hardcontact.paper.robustness import Choices, robustness

LOADS = ["H25GPa-F10uN", "H25GPa-F5uN"]
STUDY = dict.fromkeys(SUBSTRATES, "study")
CUTOFFS = {"small": [10.0, 100.0], "large": [1000.0, 10000.0]}
CHOICES = Choices(
    substrates=SUBSTRATES,
    basis=dict.fromkeys([*SUBSTRATES, "ruby"], "substitute"),
    reference_surface="uncd",
    probe="smooth",
    error_threshold=0.1,
    tolerance=0.1,
    realizations=1,
    sampling=Sampling(0, 20, 0.9, ("sampling", "robustness")),
)
VARIANTS = [
    {"name": "baseline", "variant": STUDY, "load": LOADS[0], "probe": "smooth"},
    {"name": "rough_sphere", "variant": STUDY, "load": LOADS[0], "probe": "rough"},
    {"name": "lighter", "variant": STUDY, "load": LOADS[1], "probe": "smooth"},
    {"name": "curved", "variant": STUDY | {"mcd": "other"}, "load": LOADS[0], "probe": "smooth"},
]
VARIANTS = [variant | {"label": variant["name"], "group": "any"} for variant in VARIANTS]


def scan_forces(surface, factor=1.0):
    """Forces of 4 nm and 0.05 J/m² at the first load, of 2 nm and 0.1 J/m² at the second load."""
    index = SUBSTRATES.index(surface)
    forces = [power_curves(4.0, 0.05)[index], power_curves(2.0, 0.1)[index]]
    return xr.Dataset(
        {"pull_off_force": (("load", "rho"), factor * np.array(forces))},
        {"load": LOADS, "rho": RHOS},
    ).expand_dims(scan=[1, 2], sphere_scan=[1, 2])


def master_forces(side, change):
    """Forces that change by `change` at the cutoff with the larger effect only."""
    ratio = np.array([1.0, 1 + change] if side == "small" else [1 + change, 1.0])
    force = np.outer(ratio, [2e-6, 1e-6])
    return xr.Dataset(
        {
            "pull_off_force": (("cutoff_wavelength", "load"), force),
            "unfiltered_pull_off_force": ("load", [2e-6, 1e-6]),
            "unfiltered_wavelength": ((), 1.0 if side == "small" else 20000.0),
        },
        {"cutoff_wavelength": CUTOFFS[side], "load": LOADS},
    )


def realization_forces(change):
    """Forces of one realization, as a file of masters has them."""
    sides = {(1, side): master_forces(side, change) for side in CUTOFFS}
    forces = stack(sides, ["realization", "side"]).expand_dims(radius=[250e3], rho=[5.6])
    return forces.assign(contact_area=400.0)


@pytest.fixture(scope="module")
def variants():
    adhesion = {
        (surface, variant): scan_forces(surface, 1.0 if variant == "study" else 2.0)
        for surface in SUBSTRATES
        for variant in ("study", "other")
        if variant == "study" or surface == "mcd"
    }
    masters = [
        ((surface, variant, probe), realization_forces(0.2 if probe == "smooth" else 1.0))
        for surface in SUBSTRATES
        for variant in ("study", "other")
        for probe in ("smooth", "rough")
    ]
    return robustness(adhesion, masters, VARIANTS, TABLE.iloc[::-1], CHOICES)


def test_a_variant_uses_the_forces_at_its_load(variants):
    load_variants = variants.sel(variant=["baseline", "lighter"])
    np.testing.assert_allclose(load_variants.range_of_adhesion, [4.0, 2.0], rtol=0.01)
    np.testing.assert_allclose(load_variants.work_of_adhesion, [0.05, 0.1], rtol=0.02)
    np.testing.assert_allclose(load_variants.best_error, 0, atol=0.01)


def test_a_variant_replaces_the_scans_of_one_surface(variants):
    """Forces on one surface are twice as large: no range and work fits all four."""
    assert variants.best_error.sel(variant="curved") > 0.05


def test_another_probe_changes_only_the_critical_band(variants):
    rough = variants.sel(variant="rough_sphere")
    for name in ("range_of_adhesion", "range_of_adhesion_interval", "work_of_adhesion",
                 "work_of_adhesion_interval", "best_error"):  # fmt: skip
        assert rough[name].isnull().all(), name
        assert variants[name].drop_sel(variant="rough_sphere").notnull().all(), name
    for name, change in (("baseline", 0.2), ("rough_sphere", 1.0)):
        decades = 0.1 / change
        edges = variants.edge.sel(variant=name, side=["small", "large"])
        np.testing.assert_allclose(edges, [10 ** (1 + decades), 10 ** (4 - decades)])
