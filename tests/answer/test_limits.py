"""What limits an answer: each limit is named where it holds, and only there."""

import numpy as np
import pytest
from answer_inputs import (
    MEASUREMENTS,
    SURFACES,
    continued,
    edges,
    force,
    open_edges,
    spectra,
    without_interval,
)  # fmt: skip

from hardcontact.answer.limits import artificial_edges, grave_limits, limits, measurement_name


def of_first(data):
    return data.sel(surface=SURFACES[0])


def said(basis="measured", of_spectra=None, of_edges=None, of_force=None):
    """All limits in one text."""
    found = limits(
        basis,
        of_first(spectra() if of_spectra is None else of_spectra),
        of_first(edges() if of_edges is None else of_edges),
        of_first(force() if of_force is None else of_force),
    )
    assert len(set(found)) == len(found) and all(text.endswith(".") for text in found)
    return " ".join(found)


def with_edge(edge, low, high, side="small"):
    data = edges()
    at = {"side": side}
    data["edge"].loc[at] = edge
    data["edge_interval"].loc[{**at, "bound": "low"}] = low
    data["edge_interval"].loc[{**at, "bound": "high"}] = high
    return data


def test_substitutes_are_named():
    assert "substitute" in said("substitute") and "substitute" not in said()


def test_open_edges_are_named_with_their_bound():
    assert "The long edge of the band is open: at least 2.56 µm" in said(of_edges=open_edges())
    assert "is open" not in said()


@pytest.mark.parametrize(("bound", "words"), [("low", "shorter"), ("high", "longer")])
def test_open_ends_of_intervals_are_named(bound, words):
    data = edges()
    status = data["interval_status"].astype(object)
    status.loc[{"side": "small", "bound": bound}] = "open"
    text = said(of_edges=data.assign(interval_status=status.astype(str)))
    assert f"The short edge of the band may lie at {words} wavelengths" in text
    assert text.count("may lie") == 1


def test_an_edge_without_any_interval_has_no_open_ends():
    data = edges()
    status = data["interval_status"].astype(object)
    status.loc[{"side": "small"}] = "open"
    data["edge_interval"].loc[{"side": "small"}] = np.nan
    assert "may lie" not in said(of_edges=data.assign(interval_status=status.astype(str)))


UNRELIABLE = "wavelengths where no scan is reliable: roughness there is uncertain or artificial."


def test_edges_in_artificial_roughness_are_named():
    assert f"The short edge of the band lies at {UNRELIABLE}" in said()
    assert "artificial" not in said(of_edges=with_edge(100.0, 80.0, 130.0))
    partly = said(of_edges=with_edge(70.0, 40.0, 90.0))
    assert f"The interval of the short edge of the band reaches {UNRELIABLE}" in partly
    both = with_edge(30_000.0, 26_000.0, 40_000.0, "large")
    assert artificial_edges(of_first(spectra()), of_first(both)) == [
        f"Both edges of the band lie at {UNRELIABLE}"
    ]


def test_an_open_bound_in_artificial_roughness_is_named():
    data = open_edges()
    data["edge"].loc[{"side": "small"}] = 100.0
    data["edge_interval"].loc[{"side": "small"}] = [80.0, 130.0]
    assert artificial_edges(of_first(spectra()), of_first(data)) == []
    data["edge_bound"].loc[{"side": "large"}] = 30_000.0
    (text,) = artificial_edges(of_first(spectra()), of_first(data))
    assert text.startswith("The long edge of the band lies")


def test_edges_without_interval_are_judged_by_themselves():
    clear = with_edge(100.0, np.nan, np.nan)
    assert artificial_edges(of_first(spectra()), of_first(clear)) == []


def test_finite_scans_have_their_number():
    note = "the scan is 0.6 µm wide, contacts draw from 5 µm: forces may be 1.7 times too high."
    text = said(of_force=force().assign(finite_scan_note=("surface", [note])))
    assert note in text and note not in said()


def test_a_window_that_cuts_forces_off_is_named():
    share = np.array([1, 1, 0.36, 0.2, 0.1])
    text = said(of_force=force().assign(window_share=("rho", share)))
    assert "Forces come out too low: the window of 12.5 µm holds 36% of the force on a" in text
    assert "at a range of 5.6 nm." in text and "too low" not in said()
    longest = said(of_force=force().assign(window_share=("rho", [1, 1, 0.995, 0.95, 0.9])))
    assert "From a range of adhesion of 10 nm on forces come out too low" in longest
    assert "holds 90% of the force on a smooth sphere at a range of 14 nm." in longest


def test_forces_that_continued_roughness_changes_are_named():
    text = said(of_force=continued(force(), small=0.45))
    assert "The force of 288 [230, 360] nN rests on roughness below 20 nm down to 5 nm, wh" in text
    assert "rests on roughness" not in said()
    both = said(of_force=continued(force(), small=0.45, large=1.25))
    assert "and that of 800 [640, 1000] nN rests on roughness above 1 µm up to 2.56 µm, wh" in both


