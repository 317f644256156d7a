"""Edges of your surfaces, what to measure next, and the conclusion on their scans."""

import numpy as np
import pytest
import xarray as xr
from intervals import between_multiples
from own_answers import make_answer, numbers_of, setting
from own_datasets import (
    CONFIDENCE,
    MEASUREMENTS,
    SURFACES,
    Measurement,
    datasets,
    drop_interval,
    edges,
    force,
    move_edge,
    open_edges,
    scaled_extrapolated_force,
    spectra,
    unresolved_edges,
)

from hardcontact.base.number import Number, json_value
from hardcontact.report.own_surfaces.answer import surface_answers
from hardcontact.report.own_surfaces.edges import (
    edge_source,
    reliable_and_unreliable_change,
    surface_conclusion,
)


@pytest.mark.parametrize(
    ("data", "expected"),
    [
        (move_edge(120.0, 90.0, 150.0), ("measured", 90.0, 150.0)),
        (move_edge(70.0, 40.0, 90.0), ("partly_extrapolated", None, 90.0)),
        (move_edge(37.0, 20.0, 90.0), ("extrapolated", None, None)),
        (move_edge(120.0, np.nan, np.nan), ("measured", None, None)),
        (move_edge(120.0, 40.0, 150.0), ("interval_extrapolated", None, 150.0)),
    ],
)
def test_unreliable_ends_of_intervals_are_left_out(data, expected):
    # The scans are reliable from 55 nm.
    edge = json_value(numbers_of(edges=data)["short_edge"])
    assert (edge["source"], edge["low"], edge["high"]) == expected


def test_the_change_at_an_edge_is_split_at_the_shortest_reliable_wavelength():
    # ln F is linear in ln c between cutoffs c of 40 and 80 nm, and the scans begin at 55 nm.
    data = move_edge(80.0, 70.0, 90.0)
    log_ratios = np.log(data["filtered_force_ratio"].sel(surface=SURFACES[0], side="short"))
    low, high = log_ratios.sel(cutoff_wavelength=[40, 80]).values
    unseen = low + (high - low) * np.log(55 / 40) / np.log(2)
    surface_data = datasets(edges=data).select_surface(SURFACES[0])
    changes = reliable_and_unreliable_change(surface_data, "short", shortest=0, longest=80)
    np.testing.assert_allclose(changes, [high - unseen, unseen], rtol=1e-4)
    assert numbers_of(edges=data)["short_edge_measured_share"].value == pytest.approx(
        1 - unseen / high, rel=1e-4
    )
    # The longest cutoff, 320 nm, is four times the edge.
    assert sum(reliable_and_unreliable_change(surface_data, "short")) == pytest.approx(
        np.log1p(0.1 * 4**4), rel=1e-4
    )


def test_open_edges_are_bounds():
    bound = Number("long_edge", 2560.0, "nm", status="open_above", source="measured")
    assert json_value(numbers_of(edges=open_edges())["long_edge"]) == json_value(bound)
    edges_open_below = open_edges()
    edges_open_below["edge_status"].loc[{"side": "long"}] = "open_below"
    assert numbers_of(edges=edges_open_below)["long_edge"].status == "open_below"
    edges_open_below["edge_bound"].loc[{"side": "long"}] = 30_000.0  # beyond the scans
    assert (
        edge_source(datasets(edges=edges_open_below).select_surface(SURFACES[0]), "long")
        == "extrapolated"
    )


def with_long_edge(status):
    """Return edges whose long edge is open."""
    data = open_edges()
    data["edge_status"].loc[{"side": "long"}] = status
    return data


SHORT_ADVICE = ("short_edge", "finer", 37.0)


@pytest.mark.parametrize(
    ("data", "advice"),
    [
        (move_edge(120.0, 90.0, 150.0), []),
        (move_edge(37.0, 20.0, 90.0), [SHORT_ADVICE]),
        (move_edge(70.0, 40.0, 90.0), [("short_edge", "finer", 55.0)]),
        (unresolved_edges(), [("short_edge", "finer", 55.0), ("long_edge", "larger", 25_000.0)]),
        (with_long_edge("open_above"), [SHORT_ADVICE, ("long_edge", "larger", 25_000.0)]),
        (with_long_edge("open_below"), [SHORT_ADVICE, ("long_edge", "finer", 55.0)]),
    ],
)
def test_open_and_extrapolated_edges_recommend_a_measurement(data, advice):
    # The scans are reliable from 55 nm to 25 µm.
    measurements = surface_answers(datasets(edges=data), setting())[0].next_scans
    assert [(scan.edge, scan.code, scan.limit.value) for scan in measurements] == advice


def notes_of_hindcasts(ratios, fails):
    """The codes and texts of all notes; the ratios are of both sides, 320 to 800 nm is missing."""
    scans = {name: MEASUREMENTS[name] for name in ("fine.spm", "line.txt")}
    variables = between_multiples("hindcast_ratio", "side", ratios, (0.9, 1.1), CONFIDENCE)
    tested = force().assign(variables | {"hindcast_fails": ("side", fails)})
    answer = make_answer(datasets(force=tested, spectra=spectra(scans=scans)))
    return [(note["code"], note["text"]) for note in answer["notes"]]


