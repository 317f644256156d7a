"""The choices for your scans: the scans of contacts, and keys that the study accepts."""

import math
from collections import Counter
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from measurements import uncd_density
from refusals import assert_says, refusal
from repository import PAPER

from hardcontact.commands.contact_scans import all_search_sizes, select_contact_scans
from hardcontact.commands.inventory import UserScan
from hardcontact.commands.proposal import propose_keys, values_by_key
from hardcontact.commands.request import ScanFile
from hardcontact.config.configuration import numeric_configuration, set_keys
from hardcontact.config.limits import refuse_unfit_values
from hardcontact.contact.contact import Contact
from hardcontact.scans.reliable_wavelengths import ReliableWavelengths
from hardcontact.surfaces.height_map import HeightMap
from hardcontact.surfaces.spectrum import BIN_CENTRES, BIN_WIDTH


def density(size, pixel, rms):
    """Return C_iso (bins,) in nm⁴ of an rms height, from two pixels to the size of a scan."""
    wavelength = 2 * np.pi / BIN_CENTRES
    values = uncd_density(BIN_CENTRES)
    values[(wavelength < 2 * pixel) | (wavelength > size)] = np.nan
    variance = np.nansum(values * BIN_CENTRES**2) * BIN_WIDTH / (2 * np.pi)
    return values * rms**2 / variance


def user_scan(size=2500.0, pixels=512, rms=17.0, surface="a", **others):
    """Return a scan of a surface, by default a height map; lengths in nm."""
    fields = {
        "dataset": "", "channel": "height", "file_unit": "nm", "kind": "map",
        "peak_to_valley": 6 * rms, "relief": 8 * rms, "tip_radius": None, "is_tip_given": False,
        "reliable_wavelengths": ReliableWavelengths(4 * size / pixels, size / 3, "pixels"),
        "density": density(size, size / pixels, rms), "undefined_count": 0, "notes": (),
        "defects": {},
        "coarse_map": HeightMap(np.zeros((2, 2)), size / 2),
    }  # fmt: skip
    return UserScan(
        scan_file=ScanFile(surface, surface, "scans/one.nc", "scans/one.nc"), pixels=pixels,
        pixel_size=size / pixels, rms_height=rms, **(fields | others),
    )  # fmt: skip


def user_contact(radius=250e3, preload=1e-5, hardness=25e9, rho=5.6):
    """Return a contact; the paper's unless other quantities are given."""
    return Contact(radius=radius, preload=preload, hardness=hardness, rho=rho)


# Scans that contacts are made on

BLIND = ReliableWavelengths(3000.0, 2000.0, "tip")
# Search sizes, of which scans need twice: 1.67, 3.19, 13.8 um at rms heights of 4, 17, 400 nm.
SIZES = [500, 1000, 5000, 5000, 10000, 20000]
BALL = [user_scan(size, rms=1.0, surface="sphere") for size in (2500, 2500, 6000)]


@pytest.mark.parametrize(
    ("scans", "radius", "size_counts"),
    [
        # The smallest scans that are wide enough, or the widest. A small sphere needs finer pixels.
        ([user_scan(size, rms=4.0) for size in SIZES], 250e3, {5000: 2}),
        ([user_scan(size, rms=17.0) for size in SIZES], 250e3, {10000: 1}),
        ([user_scan(size, rms=400.0) for size in SIZES], 250e3, {20000: 1}),
        ([user_scan(size, rms=17.0) for size in SIZES], 5e3, {1000: 1}),
        # sqrt(2 R rho) = 1673 nm is 8.6 pixels of 195 nm: too coarse, unless all others are too.
        ([user_scan(100e3), user_scan(5000)], 250e3, {5000: 1}),
        ([user_scan(100e3), user_scan(300e3)], 250e3, {100000: 1}),
        # Scans without a reliable wavelength come last, and line scans make no contacts.
        ([user_scan(6000, reliable_wavelengths=BLIND), user_scan(2500)], 250e3, {2500: 1}),
        ([user_scan(6000, reliable_wavelengths=BLIND)], 250e3, {6000: 1}),
        ([user_scan(1e5, 3000, kind="line scan"), user_scan()], 250e3, {2500: 1}),
        # Surfaces are compared on one grid where they have one in common.
        (
            [user_scan(size, rms=rms, surface=name) for name, rms in (("a", 4.0), ("b", 17.0))
             for size in (5000, 10000)], 250e3, {10000: 2},
        ),
        (
            [user_scan(5000, rms=4.0), user_scan(10000, rms=4.0, surface="b")], 250e3,
            {5000: 1, 10000: 1},
        ),
        # The sphere follows the substrates, but no scan of it is wider than its radius.
        ([user_scan(6000), *BALL], 250e3, {6000: 2}),
        ([user_scan(7000), *BALL], 250e3, {7000: 1, 2500: 2}),
        ([user_scan(6000), *BALL], 5e3, {6000: 1, 2500: 2}),
    ],
)  # fmt: skip
def test_contacts_are_made_on_scans_that_hold_and_resolve_the_summits(scans, radius, size_counts):
    sphere = "sphere" if scans[-1].scan_file.surface == "sphere" else None
    sizes = all_search_sizes(scans, sphere, user_contact(radius))
    selected_scans, _ = select_contact_scans(scans, sphere, user_contact(radius), sizes)
    assert Counter(round(scan.size) for scan in selected_scans) == size_counts


