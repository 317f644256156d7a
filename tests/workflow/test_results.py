"""The quick study's results: datasets, claims, figures and pages; the same seed, the same."""

import json
import re
from collections import Counter
from html import escape

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from browser import needs_browser, shown
from html_page import Page
from paper_numbers import SUBSTRATES
from repository import OTHERWISE, ROOT, copy_repository, run_snakemake

from hardcontact.claims.evaluation import COLUMNS
from hardcontact.claims.verdicts import VERDICTS
from hardcontact.contact.bearing_area import contact_pixel_count
from hardcontact.figures.catalogue import FIGURES, OF_INSIGHT, OF_PAPER
from hardcontact.records import dataset
from hardcontact.statistics import bounds
from hardcontact.study.pages import PAGES


@pytest.fixture(scope="module")
def results(finished):
    return finished / "results" / "quick"


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
        "-": "label basis undecided pair",
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
        "1": "mean_relative_error error_at_published_work adhesion_index rank_correlation "
        "power_law_exponent power_law_error prediction_error tabor_parameter maugis_parameter "
        "effective_tabor_parameter pull_off_coefficient implied_pull_off_coefficient "
        "transition_coefficient tabor_axis",
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
        contact_pixels = contact_pixel_count(data.attrs | {"preload": preload}, pixel)
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


# Robustness


@pytest.fixture(scope="module")
def robustness(results):
    return dataset.read(results / "robustness.nc")


def test_variants_are_those_of_the_configuration(robustness):
    names = "baseline laplacian skewness+0.5 tip-17nm rough_sphere preload-5uN hardness-47GPa"
    groups = "baseline curvature heights tip sphere preload hardness".split()
    assert robustness.variant.values.tolist() == names.split()
    assert robustness.group.values.tolist() == groups


def test_only_what_a_variant_concerns_is_another(robustness):
    fitted = [name for name in robustness if robustness[name].dtype.kind == "f"]
    fitted = robustness[[name for name in fitted if "side" not in robustness[name].dims]]
    rough = fitted.sel(variant="rough_sphere")
    assert len(fitted) == 9 and all(value.isnull().all() for value in rough.values())
    others = fitted.drop_sel(variant="rough_sphere").sel(minimum=1)  # others need not exist
    assert all(np.isfinite(value).all() for value in others.values())
    cutoffs = robustness.critical_wavelength
    assert np.isfinite(cutoffs).all()
    for name in robustness.variant.values[1:]:
        assert (cutoffs.sel(variant=name) != cutoffs.sel(variant="baseline")).any(), name


@pytest.mark.parametrize("name", ["range_of_adhesion", "work_of_adhesion"])
def test_variants_lie_in_their_intervals(robustness, name):
    value, (low, high) = robustness[name], bounds(robustness, name)
    known = np.isfinite(value)
    assert ((low <= value) | ~known).all() and ((value <= high) | ~known).all()


def test_a_single_realization_has_no_interval(robustness):
    assert robustness.attrs["realizations"] == 1
    assert robustness.critical_wavelength_interval.isnull().all()


def test_loads_that_as_many_pixels_carry_are_one(robustness):
    preload, hardness = (robustness.sel(variant=name) for name in ("preload-5uN", "hardness-47GPa"))
    for pixel in (2500 / 128, 5000 / 1024, 20000 / 1024):  # scans, masters of either side
        half, hard, study = (
            contact_pixel_count({"preload": preload, "hardness": hardness}, pixel)
            for preload, hardness in ((5e-6, 25e9), (10e-6, 47e9), (10e-6, 25e9))
        )
        assert half == hard < study
    alike = [name for name in robustness.data_vars if robustness[name].dtype.kind == "f"]
    xr.testing.assert_equal(
        preload[alike].drop_vars(["variant", "variant_label", "group"]),
        hardness[alike].drop_vars(["variant", "variant_label", "group"]),
    )


def test_a_surface_made_otherwise_is_made_from_the_same_random_numbers(finished):
    store = finished / "results/store-quick"

    def heights(surface):
        return dataset.read(store / f"scans/{surface}/scan-1-flat.nc").heights.values.ravel()

    for name in OTHERWISE:
        plain, other = heights(f"{name.partition('/')[0]}/study"), heights(name)
        assert (plain != other).any()
        assert np.corrcoef(plain, other)[0, 1] > 0.7, name  # spectrum and gain differ
    assert abs(np.corrcoef(heights("uncd/study"), heights("mcd/study"))[0, 1]) < 0.5


def test_robustness_from_all_contacts_has_the_forces_of_the_study(finished_copy, results):
    pair = "R250um/H25GPa-F10uN/uncd/study/scan-2/sphere-scan-1.nc"
    path = f"results/store-quick/robustness/{pair}"
    run = run_snakemake(finished_copy, path, overlays=[{"sets": {"count": 6}}])
    assert run.returncode == 0, run.stdout[-3000:]
    varied = dataset.read(finished_copy / path).pull_off_force.transpose("load", "rho")
    study = dataset.read(results / "adhesion.nc").pull_off_force
    study = study.sel(surface="uncd", scan=2, sphere_scan=1, contact_model="plastic")
    study = study.mean(["contact_y", "contact_x"])
    whole, half, hard = (
        varied.sel(load=load) for load in ("H25GPa-F10uN", "H25GPa-F5uN", "H47GPa-F10uN")
    )
    np.testing.assert_allclose(whole, study, rtol=1e-9)
    assert (half < whole).all()
    np.testing.assert_array_equal(half, hard)


