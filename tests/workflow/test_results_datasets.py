"""The quick study's datasets: variables, units, origin, physics; the same seed, the same values."""

from collections import Counter

import numpy as np
import pytest
import xarray as xr
from paper_numbers import SUBSTRATES
from repository import OTHERWISE, copy_repository, run_snakemake

from hardcontact.contact.contact import Contact
from hardcontact.records import dataset

#: Variables of the final datasets: unit, then names; "-" where there is no unit.
CONTENT = {
    "topography": {
        "nm": "rms_height rms_height_mean rms_height_std peak_to_valley example_heights "
        "sphere_as_scanned scan_size pixel_size all_scales_rms_height",
        "1": "rms_gradient rms_profile_slope skewness kurtosis all_scales_rms_gradient",
        "nm-1": "rms_half_laplacian rms_laplacian all_scales_rms_half_laplacian",
        "nm3": "psd_profile psd_profile_mean",
        "nm4": "psd_isotropic psd_isotropic_mean spectrum",
        "rad nm-1": "wavevector",
        "-": "label basis calibrated_to_table1",
    },
    "adhesion": {
        "N": "pull_off_force",
        "nm": "closest_approach penetration rho",
        "1": "contact_pixels window_change",
        "-": "label basis contact_model",
    },
    "contact": {"nm": "gap separation x y", "Pa": "adhesive_pressure", "N": "force"},
    "scales": {
        "N": "pull_off_force unfiltered_pull_off_force",
        "nm": "cutoff_wavelength",
        "1": "ratio",
        "-": "label basis side",
    },
    "inference": {
        "N": "mean_force mean_force_interval contact_spread force_mean force_mean_interval "
        "force_median lognormal_median",
        "nm": "rho rho_fine range_of_adhesion range_of_adhesion_interval range_from_ratios "
        "sampled_range region_range minimum_range pair_range",
        "J m-2": "work work_of_adhesion work_of_adhesion_interval sampled_work region_work "
        "minimum_work pair_work",
        "1": "ratio ratio_error ratio_at_pair ratio_at_pair_interval mean_relative_error "
        "error_of_range minimum_error best_error best_error_interval sampled_error "
        "model_error_ratio model_error_ratio_interval lognormal_shape censored_fraction",
        "-": "label basis pair",
    },
    "band": {
        "nm": "critical_wavelength critical_wavelength_interval cutoff_wavelength",
        "1": "scale_ratio scale_ratio_interval scale_change scale_change_interval",
        "-": "label basis side group",
    },
    "elastic": {
        "nm2": "contact_area",
        "Pa": "peak_pressure mean_pressure pressure",
        "N": "rigid_pull_off_force elastic_pull_off_force",
        "1": "hard_share iterations",
        "nm": "x y",
        "-": "label basis",
    },
    "indent": {
        "nm": "depth edge_length lateral_size indentation sphere_height x y",
        "1": "indents",
        "N": "preload",
    },
    "asperities": {
        "1": "largest_share two_largest_share patches",
        "nm": "extent rho",
        "-": "label basis",
    },
    "classical": {
        "N": "pull_off_force pull_off_force_interval computed_mean_force_interval",
        "J m-2": "fitted_work_of_adhesion fitted_work_of_adhesion_interval "
        "effective_work_of_adhesion effective_work_of_adhesion_interval",
        "1": "mean_relative_error adhesion_index power_law_error tabor_parameter "
        "implied_pull_off_coefficient transition_coefficient tabor_axis",
        "Pa": "effective_modulus hertz_peak_pressure",
        "-": "label basis model_label model_roughness model_verified",
    },
    "robustness": {
        "nm": "range_of_adhesion range_of_adhesion_interval critical_wavelength "
        "critical_wavelength_interval",
        "J m-2": "work_of_adhesion work_of_adhesion_interval",
        "1": "best_error",
        "-": "variant_label group side",
    },
}

#: Attributes that figures and claims need, beside those of every dataset.
ATTRIBUTES = {
    "elastic": "hardness preload effective_modulus hertz_peak_pressure rho work_of_adhesion window "
    "sphere_radius",
    "indent": "surface label hardness sphere_radius",
    "asperities": "share sphere_radius",
    "band": "scale_tolerance confidence",
    "classical": "sphere_radius equilibrium_spacing error_threshold preload",
    "robustness": "sphere_radius realizations pixels_small pixels_large count tolerance range",
}


@pytest.mark.parametrize("name", CONTENT)
def test_dataset_holds_its_variables_with_units(results, name):
    data = dataset.read(results / f"{name}.nc")
    for unit, variables in CONTENT[name].items():
        for variable in variables.split():
            assert data[variable].attrs.get("units", "-") == unit, variable
    without = [
        key
        for key, variable in data.variables.items()
        if variable.dtype.kind == "f" and "units" not in variable.attrs
    ]
    assert without == []


@pytest.mark.parametrize("name", CONTENT)
def test_dataset_says_where_it_comes_from(results, name):
    attributes = dataset.read(results / f"{name}.nc").attrs
    for key in ("title", "history", "parameters", "versions", "code_digest", "input_digests"):
        assert attributes[key], key
    assert attributes["Conventions"].startswith("CF-")
    assert [key for key in ATTRIBUTES.get(name, "").split() if key not in attributes] == []


