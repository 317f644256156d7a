"""Closed forms of adhesive contact against each other, brute force and published numbers."""

import numpy as np
import pytest
import xarray as xr
from conftest import assert_says, refusal, save_figure
from scipy.integrate import quad
from scipy.optimize import brentq
from scipy.stats import norm

from hardcontact import classical, hertz, rough_adhesion
from hardcontact.figures import fig_classical, style
from hardcontact.rough_adhesion import MODELS, Contact, Roughness

RADIUS, SPACING, WORK = 250e3, 0.3, 0.0463
MODULUS = hertz.effective_modulus(365e9, 0.29, 1010e9, 0.22)
CONTACT = Contact(RADIUS, MODULUS, SPACING)
PUBLISHED = np.array([8.8, 0.4, 0.16, 0.11]) * 1e-6
AFM = Roughness(
    np.array([3.2, 17.4, 97.1, 107.1]),
    np.array([0.04, 0.39, 0.51, 0.49]),
    np.array([2.0e-3, 4.8e-2, 3.9e-2, 2.8e-2]),
)
UNCERTAINTY = Roughness(
    np.array([1.6, 2.1, 11.2, 12.0]),
    np.array([0.01, 0.05, 0.07, 0.07]),
    np.array([1.3e-3, 3.8e-3, 1.1e-2, 6.6e-3]),
)
LAMBDAS = np.geomspace(0.01, 100, 41)


# Smooth spheres


def test_numbers_of_ruby_on_diamond():
    assert MODULUS == pytest.approx(289.7e9, rel=2e-4)
    contact, pressure, approach = hertz.contact(10e-6, RADIUS, MODULUS)
    assert pressure == pytest.approx(137e6, rel=5e-3)  # 135 MPa are published
    assert approach == pytest.approx(contact**2 / RADIUS)
    tabor = classical.tabor_parameter(WORK, RADIUS, MODULUS, SPACING)
    assert tabor == pytest.approx(0.618, abs=5e-4)
    assert classical.maugis_parameter(tabor) == pytest.approx(0.7155, abs=5e-4)
    assert classical.maugis_parameter(1.0) == pytest.approx(1.157, abs=1e-4)


def test_hertz_pressure_carries_the_load():
    contact, pressure, _ = hertz.contact(3e-6, 5e3, 100e9)
    assert 2 / 3 * np.pi * (contact * 1e-9) ** 2 * pressure == pytest.approx(3e-6)


@pytest.mark.parametrize("law", ["transition_coefficient", "maugis_dugdale_coefficient"])
def test_transition_leads_from_dmt_to_jkr(law):
    coefficient = getattr(classical, law)(LAMBDAS)
    assert (np.diff(coefficient) < 0).all()
    assert coefficient[0] == pytest.approx(2, abs=5e-3)
    assert coefficient[-1] == pytest.approx(1.5, abs=5e-4)
    assert classical.dmt_pull_off(WORK, RADIUS) == pytest.approx(72.7e-6, rel=1e-3)
    assert classical.jkr_pull_off(WORK, RADIUS) == pytest.approx(1.5 / 2 * 72.7e-6, rel=1e-3)


def test_fit_keeps_to_the_exact_pair():
    error = classical.transition_coefficient(LAMBDAS) / classical.maugis_dugdale_coefficient(
        LAMBDAS
    )
    assert np.abs(error - 1).max() == pytest.approx(0.0165, abs=5e-4)


@pytest.mark.parametrize("maugis", [0.03, 0.3, 0.937, 5.0])
def test_exact_pair_by_solving_for_the_cohesive_zone(maugis):
    """The pair as printed: the first equation gives m for a radius, the second the force."""

    def root_and_angle(m):
        return np.sqrt(m**2 - 1), np.arctan(np.sqrt(m**2 - 1))

    def balance(m, radius):
        root, angle = root_and_angle(m)
        own = maugis * radius**2 / 2 * (root + (m**2 - 2) * angle)
        return own + 4 / 3 * maugis**2 * radius * (root * angle - m + 1) - 1

    def force(radius):
        m = brentq(balance, 1, 1e6, args=(radius,))
        root, angle = root_and_angle(m)
        return radius**3 - maugis * radius**2 * (root + m**2 * angle)

    least = min(force(radius) for radius in np.linspace(0.01, 2.0, 800))
    assert classical.maugis_dugdale_coefficient(maugis) == pytest.approx(-least, rel=1e-5)


