"""Forces on scans and extrapolated forces: means, intervals, bounds, and contacts needed."""

import numpy as np
import pytest
import xarray as xr
from intervals import between_multiples
from known_forces import FORCE_DIMS
from known_masters import LONG, SHORT, filtered_forces
from scipy import stats

from hardcontact.base.arrays import generator
from hardcontact.base.statistics import student_interval
from hardcontact.contact.contact import Contact
from hardcontact.contact.numerical_limits import FINITE_SCAN_RATIOS
from hardcontact.inference.mean_forces import MasterScans
from hardcontact.own import force_dataset

RHOS = [1.0, 5.0, 20.0]
CONTACT = Contact(radius=5e3, preload=10e-6, hardness=25e9, work=0.05, rho=5.0)
SCAN_SIZES = {"a": 2500.0, "b": 2500.0}


def forces_of(computed_forces):
    return force_dataset._forces_on_scans(computed_forces, CONTACT, SCAN_SIZES, 0.9)


def adhesion(scan_counts, radius=5e3, spread=0.3):
    """Log-normal forces: 2 rho N at 1 J/m² in the median, ten times as much in plastic contact."""
    rng = np.random.default_rng(1)
    shape = (2, max(scan_counts), 2, 2, 1, 4, 4)  # FORCE_DIMS
    forces = np.exp(spread * rng.standard_normal(shape)) * 2 * np.array(RHOS)[:, None, None]
    forces[:, :, :, 1] *= 10
    for surface, count in enumerate(scan_counts):
        forces[surface, count:] = np.nan
    return xr.Dataset(
        {
            "pull_off_force": (FORCE_DIMS, forces),
            "touched_patches": (FORCE_DIMS[:3], forces[:, :, :, 0, 0, 0, 0] * 0 + 9),
            "label": ("surface", ["A", "B"]),
            "source": ("surface", ["measured", "measured"]),
        },
        {"surface": ["a", "b"], "contact_model": ["rigid", "plastic"], "rho": RHOS},
        {"sphere_radius": radius},
    )


def test_the_force_is_the_mean_over_contacts_times_the_work():
    computed_forces = adhesion([3, 1])
    scan_forces = forces_of(computed_forces)
    surface_b_forces = computed_forces.pull_off_force.sel(surface="b").isel(scan=0)
    mean_force = 0.05 * surface_b_forces.mean(["sphere_scan", "contact_y", "contact_x"])
    np.testing.assert_allclose(scan_forces.force.sel(surface="b"), mean_force)
    selection = {"surface": "a", "contact_model": "plastic", "rho": 5.0}
    single = 0.05 * computed_forces.pull_off_force.sel(selection).values
    quantiles = scan_forces.force_quantile.sel(selection)
    np.testing.assert_allclose(quantiles, np.quantile(single, quantiles["quantile"]))
    log_force_std = scan_forces.log_force_std.sel(selection)
    np.testing.assert_allclose(log_force_std, np.log(single).std())


def test_three_scans_give_the_interval_of_student_s_t_and_one_scan_that_of_its_quarters():
    computed_forces = adhesion([3, 1], spread=0.02).isel(sphere_scan=[0])
    scan_forces = forces_of(computed_forces)
    assert "position_factor" not in scan_forces
    selection = {"surface": "a", "contact_model": "rigid", "rho": 5.0}
    means = computed_forces.pull_off_force.sel(selection).mean(
        ["sphere_scan", "contact_y", "contact_x"]
    )
    np.testing.assert_allclose(
        scan_forces.force_interval.sel(selection),
        0.05 * student_interval(means, 0.9, "scan"),
        rtol=1e-4,
    )
    assert scan_forces.interval_source.values.tolist() == ["scans", "quarters"]
    low, high = (scan_forces.force_interval.isel(end=index) for index in (0, 1))
    assert (low < scan_forces.force).all() and (scan_forces.force < high).all()
    width = np.log(high / low).sel(surface="b", contact_model="rigid")
    assert (width.diff("rho") > 0).all()  # The longer the range, the more alike are quarters.


