"""Figures of contact and robustness: their tables repeat the datasets; gaps do not break them."""

import numpy as np
import pytest
import xarray as xr
from conftest import assert_leaves_alone, save_figure

from hardcontact.figures import fig5, fig_asperities, fig_elastic, fig_robustness, style

SUBSTRATES = ["polished_uncd", "uncd", "ncd", "mcd"]
LABELS = ["polished UNCD", "UNCD", "NCD", "MCD"]
SCANS, SPHERE_SCANS, CONTACTS = 3, 2, 4
PRELOADS = [1e-5, 2e-5]
RHO = np.array([0.5, 1.0, 2.0, 5.6, 10.0])
RADIUS, HARDNESS = 250e3, 25e9
VARIANTS = {  # group
    "baseline": "baseline",
    "laplacian": "curvature",
    "gaussian": "heights",
    "rough_sphere": "sphere",
    "preload-5uN": "preload",
    "preload-20uN": "preload",
}
PIXEL, PIXELS = 4.9, 65


@pytest.fixture
def rng():
    return np.random.default_rng(1)


def named():
    return xr.Dataset(
        {"label": ("surface", LABELS), "basis": ("surface", ["substitute"] * len(LABELS))},
        coords={"surface": SUBSTRATES},
    )


@pytest.fixture
def indent(rng):
    place = (np.arange(PIXELS) - PIXELS // 2) * PIXEL
    pit = np.clip(1 - (place[:, None] / 12) ** 2 - ((place - 4 * PIXEL) / 22) ** 2, 0, None)
    dims = ("preload", "scan", "sphere_scan", "contact_y", "contact_x")
    shape = (len(PRELOADS), SCANS, SPHERE_SCANS, CONTACTS, CONTACTS)
    growth = np.reshape([1.0, 1.4], (-1, 1, 1, 1, 1))
    sizes = {
        "depth": rng.uniform(1, 3, shape[1:]) * growth,
        "edge_length": PIXEL * np.sqrt(rng.integers(6, 17, shape[1:]) * growth**2),
        "lateral_size": PIXEL * rng.integers(4, 9, shape).astype(float),
        "indents": rng.integers(1, 4, shape).astype(float),
    }
    data = xr.Dataset(
        {name: (dims, values) for name, values in sizes.items()},
        coords={"preload": PRELOADS, "y": place, "x": place},
    )
    data["indentation"] = ("preload", "y", "x"), np.stack([pit, 2.7 * pit])
    data["sphere_height"] = ("y", "x"), (place[:, None] ** 2 + (place + 900) ** 2) / (2 * RADIUS)
    data.attrs = {
        "surface": "ncd",
        "label": "NCD",
        "basis": "substitute",
        "hardness": HARDNESS,
        "sphere_radius": RADIUS,
        "published_depth": 2.0,
        "published_edge_length": 50.0,
        "published_preload": 20e-6,
    }
    return data


@pytest.fixture
def elastic(rng):
    dims, shape = ("surface", "scan", "contact"), (len(SUBSTRATES), SCANS, CONTACTS)
    rigid = rng.lognormal(-16, 0.5, shape)
    contacts = {
        "contact_area": rng.uniform(200, 800, shape),
        "hard_share": rng.uniform(0.2, 0.9, shape),
        "peak_pressure": rng.lognormal(25, 0.5, shape),
        "mean_pressure": rng.lognormal(24, 0.2, shape),
        "iterations": rng.integers(5, 80, shape).astype(float),
        "rigid_pull_off_force": rigid,
        "elastic_pull_off_force": rigid * (1 - rng.uniform(0, 1e-3, shape)),
    }
    data = named().assign({name: (dims, values) for name, values in contacts.items()})
    place = (np.arange(64) - 32) * PIXEL
    hill = 1 - (place[:, None] ** 2 + place**2) / 60**2
    height = np.reshape([20, 60, 90, 120], (-1, 1, 1)) * 1e9
    data["pressure"] = ("surface", "y", "x"), height * np.sqrt(np.clip(hill, 0, None))
    data.attrs = {
        "hardness": HARDNESS,
        "preload": 1e-5,
        "effective_modulus": 290e9,
        "rho": 5.6,
        "work_of_adhesion": 0.0463,
        "window": 2500.0,
        "sphere_radius": RADIUS,
        "hertz_peak_pressure": 137e6,
    }
    order = np.tile(np.arange(CONTACTS), (len(SUBSTRATES), SCANS, 1))
    return data.assign_coords(
        scan=np.arange(1, SCANS + 1), y=place, x=place, contact_y=(dims, order)
    )


@pytest.fixture
def asperities(rng):
    dims = ("surface", "rho", "scan", "contact")
    shape = (len(SUBSTRATES), len(RHO), SCANS, CONTACTS)
    largest = rng.uniform(0.2, 0.6, shape)
    data = named().assign_coords(rho=RHO)
    data["largest_share"] = dims, largest
    data["two_largest_share"] = dims, largest + rng.uniform(0, 0.3, shape)
    data["patches"] = dims, rng.integers(2, 200, shape).astype(float)
    data["extent"] = dims, 1500 * np.sqrt(RHO)[:, None, None] * rng.uniform(0.3, 1, shape)
    data.attrs = {"share": 0.9, "sphere_radius": RADIUS}
    return data


def with_interval(data, name, dims, values):
    data[name] = dims, values
    data[f"{name}_low"], data[f"{name}_high"] = data[name] * 0.7, data[name] * 1.5


@pytest.fixture
def inference():
    data = named().assign_coords(
        contact_model=["rigid", "plastic"], side=["small", "large"], group=[*SUBSTRATES, "pooled"]
    )
    with_interval(data, "range_of_adhesion", "contact_model", [1.5, 5.2])
    with_interval(data, "work_of_adhesion", "contact_model", [0.2, 0.0447])
    critical = [[160.0, 32.0, 45.0, 95.0, 40.0], [1600.0, 1900.0, 2400.0, 1900.0, 1300.0]]
    with_interval(data, "critical_wavelength", ("side", "group"), critical)
    data.attrs = {"published_cutoff_large": 1800.0}
    return data


@pytest.fixture
def robustness(rng):
    count = len(VARIANTS)
    data = xr.Dataset(
        coords={
            "variant": list(VARIANTS),
            "variant_label": ("variant", [f"with {name}" for name in VARIANTS]),
            "group": ("variant", list(VARIANTS.values())),
            "side": ["small", "large"],
        }
    )
    spread = rng.uniform(0.5, 1.5, count)
    with_interval(data, "range_of_adhesion", "variant", 5.6 * spread)
    with_interval(data, "work_of_adhesion", "variant", 0.046 / spread)
    critical = np.array([43, 1800]) * rng.uniform(0.6, 1.4, (count, 2))
    with_interval(data, "critical_wavelength", ("variant", "side"), critical)
    data["best_error"] = "variant", rng.uniform(0.1, 0.3, count)
    only_scales = data["variant"] != "rough_sphere"
    for name in data.data_vars:
        if not name.startswith("critical"):
            data[name] = data[name].where(only_scales)
    data.attrs = {
        "sphere_radius": RADIUS,
        "published_range": 5.6,
        "published_range_uncertainty": 0.5,
        "published_work": 0.0463,
        "published_work_uncertainty": 0.0035,
        "published_cutoff_small": 43.0,
        "published_cutoff_large": 1800.0,
        "realizations": 3,
        "pixels_small": 4096,
        "pixels_large": 4096,
        "count": 10,
        "tolerance": 0.1,
        "range": 5.6,
    }
    return data


@pytest.fixture
def datasets(indent, elastic, asperities, inference, robustness):
    return {
        fig5: (indent,),
        fig_elastic: (elastic,),
        fig_asperities: (asperities, inference),
        fig_robustness: (robustness, inference),
    }


MODULES = [fig5, fig_elastic, fig_asperities, fig_robustness]
every_figure = pytest.mark.parametrize("module", MODULES, ids=lambda m: m.__name__.split(".")[-1])


def select(frame, **where):
    return frame[np.logical_and.reduce([frame[name] == value for name, value in where.items()])]


def measured(data):
    """The same dataset of measured scans, wherever it says what they are."""
    if "basis" in data.attrs:
        return data.assign_attrs(basis="measured")
    if "basis" in data:
        return data.assign(basis=xr.full_like(data["basis"], "measured"))
    return data


@every_figure
def test_public_names_are_table_and_draw(module):
    assert module.__all__ == ["draw", "table"]


@every_figure
def test_substitutes_are_named_on_the_figure(module, datasets):
    notes = [text.get_text() for text in module.draw(*datasets[module]).texts]
    substitutes = ["NCD"] if module is fig5 else LABELS
    assert len(notes) == 1
    assert notes[0].startswith(f"substitute surfaces: {', '.join(substitutes)} (")


@every_figure
def test_measured_surfaces_are_not_called_substitutes(module, datasets):
    figure = module.draw(*map(measured, datasets[module]))
    assert [text.get_text() for text in figure.texts] == ["all surfaces measured"]


@every_figure
def test_table_is_tidy_and_says_where_values_come_from(module, datasets):
    rows = module.table(*datasets[module])
    assert set(rows["origin"]) <= {"computed", "published", "given"}
    assert "published" in set(rows["origin"])
    assert rows["unit"].notna().all() and rows["panel"].notna().all()
    assert not rows.duplicated().any()
    if "surface" in rows:
        assert rows.loc[rows["surface"].notna(), "basis"].eq("substitute").all()


@every_figure
def test_saving_twice_gives_the_same_bytes(module, datasets, tmp_path):
    first, again = (save_figure(module, datasets[module], tmp_path / x) for x in "ab")
    assert first == again


@every_figure
def test_drawing_leaves_datasets_and_global_style_alone(module, datasets):
    assert_leaves_alone(module, datasets[module])


@every_figure
def test_no_text_is_smaller_than_seven_points(module, datasets):
    figure = module.draw(*datasets[module])
    assert min(text.get_fontsize() for text in figure.findobj(style.mpl.text.Text)) >= 7 * 0.99


@every_figure
def test_figure_has_print_width_and_fits_a_page(module, datasets):
    width, height = module.draw(*datasets[module]).get_size_inches()
    assert width == style.WIDTH and 2 < height < 9


@every_figure
def test_every_panel_has_its_letter(module, datasets):
    titles = [axes.get_title(loc="left") for axes in module.draw(*datasets[module]).axes]
    lettered = {title.split("}")[0].removeprefix(r"$\mathbf{")[0] for title in titles if title}
    assert lettered == set(module.table(*datasets[module])["panel"]) | {"a"}


# Fig. 5


def test_fig5_lines_go_through_the_deepest_point_of_the_published_preload(indent):
    rows = fig5.table(indent)
    for along, panel, length in (("x", "b", 4 * PIXEL), ("y", "c", 0)):
        before, after = (
            select(rows, panel=panel, quantity=f"height_{when}").set_index("position")["value"]
            for when in ("before", "after")
        )
        depth = before - after
        assert list(depth.index) == list(indent[along].values)
        assert depth.idxmax() == pytest.approx(length)
        assert depth.max() == pytest.approx(indent["indentation"].max().item())
    assert before.max() <= 0  # the sphere falls away from its apex
    assert set(select(rows, panel="b")["preload"]) == {2e-5}


def test_fig5_distributions_hold_the_contacts_of_each_preload(indent):
    rows = fig5.table(indent)
    for panel, name in (("d", "depth"), ("e", "edge_length"), ("f", "lateral_size")):
        for preload in PRELOADS:
            of_contacts = indent[name].sel(preload=preload).values.ravel()
            drawn = select(
                rows, panel=panel, quantity=name, origin="computed", preload=preload
            ).set_index("share")["value"]
            assert drawn[0.0] == of_contacts.min() and drawn[1.0] == of_contacts.max()
            assert np.mean(of_contacts <= drawn[0.5]) >= 0.5 > np.mean(of_contacts < drawn[0.5])
    published = select(rows, origin="published").set_index("quantity")["value"].to_dict()
    assert published == {"depth": 2.0, "edge_length": 50.0, "lateral_size": 50.0}


def test_fig5_shows_every_indent_of_the_map(indent):
    pressed = indent["indentation"].sel(preload=2e-5)
    pressed = pressed.where(pressed > 0, drop=True)
    for along in "xy":
        low, high = fig5._view(indent, along)
        assert low <= pressed[along].min() and pressed[along].max() <= high


def test_fig5_takes_the_nearest_preload_and_missing_scans(indent, tmp_path):
    indent["depth"][:, 1] = np.nan
    one = indent.sel(preload=[1e-5])
    assert save_figure(fig5, (indent,), tmp_path) and save_figure(fig5, (one,), tmp_path)
    assert set(select(fig5.table(one), panel="b")["preload"]) == {1e-5}
    depths = select(fig5.table(indent), quantity="depth", origin="computed")["value"]
    assert depths.notna().all()


# Elastic contact


def test_elastic_table_holds_every_contact_and_its_median(elastic):
    rows = fig_elastic.table(elastic)
    ratio = elastic["elastic_pull_off_force"] / elastic["rigid_pull_off_force"]
    for name, values in (
        ("hard_share", elastic["hard_share"]),
        ("peak_pressure", elastic["peak_pressure"]),
        ("elastic_over_rigid", ratio),
    ):
        of_surface = values.sel(surface="ncd").values
        contacts = select(rows, surface="ncd", quantity=name)["value"]
        assert sorted(contacts) == sorted(of_surface.ravel())
        median = select(rows, surface="ncd", quantity=f"{name}_median")["value"].item()
        assert median == pytest.approx(np.median(of_surface))


def test_elastic_table_holds_the_levels_drawn(elastic):
    levels = select(fig_elastic.table(elastic), panel="c").query("origin != 'computed'")
    assert levels.set_index("quantity")["value"].to_dict() == {"hardness": HARDNESS}
    rows = fig_elastic.table(elastic)
    assert select(rows, quantity="hertz_peak_pressure")["value"].item() == 137e6
    most = select(rows, origin="published", quantity="hard_share")
    assert (most["low"].item(), most["high"].item()) == (0.5, 1.0)


def test_elastic_colours_turn_at_the_hardness(elastic):
    maps = [axes for axes in fig_elastic.draw(elastic).axes if axes.get_xlabel() == "x (nm)"]
    assert len(maps) == len(SUBSTRATES)
    for axes in maps:
        assert axes.collections[0].norm(HARDNESS / 1e9) == pytest.approx(0.5)


def test_elastic_scale_holds_every_contact(elastic):
    axes = fig_elastic.draw(elastic).axes
    forces = next(one for one in axes if one.get_ylabel().startswith("elastic / rigid"))
    drawn = np.concatenate([line.get_ydata() for line in forces.lines if line.get_marker() == "o"])
    ratio = elastic["elastic_pull_off_force"] / elastic["rigid_pull_off_force"]
    assert np.sort(drawn) == pytest.approx(np.sort(100 * (ratio.values.ravel() - 1)))
    low, high = forces.get_ylim()
    assert low < drawn.min() and drawn.max() <= high < 1


def test_elastic_figure_with_missing_scans(elastic, tmp_path):
    dims = ("surface", "scan", "contact")
    for name in [name for name, values in elastic.items() if values.dims == dims]:
        elastic[name][1, 2] = np.nan
    assert save_figure(fig_elastic, (elastic,), tmp_path)
    shares = select(fig_elastic.table(elastic), surface="uncd", quantity="hard_share")
    assert len(shares) == (SCANS - 1) * CONTACTS and set(shares["scan"]) == {1, 2}


# Asperities


def test_asperities_table_holds_median_and_quartiles(asperities, inference):
    rows = fig_asperities.table(asperities, inference)
    for name in ("largest_share", "two_largest_share", "patches", "extent"):
        of_contacts = asperities[name].sel(surface="mcd", rho=2.0).values.ravel()
        drawn = select(rows, surface="mcd", quantity=name, rho=2.0)[["low", "value", "high"]]
        assert drawn.values[0] == pytest.approx(np.percentile(of_contacts, [25, 50, 75]))


def test_asperities_lengths_are_those_of_a_smooth_sphere(asperities, inference):
    rows = fig_asperities.table(asperities, inference)
    radius = select(rows, quantity="interaction_radius", rho=5.6)["value"].item()
    assert radius == pytest.approx(1673.3, abs=0.1)  # the paper's 1.7 um
    diameter = select(rows, quantity="smooth_extent", rho=5.6)["value"].item()
    r = np.linspace(0, 20 * radius, 200_001)
    attraction = r * np.exp(-(r**2) / (2 * RADIUS * 5.6))
    assert attraction[r < diameter / 2].sum() / attraction.sum() == pytest.approx(0.9, abs=1e-3)


def test_asperities_table_holds_the_critical_wavelength(asperities, inference):
    rows = fig_asperities.table(asperities, inference)
    critical = select(rows, quantity="critical_wavelength").set_index("origin")
    assert critical["value"].to_dict() == {"computed": 1300.0, "published": 1800.0}
    ends = critical.loc["computed", ["low", "high"]].astype(float)
    assert list(ends) == pytest.approx([0.7 * 1300, 1.5 * 1300])


def test_asperities_draws_lengths_in_micrometres(asperities, inference):
    last = fig_asperities.draw(asperities, inference).axes[3]
    drawn = {line.get_label(): np.asarray(line.get_ydata()) for line in last.lines}
    assert drawn["published $λ_L$ (d)"][0] == 1.8
    extent = asperities["extent"].sel(surface="uncd").median(["scan", "contact"]) / 1000
    assert drawn["UNCD"] == pytest.approx(extent.values)


def test_asperities_figure_with_gaps(asperities, inference, tmp_path):
    for name in ("largest_share", "two_largest_share", "patches", "extent"):
        asperities[name][2, :, 1] = np.nan
    for end in ("", "_low", "_high"):
        inference[f"critical_wavelength{end}"][:] = np.nan
    assert save_figure(fig_asperities, (asperities, inference), tmp_path)
    curve = select(fig_asperities.table(asperities, inference), surface="ncd", quantity="patches")
    assert len(curve) == len(RHO) and curve["value"].notna().all()


# Robustness


def test_robustness_table_holds_variants_study_and_published(robustness, inference):
    rows = fig_robustness.table(robustness, inference)
    assert len(rows) == 4 * (len(VARIANTS) + 2)
    work = select(rows, quantity="work_of_adhesion")
    of_variant = robustness.sel(variant="preload-5uN")
    drawn = select(work, variant="preload-5uN")[["value", "low", "high"]].values[0]
    expected = [of_variant[f"work_of_adhesion{end}"].item() for end in ("", "_low", "_high")]
    assert list(drawn) == expected
    study = select(work, label="the study itself")["value"].item()
    assert study == 0.0447
    published = select(work, origin="published")[["value", "low", "high"]].values[0]
    assert list(published) == pytest.approx([0.0463, 0.0428, 0.0498])


def test_robustness_tells_short_from_long_cutoffs(robustness, inference):
    rows = fig_robustness.table(robustness, inference)
    for side, published, study in (("small", 43.0, 40.0), ("large", 1800.0, 1300.0)):
        of_side = select(rows, quantity=f"critical_wavelength_{side}")
        assert select(of_side, origin="published")["value"].item() == published
        assert select(of_side, label="the study itself")["value"].item() == study
        variants = of_side[of_side["variant"].notna()]["value"]
        assert list(variants) == list(robustness["critical_wavelength"].sel(side=side).values)


def written(axes):
    return [text.get_text() for text in axes.texts]


def test_robustness_says_what_a_variant_does_not_affect(robustness, inference, tmp_path):
    robustness["critical_wavelength"].loc[{"variant": "gaussian", "side": "large"}] = np.nan
    panels = fig_robustness.draw(robustness, inference).axes
    assert [written(axes) for axes in panels] == [
        ["not affected"],
        ["not affected"],
        [],
        ["never reached"],
    ]
    assert save_figure(fig_robustness, (robustness, inference), tmp_path)


def test_robustness_rows_are_the_variants_in_their_order(robustness, inference):
    first = fig_robustness.draw(robustness, inference).axes[0]
    assert [text.get_text() for text in first.get_yticklabels()] == [
        f"with {name}" for name in VARIANTS
    ]
    heights = fig_robustness._heights(robustness)
    steps = dict(zip(list(VARIANTS)[1:], np.diff(heights), strict=True))
    assert steps["preload-20uN"] == 1 and steps["preload-5uN"] > 1
    low, high = first.get_ylim()
    assert low > heights[-1] and high < 0  # the baseline on top


def test_robustness_draws_one_variant_alone(robustness, inference, tmp_path):
    assert save_figure(fig_robustness, (robustness.isel(variant=[0]), inference), tmp_path)
