"""The figures: their tables repeat the datasets, substitutes are named, saving is repeatable."""

import json
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from conftest import assert_leaves_alone, save_figure
from matplotlib.colors import same_color

from hardcontact.figures import fig1, fig3, fig4, fig6, style, table1
from hardcontact.topography import table1_variables

SUBSTRATES = ["polished_uncd", "uncd", "ncd", "mcd"]
LABELS = ["polished UNCD", "UNCD", "NCD", "MCD"]
SURFACES = [*SUBSTRATES, "ruby"]
MODELS = ["rigid", "plastic"]
RHO = np.geomspace(0.3, 20, 13)
PUBLISHED_MEAN = np.array([8.8, 0.4, 0.16, 0.11]) * 1e-6
PUBLISHED_MEDIAN = np.array([1.75, 0.31, 0.12, 0.06]) * 1e-6
RANGE, WORK = 5.2, 0.0447
SCANS, SPHERE_SCANS, REALIZATIONS = 5, 2, 5
SMALL_CUTOFFS, LARGE_CUTOFFS = np.geomspace(5, 2000, 10), np.geomspace(150, 10000, 10)


def named(surfaces, labels, basis="substitute"):
    return xr.Dataset(
        {"label": ("surface", labels), "basis": ("surface", [basis] * len(surfaces))},
        coords={"surface": surfaces},
    )


@pytest.fixture
def rng():
    return np.random.default_rng(1)


def rough(rng, rms, pixels=96):
    """Return a random map (nm) of the given rms whose waves grow with their length."""
    q = np.hypot(np.fft.fftfreq(pixels)[:, None], np.fft.rfftfreq(pixels))
    q[0, 0] = np.inf
    heights = np.fft.irfft2(np.fft.rfft2(rng.normal(size=(pixels, pixels))) * q**-1.6)
    return heights * rms / heights.std()


@pytest.fixture
def topography(rng):
    rms = np.array([3.2, 17.4, 97.1, 107.1, 0.7])
    data = named(SURFACES, [*LABELS, "ruby"])
    dims = ("surface", "row", "column")
    data["example_heights"] = dims, np.stack([rough(rng, height) for height in rms])
    place = np.linspace(-1250, 1250, 96)
    cap = -(place[:, None] ** 2 + place**2) / (2 * 250_000)
    data["sphere_as_scanned"] = data["example_heights"].sel(surface="ruby", drop=True) + cap
    data["scan_size"] = "surface", np.full(5, 2500.0)
    means = {
        "rms_height": rms,
        "rms_gradient": np.array([0.04, 0.39, 0.51, 0.49, 0.01]),
        "rms_profile_slope": np.array([0.04, 0.39, 0.51, 0.49, 0.01]) / np.sqrt(2),
        "rms_half_laplacian": np.array([2.0e-3, 4.8e-2, 3.9e-2, 2.8e-2, 5e-4]),
        "rms_laplacian": np.array([2.0e-3, 4.8e-2, 3.9e-2, 2.8e-2, 5e-4]) * 2,
    }
    for name, values in means.items():
        data[f"{name}_mean"] = "surface", values * 1.01
        data[f"{name}_std"] = "surface", values * 0.1
    data["all_scales_rms_height"] = "surface", [4.2, 17.4, 97.2, 101.2, np.nan]
    data["all_scales_rms_gradient"] = "surface", [0.31, 1.17, 0.92, 0.85, np.nan]
    data["all_scales_rms_half_laplacian"] = "surface", [1.99, 6.32, 5.91, 5.04, np.nan]
    data["all_scales_rms_profile_slope"] = data["all_scales_rms_gradient"] / np.sqrt(2)
    data["all_scales_rms_laplacian"] = data["all_scales_rms_half_laplacian"] * 2
    rows = "afm_rms_height,afm_rms_slope,afm_rms_curvature"
    data["calibrated_to_table1"] = "surface", [rows] * 4 + [""]
    names = json.dumps(table1_variables("gradient", "half_laplacian"))
    data.attrs = {
        "sphere_surface": "ruby",
        "reference_surface": "uncd",
        "table1_variables": names,
    }
    return data