def test_printed_tabor_parameter_is_not_what_printed_works_imply():
    """8.8 µN and 7.15 mJ/m² imply 1.557 to 1.577; a Tabor parameter of 0.81 gives 1.61."""
    half_force, half_work = (rough_adhesion.half_unit(text) for text in ("8.8e-6", "7.15e-3"))
    assert (half_force, half_work) == pytest.approx((5e-8, 5e-6))
    force, work = 8.8e-6, 7.15e-3
    low, high = (
        classical.effective_work_of_adhesion(force + sign * half_force, RADIUS, 1.0)
        / (work - sign * half_work)
        for sign in (-1, 1)
    )
    assert (low, high) == pytest.approx((1.557, 1.577), abs=5e-4)
    maugis = classical.maugis_parameter(0.81)
    assert classical.maugis_dugdale_coefficient(maugis) == pytest.approx(1.610, abs=1e-3)
    assert classical.transition_coefficient(maugis) == pytest.approx(1.607, abs=1e-3)


@pytest.mark.parametrize(
    "law", [classical.transition_coefficient, classical.maugis_dugdale_coefficient]
)
def test_self_consistent_work_gives_the_force_back(law):
    works = np.array([1e-6, 8e-5, 7e-3, 0.0463, 2.0, 1e3])
    tabor = classical.tabor_parameter(works, RADIUS, MODULUS, SPACING)
    forces = law(classical.maugis_parameter(tabor)) * np.pi * RADIUS * 1e-9 * works
    found = classical.self_consistent_work_of_adhesion(forces, *CONTACT, law)
    np.testing.assert_allclose(found, works, rtol=1e-6)
    assert np.isnan(classical.self_consistent_work_of_adhesion(np.nan, *CONTACT))


def test_what_is_not_positive_is_refused():
    assert_says(refusal(classical.maugis_dugdale_coefficient, [1.0, 0.0]), "Maugis", "found 0")
    message = refusal(classical.self_consistent_work_of_adhesion, 0.0, *CONTACT)
    assert_says(message, "pull-off force", "positive")


# Rough spheres


def test_without_roughness_every_model_has_the_force_of_its_smooth_sphere():
    flat = Roughness(*(np.array([tiny]) for tiny in (1e-7, 1e-2, 1e-9)))
    for name, model in MODELS.items():
        smooth = classical.jkr_pull_off if name == "fuller_tabor" else classical.dmt_pull_off
        expected = smooth(WORK, RADIUS)
        assert model.force(WORK, flat, CONTACT) == pytest.approx(expected, rel=2e-3), name


def test_rumpf_limits():
    smooth = classical.dmt_pull_off(WORK, RADIUS)
    force = classical.rumpf(WORK, RADIUS, np.array([1e-9, 1e-3, 1e15]), SPACING)
    assert force[0] == pytest.approx(smooth) == pytest.approx(force[2])
    asperity = classical.rumpf(WORK, RADIUS, 1e3, SPACING)  # large: the plane is out of reach
    assert asperity == pytest.approx(classical.dmt_pull_off(WORK, 1e3 * RADIUS / 251e3), rel=1e-3)


def test_rabinovich_limits():
    smooth = classical.dmt_pull_off(WORK, RADIUS)
    assert classical.rabinovich(WORK, RADIUS, 0.0, 500.0, SPACING) == pytest.approx(2 * smooth)
    caps = 500.0**2 / (32 * classical.PEAK_OVER_RMS * 50.0)  # their radius
    force = classical.rabinovich(WORK, RADIUS, 50.0, 500.0, SPACING)
    assert force == pytest.approx(classical.rumpf(WORK, RADIUS, caps, 1e-6), rel=0.15)
    far = classical.rabinovich(WORK, RADIUS, 50.0, 1e12, SPACING)
    assert far == pytest.approx(smooth, rel=1e-4)