# Keys of the study


def both_efforts(contact, proposal):
    """Return the configurations of the study and of its quick effort."""
    named_keys = {
        "study": "own",
        "published": "none",
        "sphere.surface": "smooth",
        "sphere.radius": f"{contact.radius:.12g} nm",
        "contact.preload": f"{contact.preload:.12g} N",
        "contact.hardness": f"{contact.hardness:.12g} Pa",
    }
    full = named_keys | values_by_key(proposal.choices)
    quick = full | values_by_key(proposal.quick)
    return [numeric_configuration(set_keys(PAPER, keys)) for keys in (full, quick)]


def random_between(low, high):
    """Give positive numbers between two, of any order of magnitude."""
    return st.floats(math.log(low), math.log(high)).map(math.exp)


@st.composite
def random_scans(draw):
    """Give one to five scans of a surface on the same pixels."""
    size, pixels = draw(random_between(100, 1e5)), draw(st.integers(64, 2048))
    rms = draw(random_between(0.1, size / 10))
    shortest = draw(random_between(2, 2 * pixels)) * size / pixels
    waves = ReliableWavelengths(shortest, size / 3, "tip")
    return [user_scan(size, pixels, rms, reliable_wavelengths=waves)] * draw(st.integers(1, 5))


def check_refusal(line, scan, contact):
    """Check with independent bounds that the study could not accept a refused value."""
    area = 1e18 * contact.preload / contact.hardness
    if line.startswith("surface a: expected a height map"):
        assert scan.pixel_size < 0.05
    elif line.startswith("config key adhesion.range"):  # or adhesion.ranges
        # Two pixels in an interaction radius, a relief of 500 ranges, a depth of 25 ranges.
        two_pixel_range = 2 * scan.pixel_size**2 / contact.radius
        shortest_range = max(two_pixel_range, scan.relief / 500, math.sqrt(area) / 25)
        assert shortest_range > 39.9, line  # The longest proposed range is 40 nm, rounded.
    else:
        # At the border of a window the sphere is at least 14 ranges above its apex.
        window = min(2 * scan.size, 2 * math.sqrt(2 * contact.radius * 14 * contact.rho))
        # Memory holds 2**26, at least for 4 x 4 contacts in windows of 10 x 10 mirrored scans.
        max_pixels = 2**26 / 16 / 100
        assert line.startswith("config key contact.preload") and (
            area > 0.15 * window**2 or area > max_pixels * scan.pixel_size**2
        ), line  # The limit is a quarter of the window; 0.15 leaves a margin for its rounding.


@settings(max_examples=40, deadline=None, derandomize=True, suppress_health_check=list(HealthCheck))
@given(
    random_scans(),
    st.builds(
        user_contact,
        random_between(1e3, 5e6),
        random_between(1e-9, 1e-3),
        random_between(1e8, 1e12),
    ),
)
def test_any_scan_gives_a_valid_study_or_a_justified_refusal(scans, contact):
    try:
        proposal = propose_keys(scans, None, contact)
        extents = {scan.scan_file.surface: scan.extent for scan in proposal.contact_scans}
        for config in both_efforts(contact, proposal):
            refuse_unfit_values(config, extents)
    except ValueError as error:
        for line in str(error).splitlines():
            check_refusal(line, scans[0], contact)


def test_scans_like_the_paper_s_get_about_its_grids():
    config, _ = both_efforts(user_contact(), propose_keys([user_scan()] * 5, None, user_contact()))
    paper = numeric_configuration(PAPER)
    assert config["contact"]["window"] == pytest.approx(paper["contact"]["window"], rel=0.01)
    assert config["band"]["long"]["tiles"] == paper["band"]["long"]["tiles"]
    for side, largest_first_cutoff in (("short", 43 / 4), ("long", 100)):  # far below the edges
        keys, paper_keys = config["band"][side], paper["band"][side]
        assert keys["transition"] == pytest.approx(paper_keys["transition"], rel=0.05)
        assert keys["pixels"] == paper_keys["pixels"] / 2
        assert keys["cutoffs"][0] <= largest_first_cutoff
        assert keys["cutoffs"][-1] == paper_keys["cutoffs"][-1]


