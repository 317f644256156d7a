"""What is chosen for scans of any size: the study accepts it, and it is what the rules say."""

import math
from dataclasses import replace

import pytest
from hypothesis import HealthCheck, event, given, settings
from hypothesis import strategies as st
from own_entries import both_efforts, check_study, entry, probe
from refusals import assert_says, refusal

from hardcontact.commands.proposal import propose
from hardcontact.surfaces.reliable_band import ReliableBand


def between(least, most):
    """Give numbers of any size between two."""
    return st.floats(math.log(least), math.log(most)).map(math.exp)


@st.composite
def scans(draw):
    """Give one to five scans of a surface on the same pixels."""
    size, pixels = draw(between(100, 1e5)), draw(st.integers(64, 2048))
    rms = draw(between(0.1, size / 10))
    shortest = draw(between(2, 2 * pixels)) * size / pixels
    band = ReliableBand(shortest, size / 3, "tip")
    return [entry(size, pixels, rms, band=band)] * draw(st.integers(1, 5))


def longest_least(scan, asked):
    """An upper bound on the shortest range of adhesion (nm) that a scan permits."""
    depth = 1e9 * math.sqrt(asked.preload / asked.hardness)
    pixels = 2 * scan.pixel_size**2 / asked.radius
    return max(pixels, scan.relief / 500, depth / 25)


def least_window(scan, asked):
    """A lower bound on the edge (nm) of what carries the load."""
    return min(2 * scan.size, 2 * math.sqrt(28 * asked.radius * asked.range))


def check_any(found, asked):
    """Expect a proposal that the study accepts, or a refusal of what it cannot accept."""
    try:
        proposal = propose(found, None, asked)
    except ValueError as error:
        for line in str(error).splitlines():
            event(line.partition(":")[0])
            if line.startswith("surface a: expected a height map"):
                assert found[0].pixel_size < 0.05
            elif line.startswith("--range"):
                assert longest_least(found[0], asked) > 39.9, line
            else:
                area = 1e18 * asked.preload / asked.hardness
                in_window = area / least_window(found[0], asked) ** 2
                # What 16 contacts with a hundred images of each pixel keep in memory.
                in_memory = area / found[0].pixel_size ** 2 / (2**26 / 16 / 100)
                assert line.startswith("--preload")
                assert in_window > 0.15 or in_memory > 1, line
        return
    event("accepted")
    check_study(asked, proposal)


@pytest.mark.parametrize("examples", [20, pytest.param(1000, marks=pytest.mark.study)])
def test_any_scan_gives_what_the_study_accepts(examples):
    @settings(
        max_examples=examples,
        deadline=None,
        derandomize=True,
        suppress_health_check=list(HealthCheck),
    )
    @given(scans(), st.builds(probe, between(1e3, 5e6), between(1e-9, 1e-3), between(1e8, 1e12)))
    def check(found, asked):
        check_any(found, asked)

    check()


def chosen(proposal):
    """Values by key."""
    return {choice.key: choice.value for choice in proposal.choices}


def test_scans_of_the_paper_get_about_its_values():
    (config, _) = both_efforts(probe(), propose([entry()] * 5, None, probe()))
    assert config["contact"]["window"] == pytest.approx(12500, rel=0.01)
    assert config["contact"]["count"] == 20
    small, large = config["scales"]["small"], config["scales"]["large"]
    assert small["transition"] == pytest.approx(20, rel=0.05)
    assert large["transition"] == 1000
    assert large["tiles"] == 4
    assert small["pixels"] == large["pixels"] == 4096
    assert config["scales"]["realizations"] == 5
    assert config["scales"]["range"] == 5.6
    assert 5.6 in config["adhesion"]["ranges"]
    # Both critical wavelengths of the paper lie well inside.
    assert small["cutoffs"][0] < 43 / 4 and small["cutoffs"][-1] == 2500
    assert large["cutoffs"][0] <= 100 and large["cutoffs"][-1] == 10000


def test_a_colloidal_probe():
    asked = probe(radius=5e3, preload=100e-9, hardness=5e9, rho=2.0)
    for scan in (entry(), entry(10000, 512, 14), entry(1000, 256, 2)):
        proposal = propose([scan], None, asked, True)
        check_study(asked, proposal)
        assert chosen(proposal)["scales.range"] == "2 nm"
    # 20 nm² are less than a pixel of 19.5 nm, and more than one of 3.9 nm.
    said = [
        propose([scan], None, asked, True).cautions for scan in (entry(10000), entry(1000, 256, 2))
    ]
    assert "less than a pixel" in " ".join(said[0])
    assert "less than a pixel" not in " ".join(said[1])


