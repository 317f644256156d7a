"""Derived quantities of claims: compared with integrals, powers, distributions and curves."""

import numpy as np
import pytest
import xarray as xr
from intervals import between_multiples
from paper_numbers import PARAMETERS
from scipy import constants, stats
from scipy.integrate import quad

from hardcontact.base.statistics import interval_ends
from hardcontact.paper.claims import band_quantities, contact_quantities, force_quantities

RADIUS = 250e3  # nm
#: The dataset `paper` of claims.
PAPER = xr.Dataset(PARAMETERS.to_dict())
MODELS = {"contact_model": ["rigid", "plastic"]}


def assert_value(estimate, value, **tolerance):
    """Assert that the value of an estimate is this one."""
    np.testing.assert_allclose(np.asarray(estimate["value"]), value, **tolerance)


def make_adhesion(forces, ranges=(0.05, 2.0, 5.6, 8.0)):
    """Return adhesion.nc of one surface, from forces (contact_model, rho, scan, contact)."""
    dims = ("contact_model", "rho", "scan", "sphere_scan", "contact_y", "contact_x")
    return xr.Dataset(
        {"pull_off_force": (dims, np.asarray(forces, float)[:, :, :, None, None])},
        MODELS | {"rho": list(ranges)},
        {"rho": 5.6, "work_of_adhesion": 1.0, "pixel_size": 10.0,
         "sphere_radius": RADIUS, "confidence": 0.95},
    )  # fmt: skip


def power_law_forces(slope, scans=(0.9, 1.1)):
    """Return forces that are a power of the range, half as large in rigid contact."""
    ranges = np.array([0.05, 2.0, 5.6, 8.0])
    return np.multiply.outer(np.outer([0.5, 1.0], ranges**slope), np.outer(scans, [1.0, 1.0]))


def test_apex_level_is_a_ratio_of_each_scan():
    """If apex and roughness scatter together, their ratio does not scatter."""
    rms = np.array([16.0, 17.0, 19.0])
    adhesion = xr.Dataset({"apex_height": (("scan", "contact"), 3.4 * rms[:, None])})
    topography = xr.Dataset({"rms_height": ("scan", rms)})
    height = contact_quantities.apex_level(adhesion.assign_attrs(confidence=0.95), topography)
    assert_value(height, 3.4)
    np.testing.assert_allclose(*interval_ends(height, "value"))


def test_surfaces_that_are_rough_for_their_stiffness_do_not_stick():
    """Contacts bear the pressure h' E*/2; strips around them attract with W/r, r the range.

    A contact with the area A and the perimeter P has the diameter d = pi A/P. The strip around it
    is d (3/16 · 4 r/(h' d))^(2/3) wide.
    """
    modulus, work, reach, slope = 289.7e9, 0.0463, 0.3, np.array([0.31, 1.17])
    curvature = np.array([1.99, 6.32])  # 1/nm
    diameter = 4 * slope / curvature
    width = diameter * (3 / 16 * 4 * reach / (slope * diameter)) ** (2 / 3)
    area, perimeter = np.pi * diameter**2 / 4, np.pi * np.pi * diameter / 4
    repulsion = area * slope * modulus / 2
    attraction = perimeter * width * work / (reach * 1e-9)
    topography = xr.Dataset({"all_scales_rms_gradient": ("surface", slope)})
    topography["all_scales_rms_half_laplacian"] = ("surface", curvature)
    ratio = contact_quantities.nonstickiness(topography, PAPER)
    assert_value(ratio, repulsion / attraction, rtol=1e-3)


def test_elastic_contact_is_compared_with_rigid_and_plastic_contact():
    rigid = np.array([[1.0, 2.0], [2.0, 4.0]])
    dims = ("scan", "contact")
    elastic = xr.Dataset(
        {
            "rigid_pull_off_force": (dims, rigid),
            "elastic_pull_off_force": (dims, 0.99 * rigid),
            "share_above_hardness": (dims, [[0.2, 0.4], [0.5, 0.7]]),
            "elastic_contact_area": (dims, [[100.0, 100.0], [400.0, 400.0]]),
        },
        attrs={"hardness": 25e9, "preload": 10e-6, "confidence": 0.95},
    )
    assert_value(contact_quantities.elastic_change(elastic), 0.01)
    # The median of three surfaces is the second one.
    scale = xr.DataArray([0.1, 1.0, 1.3], dims="surface")
    areas, shares = elastic["elastic_contact_area"] * scale, elastic["share_above_hardness"] * scale
    three = elastic.assign(elastic_contact_area=areas, share_above_hardness=shares)
    assert_value(contact_quantities.median_share_above_hardness(three), 0.45)
    # 400 nm² carry the preload.
    assert_value(contact_quantities.median_plastic_over_elastic_area(three), (4 + 1) / 2)