@pytest.fixture
def table1_published():
    values = {
        "afm_rms_height": ([3.2, 17.4, 97.1, 107.1], [1.6, 2.1, 11.2, 12.0]),
        "afm_rms_slope": ([0.04, 0.39, 0.51, 0.49], [0.01, 0.05, 0.07, 0.07]),
        "afm_rms_curvature": ([2.0e-3, 4.8e-2, 3.9e-2, 2.8e-2], [1.3e-3, 3.8e-3, 1.1e-2, 6.6e-3]),
        "all_rms_height": ([4.2, 17.4, 97.2, 101.2], [0.8, 1.3, 11.7, 8.0]),
        "all_rms_slope": ([0.31, 1.17, 0.92, 0.85], [0.08, 0.28, 0.10, 0.10]),
        "all_rms_curvature": ([1.99, 6.32, 5.91, 5.04], [0.35, 1.20, 1.83, 1.45]),
    }
    return pd.DataFrame(
        {"surface": surface, "quantity": quantity, "value": value, "uncertainty": uncertainty}
        for quantity, columns in values.items()
        for surface, value, uncertainty in zip(SUBSTRATES, *columns, strict=True)
    )


def mean_force(rho):
    """Return forces (surface, rho) in N at W = 1 J/m2, near the published ones at W = WORK."""
    steepness = np.array([1.6, 1.0, 0.35, 0.25])[:, None]
    factor = np.array([2.3, 1.3, 0.8, 1.3])[:, None]
    return PUBLISHED_MEAN[:, None] / WORK * factor * (rho / RANGE) ** steepness


@pytest.fixture
def adhesion(rng):
    shape = np.array([1.0, 0.7, 0.8, 0.9])
    size = (SCANS, SPHERE_SCANS, 1, 6, 6)
    scatter = np.stack([rng.lognormal(-(s**2) / 2, s, size) for s in shape])
    force = np.einsum("asbcij,ar->asbcrij", scatter, mean_force(RHO))
    data = named(SUBSTRATES, LABELS).assign_coords(contact_model=MODELS, rho=RHO)
    data["pull_off_force"] = (
        ("surface", "scan", "sphere_scan", "contact_model", "rho", "contact_y", "contact_x"),
        np.concatenate([0.3 * force, force], axis=3),
    )
    data.attrs["work_of_adhesion"] = 1.0
    return data


@pytest.fixture
def contact():
    x = np.linspace(-6250, 6250, 201)
    hills = 12 * np.sin(x / 150)[:, None] * np.sin(x / 190) + 12
    gap = xr.DataArray(
        (x[:, None] ** 2 + x**2) / (2 * 250_000) + hills, dims=("y", "x"), coords={"x": x, "y": x}
    )
    separation = np.linspace(0, 30, 61)
    return xr.Dataset(
        {
            "gap": gap,
            "adhesive_pressure": 0.0447 / 5.2e-9 * np.exp(-gap / 5.2),
            "force": ("separation", -5e-7 * np.exp(-separation / 5.2)),
        },
        coords={"separation": separation},
        attrs={"surface": "uncd", "label": "UNCD", "basis": "substitute", "pull_off_force": 5e-7},
    )


def with_interval(data, name, dims, values, spread=0.2):
    data[name] = dims, values
    data[f"{name}_low"], data[f"{name}_high"] = data[name] * (1 - spread), data[name] * (1 + spread)