WITHOUT_SURFACES = ("contact", "indent", "robustness")


@pytest.mark.parametrize("name", [name for name in CONTENT if name not in WITHOUT_SURFACES])
def test_substitutes_are_labelled(results, name):
    data = dataset.read(results / f"{name}.nc")
    assert set(data.basis.values) == {"substitute"}
    assert set(SUBSTRATES) <= set(data.surface.values)


def test_datasets_without_surfaces_say_what_they_are_made_of(results):
    for name in ("contact", "indent"):
        assert dataset.read(results / f"{name}.nc").attrs["basis"] == "substitute"
    named = ", ".join(f"{surface}: substitute" for surface in SUBSTRATES)
    assert dataset.read(results / "robustness.nc").attrs["basis"] == named


def test_every_map_of_the_store_is_labelled(finished):
    store = finished / "results" / "store-quick"
    maps = {part: list(store.glob(f"{part}/**/*.nc")) for part in ("scans", "stitched", "masters")}
    scans = {f"{surface}/study": 4 for surface in SUBSTRATES}  # of the masters of sets
    scans |= dict.fromkeys(["ruby/study", *OTHERWISE], 2)
    for part in ("scans", "stitched"):
        folders = (path.parent.relative_to(store / part) for path in maps[part])
        assert Counter(map(str, folders)) == scans
    assert len(maps["masters"]) == 16
    for path in [*sum(maps.values(), []), *store.glob("substitutes/**/*.nc")]:
        with xr.open_dataset(path) as data:
            assert data.attrs["basis"].startswith("substitute"), path


def test_forces_are_positive_and_complete(results):
    force = dataset.read(results / "adhesion.nc").pull_off_force
    assert np.isfinite(force).all() and (force > 0).all()
    assert force.sizes["contact_y"] == force.sizes["contact_x"] == 6
    rigid, plastic = (force.sel(contact_model=model) for model in ("rigid", "plastic"))
    assert (plastic >= rigid).all()


def test_elastic_contacts_carry_the_preload(results):
    data = dataset.read(results / "elastic.nc")
    load = data.contact_area * 1e-18 * data.mean_pressure
    np.testing.assert_allclose(load, data.attrs["preload"], rtol=1e-5)
    assert (data.peak_pressure >= data.mean_pressure).all()
    assert ((0 <= data.hard_share) & (data.hard_share <= 1)).all()
    assert (data.rigid_pull_off_force > 0).all() and (data.elastic_pull_off_force > 0).all()
    # The pressure drawn is that of the first contact on a surface's first scan, about its peak.
    peak = data.peak_pressure.isel(scan=0, contact=0)
    np.testing.assert_array_equal(data.pressure.max(["y", "x"]), peak)


def test_indents_grow_with_the_load_and_the_one_drawn_is_the_median(results):
    data = dataset.read(results / "indent.nc")
    assert (data.depth.diff("preload") > 0).all()
    assert (data.lateral_size >= data.edge_length).all() and (data.indents >= 1).all()
    pixel = float(data.x.diff("x").mean())
    for preload in data.preload.values:
        contact_pixels = Contact(
            radius=data.sphere_radius, preload=preload, hardness=data.hardness
        ).pixels(pixel)
        largest = np.rint((data.edge_length.sel(preload=preload) / pixel) ** 2)
        assert (largest + data.indents.sel(preload=preload) - 1 <= contact_pixels).all()
        assert ((data.indents.sel(preload=preload) == 1) <= (largest == contact_pixels)).all()
    deepest = data.preload.max()
    depths = np.sort(data.depth.sel(preload=deepest).values, axis=None)
    assert data.indentation.sel(preload=deepest).max() == depths[depths.size // 2]


def test_one_or_two_asperities_carry_the_share_that_is_looked_at(results):
    data = dataset.read(results / "asperities.nc")
    assert (data.largest_share <= data.two_largest_share).all() and (data.extent > 0).all()
    for patches, name in ((1, "largest_share"), (2, "two_largest_share")):
        alone = data[name].where(data.patches <= patches, drop=True)
        assert alone.size and (alone.fillna(1) >= data.attrs["share"] - 1e-9).all()
    assert (data.two_largest_share < 1).all() and (data.patches >= 1).all()


# The same seed, the same values


def values_of(folder):
    """Bytes of every variable of the scans and spectra in a store."""
    return {
        (path.relative_to(folder).as_posix(), name): variable.values.tobytes()
        for part in ("spectra", "substitutes", "scans", "stitched")
        for path in folder.glob(f"{part}/**/*.nc")
        for name, variable in dataset.read(path).variables.items()
    }


def test_the_same_seed_gives_the_same_values(finished, tmp_path):
    folder = copy_repository(tmp_path / "again")
    scans = ("uncd/study/scan-1-flat.nc", "ruby/study/scan-2-sphere-R250um.nc")
    run = run_snakemake(folder, *(f"results/store-quick/stitched/{scan}" for scan in scans))
    assert run.returncode == 0, run.stdout[-3000:]
    first, again = (values_of(part / "results/store-quick") for part in (finished, folder))
    assert {path for path, _ in again} >= {f"stitched/{scan}" for scan in scans}
    assert all(first[key] == values for key, values in again.items())