def test_geometry_of_close_packed_asperities():
    """Rms of hexagonally packed hemispheres and paraboloids, heights from their base."""
    cell = 2 * np.sqrt(3)  # of asperities of base radius 1
    hemisphere = quad(lambda r: 2 * np.pi * r * (1 - r**2), 0, 1)[0] / cell
    assert hemisphere**-0.5 == pytest.approx(rough_adhesion.HEMISPHERE_OVER_RMS)
    assert hemisphere**-0.5 == pytest.approx(1.485, abs=5e-4)
    paraboloid = quad(lambda r: 2 * np.pi * r * (1 - r**2) ** 2, 0, 1)[0] / cell
    assert paraboloid**-0.5 == pytest.approx(classical.PEAK_OVER_RMS, rel=2e-3)


def relative(model, index):
    """Relative pull-off force of Gaussian asperities with a given elastic adhesion index."""
    height = index ** (2 / 3) * (WORK * np.sqrt(1e-9) / MODULUS) ** (2 / 3) / 1e-9
    assert classical.adhesion_index(WORK, height, 1.0, MODULUS) == pytest.approx(index)
    smooth = {"fuller_tabor": classical.jkr_pull_off, "maugis_rough_dmt": classical.dmt_pull_off}
    force = getattr(classical, model)(WORK, RADIUS, height, 1.0, MODULUS)
    return force / smooth[model](WORK, RADIUS)


@pytest.mark.parametrize("model", ["fuller_tabor", "maugis_rough_dmt"])
def test_adhesion_vanishes_with_the_elastic_adhesion_index(model):
    index = np.geomspace(1e-3, 1e6, 91)
    force = relative(model, index)
    assert (np.diff(force) <= 0).all() and (np.diff(force[index < 300]) < 0).all()
    assert force[0] == pytest.approx(1, abs=2e-3)
    assert 0.01 < relative(model, 10.0) < 0.05
    assert relative(model, 30.0) < 1e-4
    assert force[-1] == 0


@pytest.mark.parametrize("index", [0.02, 0.5, 3.0])
def test_dmt_asperities_by_brute_force(index):
    def tension(separation):
        def force(z):  # of one asperity, over 2πβW
            return (1 - 2 * index * (z - separation) ** 1.5 / (3 * np.pi)) * norm.pdf(z)

        return quad(force, separation, 12, limit=200)[0]

    greatest = max(tension(separation) for separation in np.linspace(-4.5, 4, 171))
    assert relative("maugis_rough_dmt", index) == pytest.approx(greatest, rel=2e-3)


@pytest.mark.parametrize("index", [0.02, 0.5, 3.0])
def test_jkr_asperities_by_brute_force(index):
    """In the variables of Greenwood: δ = a² - sqrt(2πa), P = 4a³/3 - sqrt(8πa³)."""
    radius = np.geomspace((np.pi / 8) ** (1 / 3), 30, 20001)  # from where it comes off
    compression = radius**2 - np.sqrt(2 * np.pi * radius)
    tension = (np.sqrt(8 * np.pi * radius**3) - 4 / 3 * radius**3) / (1.5 * np.pi)
    spread = index ** (2 / 3)

    def mean(separation):
        density = norm.pdf(separation + compression / spread) / spread
        return np.trapezoid(tension * density, compression)

    places = np.linspace(-6, 6 + 2 / spread, 401)
    greatest = max(mean(separation) for separation in places)
    assert relative("fuller_tabor", index) == pytest.approx(greatest, rel=2e-3)


def test_published_roughness_leaves_no_elastic_adhesion():
    index = classical.adhesion_index(WORK, AFM.height, 1 / AFM.curvature, MODULUS)
    assert index[0] == pytest.approx(1602, rel=1e-3) and (index > 1000).all()
    for name in ("fuller_tabor", "maugis"):
        assert (MODELS[name].force(WORK, AFM, CONTACT) < 1e-15).all()


# Against forces


@pytest.mark.parametrize("name", MODELS)
def test_fit_finds_the_work_that_made_the_forces(name):
    gentle = Roughness(np.array([0.05, 0.1]), np.array([0.1, 0.2]), np.array([0.01, 0.02]))
    target = MODELS[name].force(0.08, gentle, CONTACT)
    both = Roughness(*(np.stack([values, 1.5 * values]) for values in gentle))
    work, error = rough_adhesion.fit_work(MODELS[name], both, CONTACT, target)
    assert work[0] == pytest.approx(0.08, rel=1e-4) and error[0] < 1e-3
    assert error[1] > error[0]


