"""Sets: their datasets have other scans and masters than those of the study."""

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from paper_numbers import CLAIMS, CONSTANTS, MEAN_FORCE, SUBSTRATES, WORK
from set_inputs import (
    CONFIDENCE,
    CONTACTS,
    HEIGHTS,
    MODELS,
    RHO,
    SCANS,
    SPHERE_FACTORS,
    make_adhesion,
    make_inputs,
    make_masters,
)

from hardcontact.inference.published_fit import PublishedForces
from hardcontact.paper.sets import (
    SetSettings,
    adhesion_of_set,
    sample_masters,
    sample_set_scans,
    sample_sets,
    sphere_factor,
    topography_of_set,
)
from hardcontact.surfaces.metrics import TABLE1_METRICS

SETTINGS = SetSettings(
    seed=1, set_count=2, master_count=5, reference_surface="uncd", tolerance=0.1,
    confidence=CONFIDENCE,
)  # fmt: skip
THIRD_SET = {"seed": 1, "set_number": 3}
CLAIMS_OF_SETS = CLAIMS[CLAIMS["samples_from"] == "sets"]
PRINTED = pd.DataFrame({"mean_force": MEAN_FORCE}, index=SUBSTRATES)
PUBLISHED = PublishedForces(PRINTED, pair=(5.6, WORK), error_threshold=0.1)


def relative_heights(scans):
    """Return rms heights (scan,) of a set, relative to the mean in Table 1; they vary by 0.2."""
    deviations = scans["rms_height"] - scans["rms_height"].mean()
    return 1 + 0.2 * deviations / deviations.std(ddof=1)


def mean_forces(scans):
    """Return forces (contact_model,) on scans of a pool and a rough sphere, from their formula."""
    # ln F falls in proportion to the height; the pool begins at 0.3 times the mean height.
    log_force = scans["log_force"].isel(rms_height_of_force=0).sel(rho=5.6, contact_model=MODELS)
    forces = np.exp(log_force + 0.3 - relative_heights(scans))
    return SPHERE_FACTORS * forces.mean(["scan", "contact_y", "contact_x"]).values


def test_values_and_fit_are_those_of_each_set():
    inputs = make_inputs()
    sets = sample_sets(inputs, CLAIMS_OF_SETS, CONSTANTS, PUBLISHED, SETTINGS)
    for number in (1, 2):
        scans = {
            surface: inputs.pools[surface].sel(scan=sampled_scans["number"].values)
            for surface, sampled_scans in sample_set_scans(inputs, 1, number).items()
        }
        ncd = scans["ncd"]
        gradients = ncd["rms_gradient"] / ncd["rms_height"] * HEIGHTS["ncd"] * relative_heights(ncd)
        gradient = sets["value"].sel(set=number, claim="afm_rms_slope_ncd").item()
        assert gradient == pytest.approx(gradients.mean().item())
        # Forces grow as the square root of the range, so all ranges fit equally well, and only the
        # work times this root is known. At the best work one surface has its published force.
        forces = np.array([mean_forces(scans[surface]) for surface in SUBSTRATES])
        works = MEAN_FORCE[:, None] / forces
        errors = np.abs(forces * works[:, None] / MEAN_FORCE[:, None] - 1).mean(axis=1)
        fit = sets.sel(set=number, contact_model=MODELS)
        np.testing.assert_allclose(fit["best_error"], errors.min(axis=0))
        fitted_works = fit["work_of_adhesion"] * np.sqrt(fit["range_of_adhesion"] / 5.6)
        np.testing.assert_allclose(fitted_works, works[errors.argmin(axis=0), [0, 1]])


def test_the_factor_of_the_sphere_is_the_ratio_of_mean_forces():
    adhesion = make_adhesion()
    means = adhesion["pull_off_force"].mean(["sphere_scan", "contact_y", "contact_x"])
    adhesion["smooth_sphere_force"] = 2 * means
    factor = sphere_factor(adhesion, ["uncd", "mcd"])
    assert set(factor.dims) == {"contact_model", "surface", "rho"}
    np.testing.assert_allclose(factor.sel(surface=["uncd", "mcd"]), 0.5, rtol=1e-12)
    assert factor.sel(surface="ncd").isnull().all()