@pytest.fixture
def inference(rng):
    rho_fine, work = np.geomspace(0.5, 15, 60), np.geomspace(0.01, 0.2, 50)
    both = "contact_model"
    data = named(SUBSTRATES, LABELS).assign_coords(
        contact_model=MODELS,
        rho=RHO,
        rho_fine=rho_fine,
        work=work,
        side=["small", "large"],
        group=[*SUBSTRATES, "pooled"],
        cutoff_wavelength=np.unique([*SMALL_CUTOFFS, *LARGE_CUTOFFS]),
    )
    force = mean_force(RHO)
    with_interval(data, "mean_force", (both, "surface", "rho"), np.stack([0.3 * force, force]))
    ratio = force / force[1]
    with_interval(data, "ratio", (both, "surface", "rho"), np.stack([ratio, ratio]))
    for name, values in {
        "published_mean_force": PUBLISHED_MEAN,
        "published_median_force": PUBLISHED_MEDIAN,
        "published_ratio": PUBLISHED_MEAN / PUBLISHED_MEAN[1],
        "published_lognormal_shape": np.sqrt(2 * np.log(PUBLISHED_MEAN / PUBLISHED_MEDIAN)),
        "published_lognormal_median": PUBLISHED_MEDIAN,
    }.items():
        data[name] = "surface", values
    error = 0.03 + np.hypot(np.log(rho_fine / RANGE)[:, None], np.log(work / WORK))
    data["mean_relative_error"] = (both, "rho_fine", "work"), np.stack([error + 1, error])
    data["best_error"] = both, [1.03, 0.03]
    with_interval(data, "range_from_ratios", both, [3.0, 4.9])
    with_interval(data, "range_of_adhesion", both, [3.0, RANGE])
    with_interval(data, "work_of_adhesion", both, [0.2, WORK])
    for name, values in {
        "region_range_low": [np.nan, 5.1],
        "region_range_high": [np.nan, 5.3],
        "region_work_low": [np.nan, 0.044],
        "region_work_high": [np.nan, 0.046],
    }.items():
        data[name] = both, values
    data["bootstrap_range"] = (both, "sample"), RANGE * rng.lognormal(0, 0.15, (2, 300))
    data["bootstrap_work"] = (both, "sample"), WORK * rng.lognormal(0, 0.2, (2, 300))
    fitted = force[:, 8] * WORK
    with_interval(data, "lognormal_shape", (both, "surface"), np.full((2, 4), 0.8))
    with_interval(data, "lognormal_median", (both, "surface"), np.stack([fitted, fitted]) * 0.7)
    with_interval(data, "force_mean", (both, "surface"), np.stack([fitted, fitted]))
    with_interval(data, "force_median", (both, "surface"), np.stack([fitted, fitted]) * 0.7)
    data["censored_fraction"] = (both, "surface"), np.full((2, 4), 0.1)
    add_scales(data)
    data.attrs = {
        "error_threshold": 0.1,
        "force_floor": 30e-9,
        "scale_tolerance": 0.1,
        "published_range": 5.6,
        "published_range_uncertainty": 0.5,
        "published_work": 0.0463,
        "published_work_uncertainty": 0.0035,
        "published_cutoff_small": 43.0,
        "published_cutoff_large": 1800.0,
    }
    return data


def filtered_ratio(cutoff, reach):
    """Return a plausible scale ratio (group, side, cutoff), NaN where a side has no cutoff."""
    small = 1 + (cutoff / (20 * reach[:, None])) ** 1.2 / 10
    large = 1 + (8000 / reach[:, None] / cutoff) ** 1.2 / 20
    small[:, ~np.isin(cutoff, SMALL_CUTOFFS)] = np.nan
    large[:, ~np.isin(cutoff, LARGE_CUTOFFS)] = np.nan
    return np.stack([small, large], axis=1)


def add_scales(data):
    reach = np.array([8.0, 2.0, 3.0, 3.5, 3.0])
    ratio = filtered_ratio(data["cutoff_wavelength"].values, reach)
    with_interval(data, "scale_ratio", ("group", "side", "cutoff_wavelength"), ratio)
    critical = np.stack([20 * reach, 5000 / reach])
    critical[1, 0] = np.nan
    with_interval(data, "critical_wavelength", ("side", "group"), critical)


@pytest.fixture
def scales(inference, rng):
    ratio = inference["scale_ratio"].sel(group=SUBSTRATES).rename(group="surface")
    scatter = xr.DataArray(rng.lognormal(0, 0.15, REALIZATIONS), dims="realization")
    data = named(SUBSTRATES, LABELS).assign(ratio=ratio**scatter)
    return data.assign_coords(realization=np.arange(1, REALIZATIONS + 1))


@pytest.fixture
def datasets(topography, table1_published, adhesion, contact, inference, scales):
    return {
        fig1: (topography,),
        fig3: (adhesion, inference),
        fig4: (contact, inference),
        fig6: (inference, scales),
        table1: (topography, table1_published),
    }


MODULES = [fig1, fig3, fig4, fig6, table1]
every_figure = pytest.mark.parametrize("module", MODULES, ids=lambda m: m.__name__.split(".")[-1])


def texts(figure):
    return [text.get_text() for text in figure.texts]


def select(frame, **where):
    return frame[np.logical_and.reduce([frame[name] == value for name, value in where.items()])]


@every_figure
def test_public_names_are_table_and_draw(module):
    assert module.__all__ == ["draw", "table"]


@every_figure
def test_substitutes_are_named_on_the_figure(module, datasets):
    named_on = [text for text in texts(module.draw(*datasets[module])) if "substitute" in text]
    assert len(named_on) == 1
    assert all(label in named_on[0] for label in LABELS)


@every_figure
def test_measured_surfaces_are_not_called_substitutes(module, datasets):
    measured = [
        data.assign(basis=xr.full_like(data["basis"], "measured")) if "basis" in data else data
        for data in datasets[module]
    ]
    assert texts(module.draw(*measured))[-1] == "all surfaces measured"