def test_fit_of_forces_that_vanish_has_no_work():
    rough = Roughness(AFM.height, AFM.slope, 1e3 * AFM.curvature)
    work, error = rough_adhesion.fit_work(MODELS["maugis"], rough, CONTACT, PUBLISHED)
    assert np.isnan(work) and error == pytest.approx(1)


def test_no_model_fits_the_published_forces():
    for model in MODELS.values():
        assert rough_adhesion.fit_work(model, AFM, CONTACT, PUBLISHED)[1] > 0.4


def test_drawn_roughness_is_positive_and_spreads_as_printed():
    samples = rough_adhesion.drawn(np.random.default_rng(0), AFM, UNCERTAINTY, 4000)
    assert all((values > 0).all() and values.shape == (4000, 4) for values in samples)
    np.testing.assert_allclose(samples.height[:, 2].std(), 11.2, rtol=0.05)
    assert abs(np.corrcoef(samples.height[:, 2], samples.slope[:, 2])[0, 1]) < 0.05


def test_comparison_holds_all_models_with_intervals():
    samples = rough_adhesion.drawn(np.random.default_rng(0), AFM, UNCERTAINTY, 40)
    targets = {"published": PUBLISHED, "computed": 0.5 * PUBLISHED}
    found = rough_adhesion.compare(AFM, samples, CONTACT, WORK, targets, 0.95)
    assert list(found.model.values) == list(MODELS)
    assert found.pull_off_force.dims == ("model", "surface")
    assert (found.pull_off_force_low <= found.pull_off_force_high).all()
    one, half = (found.sel(model="rabinovich", against=name) for name in targets)
    assert half.fitted_work_of_adhesion == pytest.approx(one.fitted_work_of_adhesion / 2)
    assert half.mean_relative_error == pytest.approx(one.mean_relative_error)
    expected = np.abs(one.pull_off_force / PUBLISHED - 1).mean()
    assert one.error_at_published_work == pytest.approx(expected)


def test_power_laws_find_a_power_and_see_through_a_fit_of_one_point():
    works = {"published": 3 * AFM.height**-1.2}
    samples = Roughness(*(values[None] for values in AFM))
    found = rough_adhesion.power_laws(AFM, samples, works, 0.95).sel(against="published")
    height = found.sel(rms_parameter="height")
    assert height.power_law_exponent == pytest.approx(-1.2)
    assert height.rank_correlation == pytest.approx(-1)
    assert height.power_law_error == pytest.approx(0, abs=1e-12)
    assert height.prediction_error == pytest.approx(0, abs=1e-12)
    slope = found.sel(rms_parameter="slope")  # three alike, one far off
    assert slope.prediction_error > 3 * slope.power_law_error


def test_effective_works_of_the_published_forces():
    forces = {"": PUBLISHED, "_low": 0.9 * PUBLISHED, "_high": 1.1 * PUBLISHED}
    found = rough_adhesion.effective_works(forces, CONTACT, 0.81, WORK).isel(surface=0)
    work = found.effective_work_of_adhesion
    assert work.sel(tabor="printed") == pytest.approx(6.97e-3, rel=1e-3)  # 7.15 is printed
    assert work.sel(tabor="self_consistent") == pytest.approx(6.01e-3, rel=1e-3)
    own = found.effective_tabor_parameter.sel(tabor="self_consistent").item()
    again = classical.tabor_parameter(work.sel(tabor="self_consistent").item(), *CONTACT)
    assert own == pytest.approx(again)
    assert (found.effective_work_of_adhesion_low < work).all()


# The figure

SURFACES = ["polished_uncd", "uncd", "ncd", "mcd"]
LABELS = ["polished UNCD", "UNCD", "NCD", "MCD"]