def test_waves_of_a_sphere_s_slope_have_its_mean_pressure():
    """The mean of (r/R)² over a disc of radius a is a²/2R²; Hertz: the pressure 4 E* a/(3 pi R)."""
    modulus, contact_over_sphere = 289.7e9, 0.1  # E* in Pa, a/R
    topography = xr.Dataset(
        {"all_scales_rms_gradient": ("surface", [contact_over_sphere / np.sqrt(2), 9.0])},
        {"surface": ["mcd", "ruby"]},
    )
    attributes = {"effective_modulus": modulus, "hardness": 25e9}
    elastic = xr.Dataset(coords={"surface": ["mcd"]}, attrs=attributes)
    pressure = 4 * modulus * contact_over_sphere / (3 * np.pi)
    pressure_ratio = contact_quantities.elastic_pressure_over_hardness(topography, elastic)
    assert_value(pressure_ratio, pressure / 25e9)


def test_one_wave_has_the_deformation_energy_in_closed_form():
    """A wave of the amplitude h has E* q h²/8; many waves of this length have the same sum."""
    q, rms_height, modulus, work = 0.02, 3.0, 289.7e9, 0.0463
    wavevector = np.linspace(0.0199, 0.0201, 201)
    width = wavevector[1] - wavevector[0]
    spectrum = np.zeros((2, 1, 201))
    spectrum[0, 0, 100] = 2 * np.pi * rms_height**2 / (q * width)  # h_rms² = 1/2π ∫ q C dq
    topography = xr.Dataset(
        {"isotropic_psd": (("surface", "scan", "wavevector"), spectrum)},
        {"surface": ["mcd", "unknown"], "wavevector": wavevector},
    )
    elastic = xr.Dataset(
        coords={"surface": ["mcd", "unknown"]},
        attrs={"effective_modulus": modulus, "work_of_adhesion": work, "confidence": 0.95},
    )
    amplitude = np.sqrt(2) * rms_height
    energy = modulus * q * 1e9 * (amplitude * 1e-9) ** 2 / 8
    ratio = contact_quantities.deformation_over_adhesion(topography, elastic)
    assert_value(ratio, [energy / work, np.nan])


def test_a_power_law_of_the_range_gives_the_slopes_of_force_and_area():
    """The attracting area grows by one power more than the force."""
    adhesion = make_adhesion(power_law_forces(0.6))
    assert_value(force_quantities.range_exponent_of_force(adhesion), [0.6, 0.6])
    assert_value(force_quantities.range_exponent_of_area(adhesion), [1.6, 1.6])


def test_ratios_of_forces_are_taken_on_each_scan():
    forces = power_law_forces(0.5, scans=[1.0, 1.0])
    forces[1, :, 1] *= 3
    assert_value(force_quantities.plastic_over_rigid(make_adhesion(forces)), (2 + 6) / 2)
    forces[1, 0] = forces[1, 1] * np.array([2.0, 4.0])[:, None]
    ratio = force_quantities.shortest_range_force_over_minimum(make_adhesion(forces))
    assert_value(ratio, [1.0, 3.0])


def test_the_force_on_a_smooth_sphere_changes_where_pixels_are_coarse():
    """If pixels are as wide as the disk of interaction, the sum over them is not an integral."""
    adhesion = make_adhesion(power_law_forces(0.5))
    assert force_quantities.smooth_sphere_change(adhesion)["value"] < 1e-9
    coarse = adhesion.assign_attrs(pixel_size=np.sqrt(RADIUS * 0.05) * 4)
    assert force_quantities.smooth_sphere_change(coarse)["value"] > 0.1


