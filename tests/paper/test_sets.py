"""Sets: their datasets have other scans and masters than those of the study."""

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from known_masters import master_ratios
from paper_numbers import CLAIMS, CONSTANTS, MEAN_FORCE, SUBSTRATES, SURFACES, TABLE1

from hardcontact.base.statistics import Sampling
from hardcontact.inference.published_fit import PublishedForces, fit_published
from hardcontact.paper.sets import (
    SetInputs,
    SetSettings,
    adhesion_of_set,
    sample_masters,
    sample_set_scans,
    sample_sets,
    sphere_factor,
    topography_of_set,
)
from hardcontact.surfaces.metrics import METRICS, TABLE1_METRICS
from hardcontact.surfaces.topography import scan_averages

CONFIDENCE, SCANS, CONTACTS = 0.95, 5, 3
WORK = 46.3e-3  # J/m², published
RADIUS, RHO, MODELS = 250e3, [0.05, 2.0, 4.0, 5.6, 8.0], ["rigid", "plastic"]
CUTOFFS = np.array([20.0, 43.0, 120.0, 500.0, 1800.0, 3500.0])
AXES = ("contact_model", "rho", "contact_y", "contact_x")
HEIGHTS = dict(zip(SUBSTRATES, TABLE1["afm_rms_height"][0], strict=True))
#: Forces (contact_model, rho) relative to that of plastic contact at 5.6 nm.
CURVES = np.outer([0.5, 1.0], (np.array(RHO) / 5.6) ** 0.5)


def contact_coordinates(contacts):
    """Return the coordinates of forces with a number of contacts per row."""
    numbers = range(contacts)
    return {"contact_model": MODELS, "rho": RHO, "contact_y": numbers, "contact_x": numbers}


def scan_metrics(rng, heights):
    """Return METRICS (scan) of scans of these rms heights in nm."""
    return {
        name: ("scan", heights * rng.uniform(0.5, 1.5), {"units": unit})
        for name, (unit, _) in METRICS.items()
    } | {"rms_height": ("scan", heights, {"units": "nm"})}


def make_pool(surface):
    """Return a pool whose forces fall with the height, near those of the paper."""
    rng = np.random.default_rng(SUBSTRATES.index(surface))
    mean = HEIGHTS[surface]
    force_heights = mean * np.linspace(0.3, 1.8, 5)
    force = MEAN_FORCE[SUBSTRATES.index(surface)] / WORK
    log_force = (
        np.log(force * CURVES)[:, :, None, None]
        - (force_heights / mean - 1)[:, None, None, None, None]
        + rng.normal(0, 0.5, (12, 1, 1, 1, CONTACTS, CONTACTS))
    )
    return xr.Dataset(
        scan_metrics(rng, mean * rng.uniform(0.8, 1.2, 12))
        | {"log_force": (("scan", "rms_height_of_force", *AXES), log_force)},
        {"scan": range(1, 13), "rms_height_of_force": force_heights}
        | contact_coordinates(CONTACTS),
        {"mean_rms_height": mean, "rms_height_deviation": 0.2 * mean},
    )


def make_topography(measured_surfaces=()):
    """Return the roughness of SCANS scans of each surface, 0.5 nm on the ruby."""
    rng = np.random.default_rng(10)
    surface_metrics = [
        xr.Dataset(scan_metrics(rng, HEIGHTS.get(name, 0.5) * np.linspace(0.9, 1.1, SCANS)))
        for name in SURFACES
    ]
    scans = xr.concat(surface_metrics, pd.Index(SURFACES, name="surface"))
    scans = scans.assign_coords(scan=range(1, SCANS + 1))
    source = ["measured" if name in measured_surfaces else "substitute" for name in SURFACES]
    descriptions = {"label": SURFACES, "source": source, "table1_rows_met": [""] * len(SURFACES)}
    return (
        xr.merge([scans, scan_averages(scans, CONFIDENCE)])
        .assign({f"all_scales_{name}": ("surface", np.ones(len(SURFACES))) for name in METRICS})
        .assign({name: ("surface", values) for name, values in descriptions.items()})
        .assign_attrs(confidence=CONFIDENCE, sphere_surface="ruby")
    )