# Claims, figures, pages


def test_claims(results):
    claims = pd.read_csv(results / "claims.csv")
    assert tuple(claims.columns) == COLUMNS
    assert set(claims.verdict) <= set(VERDICTS)
    assert set(claims.basis) == {"substitute scans", "no scan"}
    published = pd.read_csv(ROOT / "resources/paper/claims.csv")
    assert list(claims.id) == list(published.id) and claims.id.is_unique
    replicated = published.set_index("id").loc[claims.id, "replicated"] == "yes"
    assert list(claims.frequency.notna()) == list(replicated)
    assert claims.frequency.dropna().between(0, 1).all()


SIGNATURES = {"pdf": b"%PDF-", "png": b"\x89PNG"}


@pytest.mark.parametrize("name", FIGURES)
def test_figure(results, name):
    for suffix, signature in SIGNATURES.items():
        assert (results / f"figures/{name}.{suffix}").read_bytes().startswith(signature)
    table = pd.read_csv(results / f"figures/{name}.csv")
    assert len(table) and not table.columns.str.contains("Unnamed").any()


def test_pages_of_the_report(results):
    pages = {path.stem: path.read_text() for path in (results / "report").iterdir()}
    assert set(pages) == set(PAGES)
    claims = pd.read_csv(results / "claims.csv")
    assert [text for text in claims.statement if escape(text) not in pages["claims"]] == []
    tables = 1 + claims.section.nunique()
    assert pages["claims"].count("<tr>") == tables + len(VERDICTS) + len(claims)
    assert "study: quick" in pages["parameters"] and "numpy" in pages["parameters"]
    assert "Interaction radius" in pages["departures"]


def test_the_answer_has_the_numbers_of_the_claims_and_of_the_datasets(results):
    numbers = json.loads((results / "answer.json").read_text())
    claims = pd.read_csv(results / "claims.csv").fillna({"follows_from": "", "note": ""})
    pd.testing.assert_frame_equal(pd.DataFrame(numbers["claims"]), claims, check_exact=True)
    assert numbers["settings"]["rho"] == dataset.read(results / "scales.nc").attrs["rho"] == 5.6
    assert numbers["settings"]["sets"] == dataset.read(results / "sets.nc").sizes["set"] == 10
    assert numbers["settings"]["scan_pixels"] == 128
    surfaces = {name: surface["basis"] for name, surface in numbers["surfaces"].items()}
    assert surfaces == dict.fromkeys([*SUBSTRATES, "ruby"], "substitute")


def test_the_page_of_the_answer_holds_every_figure_and_needs_nothing_else(results):
    page = Page((results / "answer.html").read_text())
    sources = page.values("src")
    assert len(sources) == len(OF_PAPER)
    assert all(source.startswith("data:image/png;base64,") for source in sources)
    claims = pd.read_csv(results / "claims.csv")
    told = "".join(page.texts["body"])
    assert [text for text in claims.statement if text not in told] == []


def test_the_page_on_the_band_answers_every_part_and_needs_nothing_else(results):
    page = Page((results / "insight.html").read_text())
    sources = page.values("src")
    assert len(sources) == len(page.texts["h2"]) == len(OF_INSIGHT)
    assert all(source.startswith("data:image/png;base64,") for source in sources)
    assert not re.search(r"\bnan\b|\binf\b", "".join(page.texts["body"]))


@needs_browser
def test_a_browser_shows_the_answer_on_a_phone_and_on_a_desk(results, tmp_path):
    page = (results / "answer.html").read_text()
    for measured in shown(page.replace("<details>", "<details open>"), tmp_path):
        assert measured["overflow"] == 0 and measured["requests"] == 0
        assert measured["loaded"] == len(OF_PAPER)


def test_the_report_holds_the_answer_every_figure_and_every_page(finished, tmp_path):
    run = run_snakemake(finished, "--report", str(tmp_path / "report.html"))
    assert run.returncode == 0, run.stdout[-3000:]
    text = (tmp_path / "report.html").read_text()
    parts = ["answer.html", "insight.html", *(f"{name}.png" for name in FIGURES)]
    parts += [f"{name}.html" for name in PAGES]
    assert [name for name in parts if name not in text] == []


def test_nothing_is_left_half_written(finished):
    files = [path for path in (finished / "results").rglob("*") if path.is_file()]
    locks = {finished / "results" / folder / ".lock" for folder in ("quick", "store-quick")}
    odd = {path for path in files if path.name.startswith(".") or not path.suffix}
    assert odd == locks


# The same seed, the same values


def values_of(folder):
    """Bytes of every variable of the scans and spectra in a store."""
    return {
        (path.relative_to(folder).as_posix(), name): variable.values.tobytes()
        for part in ("spectra", "substitutes", "topography")
        for path in folder.glob(f"{part}/**/*.nc")
        for name, variable in dataset.read(path).variables.items()
    }


def test_the_same_seed_gives_the_same_values(finished, tmp_path):
    folder = copy_repository(tmp_path / "again")
    measured = "results/store-quick/topography"
    scans = ("uncd/study/scan-1-flat.nc", "ruby/study/scan-2-sphere-R250um.nc")
    run = run_snakemake(folder, *(f"{measured}/{scan}" for scan in scans))
    assert run.returncode == 0, run.stdout[-3000:]
    first, again = (values_of(part / "results/store-quick") for part in (finished, folder))
    assert len({path for path, _ in again}) == 6
    assert all(first[key] == values for key, values in again.items())