def test_the_interval_includes_the_position_on_a_rough_sphere():
    smooth = adhesion([3, 3], spread=1e-6).isel(sphere_scan=[0])
    logarithms = xr.DataArray(np.random.default_rng(2).normal(size=16), dims="sphere_scan")
    forces = smooth.pull_off_force.squeeze("sphere_scan") * np.exp(logarithms)
    rough_sphere = smooth.drop_vars(["pull_off_force", "touched_patches"]).assign(
        pull_off_force=forces.transpose(*FORCE_DIMS),
        touched_patches=smooth.touched_patches.isel(sphere_scan=[0] * 16),
    )
    scan_forces = forces_of(rough_sphere)
    # Of 16 normal numbers, one more lies within this distance of the mean, with 90 % confidence.
    half_width = stats.t(15).ppf(0.95) * logarithms.std(ddof=1).item() * np.sqrt(1 + 1 / 16)
    np.testing.assert_allclose(scan_forces.position_factor, np.exp(half_width), rtol=1e-4)
    ends = scan_forces.force_interval / scan_forces.force
    np.testing.assert_allclose(ends.isel(end=0), np.exp(-half_width), rtol=1e-3)
    np.testing.assert_allclose(ends.isel(end=1), np.exp(half_width), rtol=1e-3)


def test_a_contact_as_wide_as_the_scan_gives_no_interval():
    scan_forces = forces_of(adhesion([3, 1], radius=1e9))
    assert scan_forces.force_interval.sel(surface="b").isnull().all()
    assert scan_forces.force_interval.sel(surface="a").notnull().all()


def test_contacts_that_touch_few_patches_give_no_interval():
    computed_forces = adhesion([3, 1])
    for patches, source in ((4.0, "quarters"), (3.0, "few_patches")):
        few_patches = computed_forces.assign(
            touched_patches=computed_forces.touched_patches * 0 + patches
        )
        scan_forces = forces_of(few_patches)
        assert scan_forces.interval_source.values.tolist() == ["scans", source]
        assert scan_forces.force_interval.sel(surface="b").notnull().all() == (patches == 4)
        assert scan_forces.force_interval.sel(surface="a").notnull().all()
        assert scan_forces.contacts.values.tolist() == [16, 16]
        interval = extrapolated_forces_of(patches).extrapolated_force_interval
        assert interval.notnull().all() == (patches == 4)


def test_forces_are_bounded_by_that_of_a_smooth_sphere():
    scan_forces = forces_of(adhesion([3, 1]))  # Newtons, far above the bound of some µN.
    extrapolated_forces = xr.Dataset(
        {"extrapolated_force": ("side", [1e-9, 1.0])}, {"side": ["short", "long"]}
    ).assign(extrapolated_force_interval=("side", [1e-9, 1.0]))
    bounded = force_dataset._bound_by_smooth_sphere(scan_forces.merge(extrapolated_forces), 400.0)
    rigid = 2 * np.pi * 5e-6 * 0.05  # 2 pi R W, to which an area in contact adds W A / rho
    bound = xr.DataArray(
        [[rigid] * 3, [rigid + 0.05 * 4e-16 / (1e-9 * rho) for rho in RHOS]],
        dims=("contact_model", "rho"),
    )
    np.testing.assert_allclose(bounded.smooth_bound, bound)
    np.testing.assert_allclose(bounded.force, bound.expand_dims(surface=2))
    assert (bounded.force_interval <= bounded.smooth_bound).all()
    np.testing.assert_allclose(bounded.extrapolated_force, [1e-9, bound[1, 1]])
    endless = scan_forces.assign(force_interval=scan_forces.force_interval * 0 + np.inf).merge(
        extrapolated_forces
    )
    assert np.isinf(force_dataset._bound_by_smooth_sphere(endless, 400.0).force_interval).all()


# With extrapolated roughness

MASTER_FORCES = filtered_forces([[SHORT, LONG]]).assign(transition=("side", [20.0, 4e3]))


def extrapolated_forces_of(patches=99):
    """Extrapolated forces from masters of one scan, whose contacts touch a number of patches."""
    master_scans = MasterScans(scan_counts={"a": 1}, tiles=2, touched_patches={"a": patches})
    return force_dataset._forces_on_masters(
        MASTER_FORCES, master_scans, CONTACT.work, confidence=0.95
    )


def test_the_extrapolated_force_is_the_mean_over_contacts_and_masters():
    axes = ["realization", "contact_y", "contact_x"]
    force = CONTACT.work * MASTER_FORCES.unfiltered_pull_off_force.mean(axes)
    np.testing.assert_allclose(extrapolated_forces_of().extrapolated_force, force)


