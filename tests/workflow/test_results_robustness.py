"""The quick study's robustness: variants, their intervals, and the study's own forces again."""

from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from repository import VARIANT_SURFACES, run_snakemake
from small_study import QUICK_NUMBERS, QUICK_PATTERNS

from hardcontact.base import dataset
from hardcontact.config.configuration import set_keys
from hardcontact.config.store_keys import store_digests
from hardcontact.contact.contact import Contact


@pytest.fixture(scope="module")
def robustness(results):
    return dataset.read(results / "robustness.nc")


def test_a_variant_changes_only_its_quantities(robustness):
    fitted = [name for name in robustness if robustness[name].dtype.kind == "f"]
    fitted = robustness[[name for name in fitted if "side" not in robustness[name].dims]]
    rough = fitted.sel(variant="rough_sphere")
    assert len(fitted) == 8 and all(value.isnull().all() for value in rough.values())
    other_variants = fitted.drop_sel(variant="rough_sphere").sel(minimum=1)  # others need not exist
    assert all(np.isfinite(value).all() for value in other_variants.values())
    cutoffs = robustness.edge
    assert np.isfinite(cutoffs).all()
    for name in robustness.variant.values[1:]:
        assert (cutoffs.sel(variant=name) != cutoffs.sel(variant="baseline")).any(), name


def test_loads_carried_by_equally_many_pixels_have_equal_results(robustness):
    preload, hardness = (robustness.sel(variant=name) for name in ("preload-5uN", "hardness-47GPa"))
    for pixel in (2500 / 128, 5000 / 1024, 20000 / 1024):  # scans, masters of either side
        half, hard, study = (
            Contact(radius=1.0, preload=preload, hardness=hardness).pixel_count(pixel)
            for preload, hardness in ((5e-6, 25e9), (10e-6, 47e9), (10e-6, 25e9))
        )
        assert half == hard < study
    alike = [name for name in robustness.data_vars if robustness[name].dtype.kind == "f"]
    xr.testing.assert_equal(
        preload[alike].drop_vars(["variant", "variant_label", "variant_kind"]),
        hardness[alike].drop_vars(["variant", "variant_label", "variant_kind"]),
    )


def test_a_variant_of_a_surface_uses_the_same_random_numbers(finished):
    def heights(surface, variant):
        path = QUICK_PATTERNS.levelled.format(
            surface=surface, variant=variant, scan=1, shape="flat"
        )
        return dataset.read(finished / path).heights.values.ravel()

    for name in VARIANT_SURFACES:
        surface, variant = name.split("/")
        plain, varied_heights = heights(surface, "study"), heights(surface, variant)
        assert (plain != varied_heights).any()
        assert np.corrcoef(plain, varied_heights)[0, 1] > 0.7, name  # spectrum and gain differ
    assert abs(np.corrcoef(heights("uncd", "study"), heights("mcd", "study"))[0, 1]) < 0.5


def test_robustness_from_all_contacts_has_the_forces_of_the_study(finished_copy, results):
    (path,) = Path(finished_copy).glob(
        "results/store-quick/mean_forces/*/R250um/*+*/*/uncd/study/*.nc"
    )
    digests = [
        store_digests(numbers)["mean_forces"]
        for numbers in (QUICK_NUMBERS, set_keys(QUICK_NUMBERS, {"sets.count": 6}))
    ]
    path = str(path.relative_to(finished_copy)).replace(*digests)
    run = run_snakemake(finished_copy, path, overlays=[{"sets": {"count": 6}}])
    assert run.returncode == 0, run.stdout[-3000:]
    forces = dataset.read(finished_copy / path).pull_off_force.sel(scan=2, sphere_scan=1)
    forces = forces.transpose("load", "rho")
    study = dataset.read(results / "adhesion.nc").pull_off_force
    study = study.sel(surface="uncd", scan=2, sphere_scan=1, contact_model="plastic")
    study = study.mean(["contact_y", "contact_x"])
    full_force, half, hard = (
        forces.sel(load=load) for load in ("H25GPa-F10uN", "H25GPa-F5uN", "H47GPa-F10uN")
    )
    np.testing.assert_allclose(full_force, study, rtol=1e-9)
    assert (half < full_force).all()
    np.testing.assert_array_equal(half, hard)