def test_topography_of_a_set_replaces_only_sampled_scans():
    inputs = make_inputs(measured_surfaces=["mcd"])
    sampled_scans = sample_set_scans(inputs, **THIRD_SET)
    study = inputs.topography
    topography = topography_of_set(inputs, sampled_scans, CONFIDENCE)
    for name in TABLE1_METRICS.values():
        uncd_metric = topography[name].sel(surface="uncd")
        np.testing.assert_allclose(uncd_metric, sampled_scans["uncd"][name], rtol=1e-12)
        mean = topography[f"{name}_mean"].sel(surface="uncd").item()
        assert mean == pytest.approx(sampled_scans["uncd"][name].mean().item(), rel=1e-12)
        kept = {"surface": ["mcd", "ruby"]}
        np.testing.assert_array_equal(topography[name].sel(kept), study[name].sel(kept))
    # The mean in Table 1, and a fifth of it (`set_inputs.make_pool`).
    mean_height = topography["rms_height_mean"].sel(surface="uncd").item()
    assert mean_height == pytest.approx(17.4, rel=1e-12)
    assert topography["rms_height_std"].sel(surface="uncd").item() == pytest.approx(3.48)
    xr.testing.assert_identical(topography["source"], study["source"])
    assert topography.attrs == study.attrs


def test_forces_on_sampled_scans_are_multiplied_by_the_factor_of_the_rough_sphere():
    inputs = make_inputs()
    sampled_scans = sample_set_scans(inputs, **THIRD_SET)
    adhesion = adhesion_of_set(inputs, sampled_scans, **THIRD_SET)
    assert adhesion["pull_off_force"].dims == inputs.adhesion["pull_off_force"].dims
    assert adhesion.attrs == inputs.adhesion.attrs
    for surface, scans in sampled_scans.items():
        ratio = adhesion["pull_off_force"].sel(surface=surface) / scans["pull_off_force"]
        for model, factor in zip(MODELS, SPHERE_FACTORS, strict=True):
            np.testing.assert_allclose(ratio.sel(contact_model=model), factor, rtol=1e-12)


def test_forces_on_measured_scans_change_by_one_factor_per_contact_model_and_range():
    inputs = make_inputs(measured_surfaces=["mcd"])
    adhesion = adhesion_of_set(inputs, sample_set_scans(inputs, **THIRD_SET), **THIRD_SET)
    set_forces = adhesion["pull_off_force"].transpose("contact_model", "rho", ...)
    study_forces = inputs.adhesion["pull_off_force"].transpose("contact_model", "rho", ...)
    ratio = (set_forces / study_forces).sel(surface="mcd").values.reshape(2, len(RHO), -1)
    np.testing.assert_allclose(ratio, np.broadcast_to(ratio[..., :1], ratio.shape), rtol=1e-12)
    assert not np.isclose(ratio, 1).any()
    # Sampled scans have CONTACTS² contacts, so their forces are padded with NaN.
    uncd_forces = adhesion["pull_off_force"].sel(surface="uncd")
    assert np.isfinite(uncd_forces).sum() == SCANS * len(MODELS) * len(RHO) * CONTACTS**2


def test_masters_are_sampled_again_for_every_set_and_surface():
    masters = make_masters()["filtered_force_ratio"].isel(surface=slice(2))
    means = np.array(
        [sample_masters(masters, 5, 1, number).mean("realization") for number in range(60)]
    )
    mean = masters.mean("realization").values
    error = masters.std("realization").values / np.sqrt(5)  # of the mean of five masters
    np.testing.assert_allclose(means.std(axis=0), error, rtol=0.3)
    assert (np.abs(means.mean(axis=0) - mean) < 4 * error / np.sqrt(60))[~np.isnan(mean)].all()
    assert abs(np.corrcoef(means[:, 0, 0, 0], means[:, 1, 0, 0])[0, 1]) < 0.2