@pytest.mark.parametrize(("ratio", "code"), [(np.nan, "gap"), (0.3, "larger")])
def test_a_gap_is_to_be_measured_if_the_scans_show_no_octave_for_a_hindcast(ratio, code):
    notes = dict(notes_of_hindcasts([1.0, ratio], [0, 1]))
    assert code in notes and ("gap" in notes) == (code == "gap")
    advice = "For the long edge, measure wavelengths of 320 nm to 800 nm, which no scan shows"
    assert (advice in notes[code]) == (code == "gap")


def test_a_scan_that_may_find_both_edges_is_asked_for_once():
    notes = notes_of_hindcasts([np.nan, np.nan], [1, 1])
    (advice,) = [text for code, text in notes if code == "gap"]
    assert advice.startswith("For both edges, measure wavelengths of 320 nm to 800 nm")


@pytest.mark.parametrize(("pixel_size", "suffice"), [(5.0, True), (20.0, False)])
def test_finer_pixels_are_asked_for_only_if_the_pixels_are_too_large(pixel_size, suffice):
    data = datasets(edges=move_edge(70.0, 40.0, 90.0), spectra=spectra())
    data.spectra["pixel_size"][:] = pixel_size
    (scan,) = surface_answers(data, setting())[0].next_scans
    assert scan.pixels_suffice == suffice


def test_a_described_spectrum_recommends_no_measurement():
    described = spectra()
    described["kind"] = xr.full_like(described["kind"], "description", dtype="U11")
    data = datasets(edges=with_long_edge("open_above"), spectra=described)
    assert surface_answers(data, setting())[0].next_scans == []


def test_a_missing_interval_has_a_reason():
    data = move_edge(120.0, np.nan, np.nan)
    for source, status in {"quarters": "no_interval", "few_patches": "few_patches"}.items():
        edges_without_interval = data.assign(interval_source=("surface", [source]))
        assert numbers_of(edges=edges_without_interval)["short_edge"].status == status
    bounded_below = numbers_of(edges=move_edge(120.0, 90.0, np.nan))["short_edge"]
    assert bounded_below.low == 90.0 and np.isnan(bounded_below.high) and not bounded_below.status
    assert numbers_of(force=drop_interval(force()))["mean_force"].status == "no_interval"


def test_contacts_that_touch_too_few_patches_give_no_answer():
    few_patches = drop_interval(force()).assign(
        interval_source=("surface", ["few_patches"]),
        contacts=("surface", [64]),
        touched_patches=("surface", [3.0]),
    )
    conclusion = surface_conclusion(numbers_of(force=few_patches))
    assert (conclusion.answered, conclusion.band_status) == ("no", "few_patches")


def conclude(data, wavelengths, force_data=None):
    """The conclusion on edges with a scan that is reliable between two wavelengths (nm)."""
    shortest, longest = wavelengths
    scan = Measurement("map", 2 * longest, 1, shortest, longest, "pixels", np.nan)
    scan_spectra = spectra(scans={"scan.spm": scan})
    return surface_conclusion(
        numbers_of(edges=data, spectra=scan_spectra, force=force_data or force())
    )


@pytest.mark.parametrize(
    ("data", "wavelengths", "answer", "band"),
    [
        (edges(), (6, 25e3), "yes", "found"),
        (edges(), (55, 25e3), "partly", "found"),
        (edges(), (400, 1000), "no", "found"),
        (open_edges(), (6, 25e3), "partly", "found"),
        (move_edge(3000.0, 2000.0, 4000.0), (6, 25e3), "yes", "overlapping"),
        (unresolved_edges(), (6, 25e3), "no", "unresolved"),
    ],
)
def test_the_answer_follows_from_the_edges_and_the_scans(data, wavelengths, answer, band):
    conclusion = conclude(data, wavelengths)
    assert (conclusion.answered, conclusion.band_status) == (answer, band)


def test_scans_that_lack_roughness_answer_in_part_at_most():
    changed_force = scaled_extrapolated_force(short=0.25)
    assert conclude(edges(), (6, 25e3), changed_force).answered == "partly"
    assert conclude(edges(), (400, 1000), changed_force).answered == "no"


def test_a_force_with_an_unknown_extrapolation_is_not_in_the_answer():
    unknown = spectra().assign(tail_known=("surface", [0]))
    extrapolated_force = scaled_extrapolated_force(short=0.25)
    partial = surface_conclusion(numbers_of(force=extrapolated_force, spectra=unknown))
    assert (partial.answered, partial.extrapolated_sides) == ("partly", [])
    plain = surface_conclusion(numbers_of())
    assert plain.extrapolated_sides == [] and plain.short_edge.value == 37.0