DISTRIBUTIONS = {
    force_quantities.lognormal_misfit: stats.lognorm(0.9, scale=2e-7),
    force_quantities.half_gaussian_misfit: stats.halfnorm(scale=2e-7),
    force_quantities.inverse_gaussian_misfit: stats.invgauss(3.0, scale=2e-7),
}
#: Forces (contact_model, rho, scan, contact) in N: one half is a thousand times the other.
TWO_FORCES = np.tile([1e-8, 1e-5], (2, 1, 1, 500))


@pytest.mark.parametrize("misfit", DISTRIBUTIONS)
def test_misfit_is_small_only_for_the_right_distribution(misfit):
    assert (misfit(make_adhesion(TWO_FORCES, [5.6]))["value"] > 0.05).all()
    forces = DISTRIBUTIONS[misfit].rvs(1000, random_state=4)
    distribution = DISTRIBUTIONS[misfit].dist
    parameters = distribution.fit(forces, floc=0)
    distance = stats.kstest(forces, distribution.name, parameters).statistic
    assert distance < 0.05
    adhesion = make_adhesion(np.broadcast_to(forces, (2, 1, 1, 1000)), [5.6])
    # The library's standard deviation of ln F has n - 1, that of `fit` has n.
    assert_value(misfit(adhesion), distance, rtol=3e-3)


def test_decades_of_forces_are_those_between_the_smallest_and_the_largest():
    decades = force_quantities.force_decades(make_adhesion(TWO_FORCES, [5.6]))
    assert_value(decades, [3.0, 3.0])


@pytest.mark.parametrize("rho", [PARAMETERS[f"sinusoid_range_{end}"] for end in ("short", "long")])
def test_sinusoid_share_is_an_integral(rho):
    def attraction(x):
        return np.exp(-PARAMETERS["sinusoid_amplitude"] * (1 - np.cos(x)) / rho)

    share = quad(attraction, 0, np.pi / 2)[0] / quad(attraction, 0, np.pi)[0]
    assert_value(band_quantities.sinusoid_share(PAPER).sel(rho=rho), share)


def test_strength_is_the_largest_ratio_of_pressures_at_any_gap():
    rho = 5.6e-9
    gaps = np.geomspace(1e-10, 1e-6, 4001)
    casimir = np.pi**2 * constants.hbar * constants.c / (240 * gaps**4)
    ratios = 0.0463 / rho * np.exp(-gaps / rho) / casimir
    assert_value(force_quantities.strength_over_casimir(PAPER), ratios.max(), rtol=1e-5)


def test_interaction_radius_and_its_share_of_the_force():
    fitted = xr.Dataset({"range_of_adhesion": 5.6}, attrs={"sphere_radius": RADIUS})
    radius = np.sqrt(2 * RADIUS * 5.6)
    assert_value(band_quantities.interaction_radius(PAPER), radius)
    assert_value(band_quantities.interaction_radius_at_fit(fitted), radius)

    def ring(r):
        return r * np.exp(-(r**2) / (2 * RADIUS * 5.6))

    share = quad(ring, 0, radius)[0] / quad(ring, 0, 20 * radius)[0]
    assert_value(band_quantities.interaction_share(PAPER), share)


def test_force_at_short_range_is_linear_between_ranges():
    forces = xr.Dataset({"mean_force": ("rho", [1.0, 5.0])}, {"rho": [0.1, 1.1]})
    shift = PARAMETERS["atomic_range_upper_bound"] - 0.1
    assert_value(force_quantities.short_range_force(forces, PAPER), 0.0463 * (1 + 4 * shift))
    longer_ranges = forces.assign_coords(rho=[2.0, 3.0])
    assert np.isnan(force_quantities.short_range_force(longer_ranges, PAPER)["value"])


def test_errors_are_read_at_short_ranges_and_at_the_second_minimum():
    errors = xr.Dataset(
        {
            "best_error": 0.05,
            "error_at_minimum": ("minimum", [0.05, 0.3]),
            "best_error_by_range": ("rho_fine", [0.5, 0.2, 0.05]),
        },
        {"minimum": [1, 2], "rho_fine": [0.3, 0.6, 5.6]},
    )
    assert_value(force_quantities.short_range_error(errors, PAPER), 0.2)
    assert_value(force_quantities.error_of_second_minimum(errors, PAPER), 0.3)
    single = errors.assign(error_at_minimum=("minimum", [0.05, np.nan]))
    assert force_quantities.error_of_second_minimum(single, PAPER)["value"] == np.inf
    nothing_fits = errors.assign(best_error=0.15)
    assert np.isnan(force_quantities.error_of_second_minimum(nothing_fits, PAPER)["value"])