def make_adhesion():
    """Return forces on two scans of the sphere, with more contacts than in the pools."""
    rng = np.random.default_rng(11)
    force = MEAN_FORCE[:, None, None] * CURVES
    scatter = rng.normal(0, 0.5, (4, SCANS, 2, 1, 1, 4, 4))
    forces = force[:, None, None, :, :, None, None] / WORK * np.exp(scatter)
    return xr.Dataset(
        {
            "pull_off_force": (("surface", "scan", "sphere_scan", *AXES), forces, {"units": "N"}),
            "contact_pixel_count": ("contact_model", [1, 17]),
            "label": ("surface", SUBSTRATES),
            "source": ("surface", ["substitute"] * 4),
        },
        {"surface": SUBSTRATES, "scan": range(1, SCANS + 1), "sphere_scan": [1, 2]}
        | contact_coordinates(4),
        {"rho": 5.6, "sphere_radius": RADIUS, "pixel_size": 5.0, "work_of_adhesion": 1.0},
    )


def make_masters():
    """Return ratios that on average differ from one by 10 % at 43 nm and at 1.8 µm."""
    rng = np.random.default_rng(12)
    slope = rng.uniform(0.5, 1.5, (4, 6, 1))
    ratio = np.full((4, 6, 2, len(CUTOFFS)), np.nan)
    ratio[:, :, 0, :3] = 1 + 0.1 * slope * CUTOFFS[:3] / 43
    ratio[:, :, 1, 3:] = 1 - 0.1 * slope * 1800 / CUTOFFS[3:]
    return master_ratios(ratio, CUTOFFS, SUBSTRATES, shortest=2.44)


def make_inputs(measured_surfaces=()):
    """Return inputs of sets; measured surfaces have no pool."""
    factor = xr.DataArray(
        np.full((2, 4, len(RHO)), [[[0.9]], [[0.95]]]),
        {"contact_model": MODELS, "surface": SUBSTRATES, "rho": RHO},
        ("contact_model", "surface", "rho"),
    )
    pools = {name: make_pool(name) for name in SUBSTRATES if name not in measured_surfaces}
    return SetInputs(
        make_topography(measured_surfaces), make_adhesion(), pools, {}, factor, make_masters()
    )


SETTINGS = SetSettings(
    seed=1, set_count=2, master_count=5, reference_surface="uncd", tolerance=0.1,
    confidence=CONFIDENCE,
)  # fmt: skip
THIRD_SET = {"seed": 1, "set_number": 3}
NO_SAMPLES = Sampling(seed=1, sample_count=0, confidence=CONFIDENCE)
CLAIMS_OF_SETS = CLAIMS[CLAIMS["samples_from"] == "sets"]
PRINTED = pd.DataFrame({"mean_force": MEAN_FORCE}, index=SUBSTRATES)
PUBLISHED = PublishedForces(PRINTED, pair=(5.6, WORK), error_threshold=0.1)


def test_values_and_fit_are_those_of_each_set():
    inputs = make_inputs()
    sets = sample_sets(inputs, CLAIMS_OF_SETS, CONSTANTS, PUBLISHED, SETTINGS)
    for number in (1, 2):
        values = sets["value"].sel(set=number)
        sampled_scans = sample_set_scans(inputs, 1, number)
        adhesion = adhesion_of_set(inputs, sampled_scans, 1, number)
        fit = fit_published(adhesion, PUBLISHED, "uncd", NO_SAMPLES)
        ranges = sets["range_of_adhesion"].sel(set=number, contact_model=MODELS)
        np.testing.assert_allclose(fit["range_of_adhesion"].sel(contact_model=MODELS), ranges)
        gradient = sampled_scans["ncd"]["rms_gradient"].mean().item()
        assert values.sel(claim="afm_rms_slope_ncd").item() == pytest.approx(gradient)


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
    # From Table 1 and `make_pool`.
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
        np.testing.assert_allclose(ratio.sel(contact_model="rigid"), 0.9, rtol=1e-12)
        np.testing.assert_allclose(ratio.sel(contact_model="plastic"), 0.95, rtol=1e-12)


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