def test_only_the_substitutes_are_named(topography):
    basis = xr.where(topography["surface"] == "ncd", "substitute", "measured")
    note = texts(fig1.draw(topography.assign(basis=basis)))[-1]
    assert note.startswith("substitute surfaces: NCD (")


@every_figure
def test_table_is_tidy_and_says_where_values_come_from(module, datasets):
    rows = module.table(*datasets[module])
    assert set(rows["origin"]) <= {"computed", "published"}
    assert rows["unit"].notna().all()
    assert not rows.duplicated().any()


@every_figure
def test_saving_twice_gives_the_same_bytes(module, datasets, tmp_path):
    first, second = (
        save_figure(module, datasets[module], tmp_path / name) for name in ("first", "second")
    )
    assert first == second
    names = {"figure.pdf", "figure.png", "figure.csv", "figure.json"}
    assert {path.name for path in (tmp_path / "first").iterdir()} == names


@every_figure
def test_drawing_leaves_datasets_and_global_style_alone(module, datasets):
    assert_leaves_alone(module, datasets[module])


@every_figure
def test_no_text_is_smaller_than_seven_points(module, datasets):
    figure = module.draw(*datasets[module])
    assert min(text.get_fontsize() for text in figure.findobj(style.mpl.text.Text)) >= 7 * 0.99


def test_figures_take_other_surfaces(datasets, tmp_path):
    def renamed(data):
        kept = [name for name in ("uncd", "ncd", "ruby") if name in data["surface"]]
        data = data.sel(surface=kept)
        if "group" in data.dims:
            data = data.sel(group=["uncd", "ncd", "pooled"])
            data["group"] = ["glass", "steel", "pooled"]
        data["surface"] = ["glass", "steel", "ruby"][: len(kept)]
        return data

    inference = renamed(datasets[fig6][0])
    contact = datasets[fig4][0].assign_attrs(surface="glass")
    for figure in (
        fig1.draw(renamed(datasets[fig1][0])),
        fig3.draw(renamed(datasets[fig3][0]), inference),
        fig4.draw(contact, inference),
        fig6.draw(inference, renamed(datasets[fig6][1])),
        table1.draw(renamed(datasets[table1][0]), datasets[table1][1]),
    ):
        figure.savefig(tmp_path / "figure.png")


def test_nothing_is_written_when_saving_fails(topography, tmp_path, monkeypatch):
    class Broken(pd.DataFrame):
        def to_csv(self, path, **_):
            Path(path).write_text("half")
            raise OSError("disk full")

    monkeypatch.setattr(fig1, "table", lambda *_: Broken())
    with pytest.raises(ValueError, match="figure.csv: expected a file to be written, found: disk"):
        save_figure(fig1, [topography], tmp_path)
    assert not list(tmp_path.iterdir())


def test_a_surface_has_the_same_colour_in_every_figure(datasets):
    expected = style.colours(SUBSTRATES)["ncd"]
    maps = fig1.draw(*datasets[fig1]).axes[2]
    assert same_color(maps.spines["left"].get_edgecolor(), expected)
    histogram = fig3.draw(*datasets[fig3]).axes[2].patches[0]
    assert same_color(histogram.get_facecolor()[:3], expected)
    for module, panel in ((fig4, "pull-off force (µN)"), (fig6, "pull-off force / unfiltered")):
        figure = module.draw(*datasets[module])
        axes = next(axes for axes in figure.axes if axes.get_ylabel() == panel)
        assert any(same_color(line.get_color(), expected) for line in axes.lines)
    header = {text.get_text(): text for text in table1.draw(*datasets[table1]).axes[0].texts}
    assert same_color(header["NCD"].get_color(), expected)


def test_colours_follow_the_order_of_any_surfaces():
    assert style.colours(["x", "ball", "y"], "ball") == {
        **style.colours(["x", "y"]),
        "ball": style.SPHERE,
    }


def test_fig1_table_holds_the_rms_height_of_each_map(topography):
    rows = fig1.table(topography)
    drawn = select(rows, surface="mcd", quantity="map_rms_height")["value"].item()
    assert drawn == pytest.approx(107.1)
    over_scans = select(rows, surface="uncd", quantity="rms_height_mean")
    assert over_scans["value"].item() == topography["rms_height_mean"].sel(surface="uncd").item()
    assert list(select(rows, surface="ruby", quantity="map_rms_height")["panel"]) == ["e", "f"]