def test_pixels_larger_than_the_contact_are_named():
    text = said(of_force=force().assign_attrs(contact_area=20.0))
    assert "The preload is carried by 20 nm², less than a pixel of the scans (100 nm²)" in text
    assert "one pixel" not in said()
    few = said(of_force=force().assign_attrs(contact_area=250.0))
    assert "250 nm², 2.5 pixels of the scans (100 nm²)" in few and "one pixel" not in few
    assert "The preload is carried" not in said(of_force=force().assign_attrs(contact_area=1000.0))


def test_edges_between_cutoffs_far_apart_are_named():
    data = edges()
    kept = data.isel(cutoff_wavelength=~data["cutoff_wavelength"].isin([10, 40]).values)
    text = said(of_edges=kept)
    assert (
        "The short edge of the band is read off between the two cutoffs computed beside it, 20 nm "
        "and 80 nm; where between them it lies is interpolated. Its 95 % interval is another "
        "thing: from 29.6 nm to 46.2 nm, as far as the scatter of forces may move it."
    ) in text
    assert "The long edge of the band is read off" not in text
    unknown = kept.assign(edge_interval=kept["edge_interval"] * np.nan)
    assert "interpolated." in said(of_edges=unknown) and "another thing" not in said(
        of_edges=unknown
    )
    assert "interpolated" not in said() + said(of_edges=open_edges())


def test_what_changes_the_answer_stands_on_the_first_screen():
    parts = [of_first(one) for one in (spectra(), with_edge(100.0, 80.0, 130.0), force())]
    assert grave_limits(*parts) == []
    share = ("rho", [1, 1, 0.95, 0.8, 0.7])
    mild = parts[2].assign(finite_scan_note="the scan is small.", window_share=share)
    assert grave_limits(*parts[:2], mild) == []
    grave = mild.assign(finite_scan_ratio=("bound", [2.0, 4.0]))
    assert grave_limits(*parts[:2], grave) == ["the scan is small."]
    (text,) = grave_limits(*parts[:2], mild.assign(window_share=("rho", [0.5] * 5)))
    assert text.startswith("Forces come out too low")
    window, scan, both = grave_limits(*parts[:2], grave.assign(window_share=("rho", [0.5] * 5)))
    assert window == text and scan == "the scan is small." and "a rough guess" in both
    (pixel,) = grave_limits(*parts[:2], parts[2].assign_attrs(contact_area=20.0))
    assert "one pixel touches" in pixel


def test_contacts_on_scans_that_are_reliable_nowhere_are_named():
    blind = of_first(spectra())
    blind["reliable"].loc[{"measurement": 1}] = 0  # of the first, whose pixels contacts have
    parts = [blind, of_first(with_edge(200.0, 180.0, 230.0)), of_first(force())]
    (text,) = [one for one in grave_limits(*parts) if "reliable at no wavelength" in one]
    assert text in limits("measured", *parts)
    assert "that contacts are made on are reliable" not in said()


def test_intervals_of_few_scans_are_conditional():
    assert "conditional" not in said()
    quarters = force().assign(conditional=("surface", [1]), correlation_of_parts=("surface", [0.2]))
    text = said(of_force=quarters)
    assert text.count("conditional on the scans at hand") == 1 and "correlate by 0.20" in text


def test_a_force_without_interval_says_so():
    assert "Interval of the mean force: no interval: every contact" in said(
        of_force=without_interval(force())
    )


def test_ends_of_the_reliable_wavelengths_have_their_reason():
    text = said()
    assert "No scan is reliable below 55 nm: tip of 10 nm (scans/fine.spm)." in text
    assert "No scan is reliable above 25 µm: size of the scan (scans/line.txt)." in text
    noisy = {"coarse.spm": MEASUREMENTS["coarse.spm"]}
    assert "noise floor below 160 nm" in said(of_spectra=spectra(measured=noisy))
    assert "continued with H = 0.8" in text


def test_unknown_tips_are_named_and_counted():
    assert "scans/coarse.spm, scans/line.txt." in said()
    many = {f"{n}.spm": MEASUREMENTS["coarse.spm"] for n in range(7)}
    assert "scans/3.spm and 3 more." in said(of_spectra=spectra(measured=many))
    sharp = {"fine.spm": MEASUREMENTS["fine.spm"]}
    assert "blunt tip" not in said(of_spectra=spectra(measured=sharp))


def test_scans_that_are_reliable_nowhere_are_named():
    data = spectra()
    data["reliable"].loc[{"measurement": 1}] = 0
    text = said(of_spectra=data)
    assert "not in the spectrum: scans/fine.spm (tip of 10 nm)." in text
    assert "No scan is reliable below 160 nm" in text and "no wavelength" not in said()


def test_measurements_of_containers_have_both_names():
    data = of_first(spectra()).isel(measurement=0)
    assert measurement_name(data) == "scans/fine.spm"
    assert measurement_name(data.assign(dataset=((), "map-1"))) == "scans/fine.spm: map-1"