def test_quick_costs_less():
    full, quick = both_efforts(probe(), propose([entry()], None, probe()))
    for side in ("small", "large"):
        assert quick["scales"][side]["pixels"] == full["scales"][side]["pixels"] / 2
        assert len(quick["scales"][side]["cutoffs"]) < len(full["scales"][side]["cutoffs"])
        assert quick["scales"][side]["transition"] == full["scales"][side]["transition"]
    assert quick["scales"]["realizations"] == 2
    assert quick["scales"]["range"] in quick["adhesion"]["ranges"]


@pytest.mark.parametrize(("count", "realizations"), [(1, 5), (2, 4), (3, 6), (5, 5), (7, 7)])
def test_every_scan_makes_as_many_masters(count, realizations):
    assert chosen(propose([entry()] * count, None, probe()))["scales.realizations"] == realizations


def test_roughness_is_artificial_below_the_reliable_wavelengths():
    band = ReliableBand(120.0, 833.0, "tip")
    proposal = propose([entry(band=band), entry()], None, probe())
    (transition,) = [one for one in proposal.choices if one.key == "scales.small.transition"]
    assert transition.value == "120 nm" and "the tip" in transition.reason
    blind = ReliableBand(2000.0, 833.0, "tip")
    proposal = propose([entry(band=blind)], None, probe())
    assert chosen(proposal)["scales.small.transition"] == "1000 nm"
    assert "no wavelength is reliable, from 2 µm (the tip) to 833 nm" in " ".join(proposal.cautions)


def test_a_usual_range_that_is_too_short_is_made_longer_and_said():
    rough = entry(20000, 512, 700.0)  # relief 5600 nm: exponentials overflow below 11.2 nm
    proposal = propose([rough], None, probe())
    assert chosen(proposal)["scales.range"] == "11.2 nm"
    assert "11.2 nm, not the usual 5.6 nm" in " ".join(proposal.cautions)
    message = refusal(propose, [rough], None, probe(rho=6.0), True)
    assert_says(message, "--range: expected at least 11.2 nm", "found 6 nm")


def test_a_range_and_a_preload_are_refused_together():
    asked = probe(preload=1.0, hardness=1e9, rho=0.02)
    with pytest.raises(ValueError) as caught:
        propose([entry()], None, asked, True)
    lines = str(caught.value).splitlines()
    assert [line.split(":")[0] for line in lines] == ["--range", "--preload"]
    # A quarter of the stitched scan, 6.25 um2, carries 6.25 mN at 1 GPa.
    assert "at most 6.25 mN" in lines[1] and "found 1 N" in lines[1]


def test_too_small_a_scan_is_said_with_numbers():
    said = " ".join(propose([entry(100, 512, 4.7)], None, probe()).cautions)
    # erf(1000 nm / sqrt(2 R rho))^2 of the smooth sphere's force lie in a window of 2 um.
    assert f"{math.erf(1000 / math.sqrt(2 * 250e3 * 5.6)) ** 2:.0%} of the force" in said
    assert "the scans are 100 nm wide" in said and "8 to 17 times too high" in said
    assert not propose([entry(10000, 512, 14)], None, probe()).cautions


def test_two_surfaces_share_their_keys():
    asked = probe()
    similar = [entry(), entry(5000, 256, 50.0, surface="b")]
    check_study(asked, propose(similar, None, asked))
    message = refusal(propose, [entry(100), entry(1e5, surface="b")], None, asked)
    assert_says(message, "100 nm on a", "195 nm on b", "a study of each")


def test_gaps_are_filled_and_said():
    choices = propose([entry(undefined=3)], None, probe()).choices
    assert choices[0][:2] == ("scan.undefined_pixels", "harmonic")


@pytest.mark.parametrize(("share", "told"), [(0.04, 0), (0.3, 1)])
def test_many_undefined_pixels_are_a_caution(share, told):
    scan = entry()
    scan = replace(scan, undefined=int(share * scan.pixels**2))
    cautions = propose([scan], None, probe()).cautions
    assert sum("30% of its pixels are undefined" in caution for caution in cautions) == told