def test_fig3_scales_the_forces_to_the_fitted_range_and_work(adhesion, inference):
    fitted = fig3._forces_at_fit(adhesion, inference)["uncd"]
    at_one = adhesion["pull_off_force"].sel(surface="uncd", contact_model="plastic", rho=RHO[0])
    # the synthetic forces grow as rho for this surface, which log-log interpolation keeps exactly
    assert np.sort(fitted) == pytest.approx(np.sort(at_one.values.ravel()) * RANGE / RHO[0] * WORK)


def test_fig3_table_holds_published_and_computed_lognormals(adhesion, inference):
    rows = fig3.table(adhesion, inference)
    shape = select(rows, surface="polished_uncd", quantity="lognormal_shape").set_index("origin")
    assert shape["value"]["published"] == pytest.approx(np.sqrt(2 * np.log(8.8 / 1.75)))
    assert shape["value"]["computed"] == 0.8
    assert (shape["low"]["computed"], shape["high"]["computed"]) == pytest.approx((0.64, 0.96))


def test_fig3_logarithmic_histogram_holds_every_force(adhesion, inference):
    rows = select(fig3.table(adhesion, inference), surface="mcd", panel="2")
    widths = rows["force_high"] - rows["force_low"]
    assert (rows["value"] * widths).sum() == pytest.approx(1)


def test_fig4_table_holds_the_numbers_of_the_dataset(contact, inference):
    rows = fig4.table(contact, inference)
    computed = select(rows, surface="mcd", quantity="mean_force", origin="computed")
    expected = inference["mean_force"].sel(surface="mcd", contact_model="plastic") * WORK
    assert computed["value"].values == pytest.approx(expected.values)
    published = select(rows, surface="mcd", quantity="ratio", origin="published")
    assert published["value"].item() == PUBLISHED_MEAN[3] / PUBLISHED_MEAN[1]
    work = select(rows, quantity="work_of_adhesion").set_index("origin")
    assert work["value"].to_dict() == {"computed": WORK, "published": 0.0463}
    assert len(select(rows, quantity="bootstrap_work_of_adhesion")) == inference.sizes["sample"]


def test_fig4_finds_the_reference_surface(inference):
    assert fig4._reference(inference.sel(contact_model="plastic")) == "uncd"


def test_fig4_draws_without_an_error_region(contact, inference, tmp_path):
    model = {"contact_model": "plastic"}
    for name in ("range_low", "range_high", "work_low", "work_high"):
        inference[f"region_{name}"].loc[model] = np.nan
    inference["mean_relative_error"] += 0.5
    inference["range_from_ratios_low"].loc[model] = np.nan
    save_figure(fig4, (contact, inference), tmp_path)


def test_fig6_table_holds_ratios_realizations_and_critical_wavelengths(inference, scales):
    rows = fig6.table(inference, scales)
    ratios = select(rows, group="ncd", side="small", quantity="ratio")
    assert len(ratios) == len(SMALL_CUTOFFS) * (1 + REALIZATIONS)
    critical = select(rows, group="pooled", side="small", quantity="critical_wavelength")
    assert critical.set_index("origin")["value"].to_dict() == {"published": 43.0, "computed": 60.0}
    never = select(rows, group="polished_uncd", side="large", quantity="critical_wavelength")
    assert never["value"].isna().all()


def test_fig6_draws_when_no_ratio_leaves_the_band(inference, scales, tmp_path):
    for end in ("", "_low", "_high"):
        inference[f"critical_wavelength{end}"][:] = np.nan
    save_figure(fig6, (inference, scales), tmp_path)


def test_table1_marks_what_agrees_by_construction(topography, table1_published):
    rows = table1.table(topography, table1_published)
    marked = rows[rows["calibrated"]]
    assert set(marked["quantity"]) == {"afm_rms_height", "afm_rms_slope", "afm_rms_curvature"}
    assert set(marked["definition"]) == {"", "gradient", "half the Laplacian"}
    drawn = {text.get_text() for text in table1.draw(topography, table1_published).axes[0].texts}
    assert "107.1 ± 12.0" in drawn  # as published
    assert "108 ± 11 †" in drawn


def test_table1_table_holds_published_and_computed_values(topography, table1_published):
    rows = select(
        table1.table(topography, table1_published), surface="ncd", quantity="afm_rms_curvature"
    )
    assert list(rows["origin"]) == ["published", "computed", "computed"]
    assert list(rows["value"]) == pytest.approx([3.9e-2, 1.01 * 3.9e-2, 1.01 * 7.8e-2])
    assert list(rows["uncertainty"]) == pytest.approx([1.1e-2, 3.9e-3, 7.8e-3])
