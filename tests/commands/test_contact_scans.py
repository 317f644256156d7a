"""Which scans make contacts: on what is known of several sizes."""

from own_entries import entry, probe
from refusals import assert_says, refusal

from hardcontact.commands.contact_scans import contact_scans, draw_sizes
from hardcontact.surfaces.reliable_band import ReliableBand

RADIUS, RHO = 250e3, 5.6


def scans_and_reasons(entries, sphere=None, radius=RADIUS):
    """Return what `contact_scans` does for the draw sizes of these scans."""
    asked = probe(radius, rho=RHO)
    return contact_scans(entries, sphere, asked, draw_sizes(entries, sphere, asked))


def sizes(entries, sphere=None, radius=RADIUS):
    """Return the sizes of the scans chosen, by surface."""
    chosen, _ = scans_and_reasons(entries, sphere, radius)
    return {
        name: [round(one.size) for one in chosen if one.source.surface == name]
        for name in dict.fromkeys(one.source.surface for one in entries)
    }


def test_the_smallest_size_that_holds_the_highest_points():
    # 2 sqrt(2 R 4 nm) = 2.83 um; of rougher ones, 17 nm, 5.83 um.
    several = [500, 1000, 5000, 5000, 10000, 20000]
    assert sizes([entry(size, rms=4.0) for size in several]) == {"a": [5000, 5000]}
    assert sizes([entry(size, rms=17.0) for size in several]) == {"a": [10000]}
    assert sizes([entry(size, rms=400.0) for size in several]) == {"a": [20000]}
    # A small sphere finds them nearby.
    assert sizes([entry(size, rms=17.0) for size in several], radius=5e3) == {"a": [1000]}


def test_coarse_pixels_are_not_chosen_for_size():
    # sqrt(2 R rho) = 1673 nm is 8.6 pixels of 195 nm.
    assert sizes([entry(100e3, 512), entry(5000, 512)]) == {"a": [5000]}
    assert sizes([entry(100e3, 512), entry(300e3, 512)]) == {"a": [100000]}


def test_scans_without_a_reliable_wavelength_come_last():
    blind = ReliableBand(3000.0, 2000.0, "tip")
    assert sizes([entry(6000, band=blind), entry(2500)]) == {"a": [2500]}
    assert sizes([entry(6000, band=blind)]) == {"a": [6000]}


def test_line_scans_make_no_contacts():
    line = entry(1e5, 3000, kind="profile")
    assert sizes([line, entry()]) == {"a": [2500]}
    message = refusal(scans_and_reasons, [line])
    assert_says(message, "surface a: expected a height map", "found none", "hardcontact predict")
    fine = entry(0.5, 512)  # pixels of 1 pm
    assert_says(refusal(scans_and_reasons, [fine]), "0.05 to 10000 nm")


def test_surfaces_are_compared_on_one_grid():
    # Alone, a (4 nm) would take 5 um and b (17 nm) 10 um.
    both = [
        entry(size, rms=rms, surface=name)
        for name, rms in (("a", 4.0), ("b", 17.0))
        for size in (5000, 10000)
    ]
    assert sizes(both) == {"a": [10000], "b": [10000]}
    different = [entry(5000, rms=4.0), entry(10000, rms=4.0, surface="b")]
    assert sizes(different) == {"a": [5000], "b": [10000]}


def test_the_sphere_follows_the_substrates():
    ball = [entry(size, rms=1.0, surface="sphere") for size in (2500, 2500, 6000)]
    assert sizes([entry(6000), *ball], "sphere") == {"a": [6000], "sphere": [6000]}
    assert sizes([entry(7000), *ball], "sphere") == {"a": [7000], "sphere": [2500, 2500]}
    # Not larger than the sphere itself.
    assert sizes([entry(6000), *ball], "sphere", 5000.0)["sphere"] == [2500, 2500]


def test_the_reason_is_said():
    _, (reason,) = scans_and_reasons([entry(5000, rms=4.0), entry(500)])
    assert_says(reason, "a: the scan of 5 µm", "512 pixels")
    _, (reason,) = scans_and_reasons([entry(), entry()])
    assert_says(reason, "the 2 scans of 2.5 µm", "no others")