@pytest.fixture
def dataset():
    """A dataset as the study's, a few draws for each interval."""
    rng = np.random.default_rng(3)
    samples = rough_adhesion.drawn(rng, AFM, UNCERTAINTY, 20)
    targets = {"published": PUBLISHED, "computed": 1.1 * PUBLISHED}
    forces = [{"": f, "_low": 0.8 * f, "_high": 1.2 * f} for f in targets.values()]
    against = xr.IndexVariable("against", list(targets))
    works = xr.concat(
        [rough_adhesion.effective_works(force, CONTACT, 0.81, WORK) for force in forces], against
    )
    of_models = rough_adhesion.compare(AFM, samples, CONTACT, WORK, targets, 0.95).merge(
        rough_adhesion.power_laws(AFM, samples, targets, 0.95)
    )
    metrics = xr.IndexVariable("metrics", ["afm", "all_scales"])
    found = xr.concat([of_models, of_models], metrics).merge(works).assign_coords(surface=SURFACES)
    for end, factor in (("", 1.0), ("_low", 0.9), ("_high", 1.1)):
        for name, values, unit in (
            ("published_mean_force", PUBLISHED, "N"),
            ("computed_mean_force", 1.1 * PUBLISHED, "N"),
            ("published_effective_work_of_adhesion", 812 * PUBLISHED, "J m-2"),
            ("implied_pull_off_coefficient", np.full(4, 1.57), "1"),
        ):
            found[f"{name}{end}"] = "surface", factor * values, {"units": unit}
    axis = np.geomspace(0.01, 10, 11)
    axis = xr.DataArray(axis, {"tabor_axis": axis}, attrs={"units": "1"})
    return found.assign(
        transition_coefficient=rough_adhesion.transition(axis),
        tabor_parameter=((), 0.62, {"units": "1"}),
        printed_tabor_parameter=((), 0.81, {"units": "1"}),
        model_label=("model", [model.label for model in MODELS.values()]),
        model_roughness=("model", [model.roughness for model in MODELS.values()]),
        model_verified=("model", [model.verified for model in MODELS.values()]),
        label=("surface", LABELS),
        basis=("surface", ["substitute"] * 4),
    ).assign_attrs(published_work=WORK, error_threshold=0.1)


def test_table_of_the_figure_holds_the_numbers_of_the_dataset(dataset):
    rows = fig_classical.table(dataset)
    assert set(rows["origin"]) == {"computed", "published"}
    assert rows["unit"].notna().all() and not rows.duplicated().any()
    chosen = rows.query("quantity == 'pull_off_force' and metrics == 'afm' and surface == 'mcd'")
    expected = dataset.pull_off_force.sel(metrics="afm", surface="mcd")
    assert list(chosen["model"]) == list(MODELS)
    assert list(chosen["value"]) == expected.values.tolist()
    assert set(chosen["label"]) == {"MCD"} and set(chosen["unit"]) == {"N"}
    assert chosen["model_verified"].str.contains("unverified").all()
    curve = rows.query("quantity == 'transition_coefficient' and transition == 'fit'")
    assert list(curve["x"]) == dataset.tabor_axis.values.tolist()
    assert rows.query("quantity == 'printed_tabor_parameter'")["value"].item() == 0.81


def test_figure_names_substitutes_and_reads_at_print_size(dataset):
    before = dataset.copy(deep=True)
    figure = fig_classical.draw(dataset)
    assert before.identical(dataset)
    assert "polished UNCD, UNCD, NCD, MCD" in figure.texts[-1].get_text()
    texts = figure.findobj(style.mpl.text.Text)
    assert min(text.get_fontsize() for text in texts) >= 7 * 0.99
    assert fig_classical.__all__ == ["draw", "table"]


def test_figure_draws_surfaces_without_published_forces(dataset, tmp_path):
    other = dataset.isel(surface=[1, 2]).assign_coords(surface=["glass", "steel"])
    other = other.where(other.surface == "glass").assign(
        {name: other[name] for name in dataset if "surface" not in dataset[name].dims}
    )
    other = other.assign(label=("surface", ["glass", "steel"]), basis=("surface", ["measured"] * 2))
    figure = fig_classical.draw(other)
    assert figure.texts[-1].get_text() == "all surfaces measured"
    save_figure(fig_classical, [other], tmp_path)


def test_saving_the_figure_twice_gives_the_same_bytes(dataset, tmp_path):
    first, second = (save_figure(fig_classical, [dataset], tmp_path / x) for x in "ab")
    assert first == second
