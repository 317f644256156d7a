"""Curves of the page: values of the datasets, what is artificial shaded; pictures of them."""

import json
from functools import cache

import numpy as np
import pytest
from answer_inputs import (
    CUTOFFS,
    EDGES,
    MODELS,
    RANGE,
    RHOS,
    SURFACES,
    WORK,
    edges,
    fit,
    force,
    open_edges,
    spectra,
    topography,
    without_interval,
)  # fmt: skip
from matplotlib.text import Text

from hardcontact.answer import curves, pictures
from hardcontact.answer.datasets import at_range, model_of
from hardcontact.answer.surface_facts import of_answer

PHONE = 358  # pixels that a figure is wide on a screen of 390
LEAST_TEXT = 9.0  # pixels, with letters of some 7: as small as footnotes on phones are
LABELS = {"my_coating": "my coating", "twin": "twin"}
ONE = {"my_coating": "my coating"}


def of_first(data):
    return data.sel(surface=SURFACES[0])


@cache
def made():
    return {
        "spectrum": curves.spectrum_curve(of_first(spectra())),
        "ratio": curves.ratio_curve(of_first(edges()), of_first(spectra())),
        "open": curves.ratio_curve(of_first(open_edges()), of_first(spectra())),
        "force": curves.force_curve(force(2), LABELS),
        "without interval": curves.force_curve(without_interval(force()), ONE),
        "work": curves.work_curve(of_answer(fit()), ONE),
        "works": curves.work_curve(of_answer(fit(2)), LABELS),
    }


@pytest.mark.parametrize("name", made())
def test_curves_are_json_of_one_length_and_readable_pictures(name):
    curve = made()[name]
    assert json.loads(json.dumps(curve, allow_nan=False)) == curve
    assert np.all(np.diff(curve["x"]["values"]) > 0)
    for one in curve["series"]:
        for end in ("values", "low", "high"):
            assert one[end] is None or len(one[end]) == len(curve["x"]["values"])
    figure = pictures.curve_figure(curve)
    figure.draw_without_rendering()
    texts = [text for text in figure.findobj(Text) if text.get_visible() and text.get_text()]
    points = PHONE / (72 * figure.get_figwidth())
    assert texts and min(text.get_fontsize() for text in texts) * points >= LEAST_TEXT


def test_pictures_are_the_same_each_time():
    first, second = (pictures.png(pictures.curve_figure(made()["ratio"])) for _ in range(2))
    assert first == second and first.startswith(b"\x89PNG") and len(first) < 150_000
    assert pictures.png(pictures.map_figure(of_first(topography()))).startswith(b"\x89PNG")


def test_ratios_are_those_of_the_cutoffs_of_their_side():
    curve, data = made()["ratio"], of_first(edges())
    for one, (side, cutoffs) in zip(curve["series"], CUTOFFS.items(), strict=True):
        shown = {x: y for x, y in zip(curve["x"]["values"], one["values"], strict=True) if y}
        assert list(shown) == cutoffs.tolist()
        known = data["scale_ratio"].sel(side=side).dropna("cutoff_wavelength").values
        np.testing.assert_allclose(list(shown.values()), known, rtol=1e-4)
    assert curve["alike"] == pytest.approx([0.9, 1.1])
    assert curve["y"]["range"][1] <= 2.0  # a change of 10 % is seen
    assert curve["marks"] == list(EDGES.values())
    assert made()["open"]["marks"] == [EDGES["small"]]


def test_artificial_wavelengths_are_shaded():
    for name in ("ratio", "spectrum"):
        (_, short), (long, _) = made()[name]["shaded"][0], made()[name]["shaded"][-1]
        assert short == 55.0 and long == 25_000.0


def test_spectra_are_shown_where_they_are_reliable_and_else_apart():
    curve, data = made()["spectrum"], of_first(spectra())
    x = np.array(curve["x"]["values"])
    by_label = {one["label"]: np.array(one["values"], float) for one in curve["series"]}
    for place, name in enumerate(("fine.spm", "coarse.spm", "line.txt")):
        inside = x[np.isfinite(by_label[name])]
        assert data["shortest_reliable"][place] <= inside.min()
        assert inside.max() <= data["longest_reliable"][place]
        apart = np.isfinite(by_label[f"{name}, not reliable"])
        assert apart.any() and not (apart & np.isfinite(by_label[name])).any()
    assert {"joined", "used"} <= set(by_label)


def test_forces_of_every_model_stand_over_the_range():
    curve, data = made()["force"], force(2)
    assert curve["x"]["values"] == RHOS.tolist() and curve["marks"] == [RANGE]
    assert len(curve["series"]) == 2 * len(MODELS)
    expected = 1e6 * data["force"].sel(contact_model=["plastic", "rigid"]).values.reshape(4, -1)
    np.testing.assert_allclose([one["values"] for one in curve["series"]], expected, rtol=1e-4)
    assert [one["low"] is not None for one in curve["series"]] == [True, False] * 2
    assert all(one["low"] is None for one in made()["without interval"]["series"])


def test_what_fits_every_surface_is_shown_where_there_are_several():
    alone, together = made()["work"], made()["works"]
    assert [one["label"] for one in alone["series"]] == ["my coating"]
    assert [one["label"] for one in together["series"]] == ["my coating", "twin", "fits all"]
    nearest = int(np.abs(np.array(alone["x"]["values"]) - RANGE).argmin())
    assert alone["series"][0]["values"][nearest] == pytest.approx(1e3 * WORK, rel=0.05)


def test_force_is_that_at_the_range_asked_for():
    here = at_range(force())
    assert here["rho"] == RANGE and here["force"].item() == pytest.approx(0.64e-6)
    assert here["contact_model"] == "plastic"
    assert model_of(force().sel(contact_model=["rigid"])) == "rigid"
    with pytest.raises(KeyError):
        at_range(force().assign_attrs(range_of_adhesion=4.0))