@pytest.fixture
def band():
    """Return changes of the force, with edges at 46 and 1750 nm."""
    cutoffs = [10.0, 43.0, 200.0, 1000.0, 1800.0, 5000.0]
    change = [[0.0, 0.05, 1.0, 3.0, np.nan, np.nan], [np.nan, np.nan, 0.6, 0.3, 0.05, 0.0]]
    return xr.Dataset(
        {
            "filtered_force_change": (("side", "cutoff_wavelength"), change),
            "edge_bound": ("side", [1000.0, 200.0]),
        }
        | between_multiples("edge", "side", [46.0, 1750.0], (0.9, 1.1)),
        {"side": ["short", "long"], "cutoff_wavelength": cutoffs},
        {"sphere_radius": RADIUS},
    )


def test_changes_are_read_outside_and_inside_the_published_band(band):
    assert_value(band_quantities.change_outside_band(band, PAPER), [0.05, 0.05])
    # At 86 and 900 nm, between the cutoffs of 43 and 200 nm, and of 200 and 1000 nm.
    octaves = [0.05 + 0.95 * 43 / 157, 0.6 - 0.3 * 700 / 800]
    assert_value(band_quantities.change_inside_band(band, PAPER), octaves)
    assert_value(band_quantities.short_cutoff_change(band, PAPER), 0.0)
    assert_value(band_quantities.stylus_change(band, PAPER), 3.0)


def test_an_open_edge_is_its_bound(band):
    assert_value(band_quantities.band_edge(band), [46.0, 1750.0])
    ratio = band_quantities.edge_over_interaction_radius(band, PAPER)
    assert_value(ratio.sel(side="long"), 1750 / np.sqrt(2 * RADIUS * 5.6))
    band["edge"][:] = np.nan
    assert_value(band_quantities.band_edge(band), [1000.0, 200.0])


def test_the_outermost_edge_is_that_of_the_surface_whose_force_changes_first():
    cutoffs = [20.0, 100.0, 1000.0, 5000.0]
    curve = np.array([[1, 1, np.nan, np.nan], [np.nan, np.nan, 1, 1]])
    edges = [[60.0, 40.0, 30.0], [1500.0, np.nan, 9000.0]]
    dims = ("side", "group", "cutoff_wavelength")
    band = xr.Dataset(
        {
            "filtered_force_change": (dims, np.stack([curve] * 3, axis=1)),
            "edge_bound": (dims[:2], np.where(np.isnan(edges), 20.0, np.nan)),
        }
        | between_multiples("edge", ("side", "group"), edges, (0.9, 1.1)),
        {
            "side": ["short", "long"], "group": ["uncd", "mcd", "averaged"],
            "cutoff_wavelength": cutoffs,
        },
    )  # fmt: skip
    outermost_edge = band_quantities.outermost_edge(band)
    assert_value(outermost_edge, [40.0, 1500.0])
    np.testing.assert_allclose(outermost_edge["value_interval"].sel(side="short"), [36, 44])


def test_the_last_short_cutoff_is_compared_with_the_force_on_a_plane():
    force_of_plane = 2 * np.pi * RADIUS * 1e-9
    forces = np.array([[[0.1, 1.0, np.nan]], [[np.nan, 0.1, 0.2]]])[..., None] * force_of_plane
    filtered_forces = xr.Dataset(
        {"pull_off_force": (("side", "realization", "cutoff_wavelength", "contact_y"), forces)},
        {"side": ["short", "long"], "cutoff_wavelength": [10.0, 1000.0, 5000.0]},
        {"sphere_radius": RADIUS, "confidence": 0.95},
    )
    assert_value(band_quantities.dmt_fraction_at_last_cutoff(filtered_forces), 1)


def test_decades_of_works_are_those_between_the_smallest_and_the_largest():
    works = [1.0, 1000.0, 10.0]
    variables = between_multiples("effective_work_of_adhesion", "surface", works, (0.1, 10))
    decades = force_quantities.effective_work_decades(xr.Dataset(variables))
    assert_value(decades, 3)
    np.testing.assert_allclose(decades["value_interval"], [1, 5])