@pytest.mark.parametrize(
    "ratio, half_width, differs", [(3.0, 0.4, 1), (3.0, 2.8, 0), (1.01, 0.001, 0), (3.0, np.nan, 1)]
)
def test_the_extrapolated_force_differs_beyond_its_interval_and_the_tolerance(
    ratio, half_width, differs
):
    extrapolated_forces = extrapolated_forces_of()
    # The force on the scans, relative to the force with extrapolated roughness below their pixels.
    extrapolated_force = extrapolated_forces.extrapolated_force.sel(side="short").item()
    multiples = (1 - half_width / ratio, 1 + half_width / ratio)
    axes = ("surface", "contact_model", "rho")
    scan_forces = xr.Dataset(
        between_multiples("force", axes, [[[ratio * extrapolated_force]]], multiples),
        {"surface": ["a"], "contact_model": ["plastic"], "rho": [5.0]},
        {"rho": 5.0},
    )
    comparison = force_dataset._add_extrapolated_forces(
        scan_forces, extrapolated_forces, 0.1
    ).extrapolation_matters
    assert comparison.sel(side="short").values.tolist() == [differs]


def test_a_mean_over_the_needed_contacts_keeps_the_tolerance():
    computed_forces = adhesion([3, 1], spread=0.8).pull_off_force
    selection = {"surface": "a", "contact_model": "plastic", "rho": 5.0}
    forces = computed_forces.sel(selection).values.ravel()
    needed = round(force_dataset._contacts_needed(computed_forces, 0.1, 0.9).sel(selection).item())
    means = generator(1, "contacts").choice(forces, (2000, needed)).mean(axis=1)
    is_within = np.abs(means / forces.mean() - 1) < 0.1
    assert needed > 50 and is_within.mean() == pytest.approx(0.9, abs=0.02)
    equal_forces = adhesion([3, 1], spread=0.001).pull_off_force
    assert (force_dataset._contacts_needed(equal_forces, 0.1, 0.9) == 1).all()


def test_the_needed_contacts_are_not_known_from_small_scans_or_few_patches():
    dataset = xr.Dataset({
        "finite_scan_ratio": (("surface", "end"), [[1.0, 1.0], [1.5, 3.6], [1.0, 1.0]]),
        "interval_source": ("surface", ["quarters", "scans", "few_patches"]),
    })  # fmt: skip
    assert force_dataset._shows_other_summits(dataset).values.tolist() == [True, False, False]


def test_intervals_include_the_effect_of_finer_pixels():
    scan_forces = forces_of(adhesion([3, 3]).isel(sphere_scan=[0]))
    tested = scan_forces.assign(wide_pixel_ratio=("surface", [1.5, 0.9]))
    lowered = force_dataset._allow_for_finer_pixels(tested)
    change = (lowered.force_interval / scan_forces.force_interval).transpose("surface", "end", ...)
    np.testing.assert_allclose(change.isel(surface=0, end=0), 1 / 1.5)
    np.testing.assert_allclose(change.isel(surface=0, end=1), 1)
    np.testing.assert_allclose(change.isel(surface=1), 1)


def test_the_share_of_a_window_matches_the_sum_over_its_pixels():
    rhos, window = np.array([2.0, 20.0, 200.0]), 5e3
    contact = Contact(radius=250e3, preload=10e-6, hardness=25e9, window=window)
    sizes = {"scan_size": ("surface", [1000.0]), "pixel_size": ("surface", [10.0])}
    sized_forces = force_dataset._add_sizes(
        xr.Dataset({"search_size": ("surface", [3000.0])}, {"rho": rhos, "surface": ["a"]}),
        xr.Dataset(sizes, {"surface": ["a"]}),
        contact,
    )
    np.testing.assert_array_equal(sized_forces.finite_scan_ratio, [dict(FINITE_SCAN_RATIOS)[0.5]])
    assert sized_forces.pixel_area.item() == 100.0
    assert sized_forces.attrs["contact_area"] == contact.area
    squared_positions = (np.arange(-40e3, 40e3, 20) + 10) ** 2
    is_inside = np.abs(squared_positions) < (window / 2) ** 2
    for rho, share in zip(rhos, sized_forces.window_share.values, strict=True):
        weight = np.exp(-squared_positions / (2 * contact.radius * rho))
        assert share == pytest.approx((weight[is_inside].sum() / weight.sum()) ** 2, rel=1e-3)
    assert sized_forces.window_share[0] > 0.99 > 0.2 > sized_forces.window_share[-1]