def test_the_caution_on_a_small_scan_says_that_the_page_has_another_search_size():
    (caution,) = [line for line in propose_keys([user_scan(500)], None, user_contact()).cautions
                  if "search size" in line]  # fmt: skip
    assert_says(caution, "from single scans (the page has that of the joined spectrum)")


@pytest.mark.parametrize("preload", [5e-6, 20e-6, 25e-6])
def test_ranges_of_adhesion_lie_apart_however_short_a_range_scans_permit(preload):
    """The shortest range is a 25th of the depth of the contact, sqrt(preload/hardness)."""
    contact = user_contact(radius=5e3, preload=preload, hardness=5e9, rho=3.0)
    for config in both_efforts(
        contact, propose_keys([user_scan()], None, contact, range_given=True)
    ):
        ranges = np.array(config["adhesion"]["ranges"])
        assert 3.0 in ranges and len(ranges) in (5, 12)  # at quick or full effort
        assert (ranges[1:] / ranges[:-1]).min() > 1.05  # a ratio of 1.1, rounded to two digits


@pytest.mark.parametrize(("shortest", "transition"), [(120.0, "120 nm"), (2000.0, "1000 nm")])
def test_roughness_is_artificial_below_the_reliable_wavelengths(shortest, transition):
    scan = user_scan(reliable_wavelengths=ReliableWavelengths(shortest, 833.0, "tip"))
    choices = propose_keys([scan], None, user_contact()).choices
    assert {choice.key: choice.value for choice in choices}["band.short.transition"] == transition


@pytest.mark.parametrize(
    ("scan", "contact", "message_parts"),
    [
        (user_scan(reliable_wavelengths=BLIND), user_contact(), ["no wavelength: the tip at 3 µm"]),
        # A relief of 5600 nm permits ranges from a 500th, 11.2 nm.
        (user_scan(20000, rms=700.0), user_contact(), ["11.2 nm, not the usual 5.6 nm"]),
        # erf(1000 nm / sqrt(2 R rho))^2 of the smooth sphere's force lie in a window of 2 um.
        (
            user_scan(100, rms=4.7), user_contact(),
            [f"{math.erf(1000 / math.sqrt(2 * 250e3 * 5.6)) ** 2:.0%} of the force",
             "8 to 17 times too high on scans of 12% of this size, the smallest tested"],
        ),
        # 20 nm² are less than a pixel of 19.5 nm.
        (
            user_scan(10000), user_contact(radius=5e3, preload=100e-9, hardness=5e9, rho=2.0),
            ["less than a pixel"],
        ),
        (
            user_scan(10000, rms=14, undefined_count=512**2 * 3 // 10), user_contact(),
            ["30% of its pixels"],
        ),
        (
            user_scan(defects={"highest": {"highest_share": 0.1}}), user_contact(),
            ["one.nc: 10 % of"],
        ),
    ],
)  # fmt: skip
def test_scans_that_spoil_the_forces_have_a_caution_with_numbers(scan, contact, message_parts):
    assert_says(" ".join(propose_keys([scan], None, contact).cautions), *message_parts)


def test_few_undefined_pixels_need_no_caution():
    scan = user_scan(10000, rms=14, undefined_count=99)
    assert not propose_keys([scan], None, user_contact()).cautions


@pytest.mark.parametrize(("radius", "stated"), [(50e3, 250e3), (50e3, 60e3), (50e3, 40e3)])
def test_a_stated_radius_that_the_scan_of_the_sphere_contradicts_is_questioned(radius, stated):
    """A scan keeps the difference of the curvatures of its sphere and of the stated one."""
    curvature_difference = abs(1 / radius - 1 / stated)
    ball = user_scan(
        defects={"curvature": {"curvature_radius": 1 / curvature_difference, "uncurved_share": 0.1}}
    )
    ball = replace(ball, scan_file=ScanFile("sphere", "sphere", "ball.nc", "ball.nc", stated))
    (caution,) = [
        line
        for line in propose_keys([user_scan(), ball], "sphere", user_contact(stated)).cautions
        if "contradicts" in line
    ]
    assert_says(caution, f"--radius {stated / 1e3:g} µm", f"{radius / 1e3:g} µm")


@pytest.mark.parametrize(
    ("scans", "contact", "message_parts"),
    [
        (
            [user_scan(1e5, 3000, kind="line scan")],
            user_contact(),
            ["surface a: expected a height map"],
        ),
        ([user_scan(0.5)], user_contact(), ["0.05 to 10000 nm"]),  # pixels of 1 pm
        (
            [user_scan(100), user_scan(1e5, surface="b")],
            user_contact(),
            ["100 nm on a and pixels of 195 nm on b"],
        ),
    ],
)
def test_unsuitable_scans_are_refused_in_one_line_each(scans, contact, message_parts):
    message = refusal(propose_keys, scans, None, contact)
    assert_says(message, *message_parts)
    assert len(message.splitlines()) == len(message_parts)
