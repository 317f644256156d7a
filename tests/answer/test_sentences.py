"""The answer in words: every number with its unit, open edges as words, no invented interval."""

import numpy as np
import pytest
import xarray as xr
from answer_inputs import SURFACES, continued, edges, force, open_edges, without_interval
from refusals import assert_says

from hardcontact.answer.sentences import (
    band_sentences,
    force_sentences,
    is_open,
    one_sentence,
    pooled_sentence,
)


def of_first(data):
    return data.sel(surface=SURFACES[0])


def with_text(text, side="large"):
    data = of_first(open_edges())
    texts = data["edge_text"].astype(object)
    texts.loc[{"side": side}] = text
    return data.assign(edge_text=texts.astype(str))


def test_one_sentence_holds_band_force_range_and_work():
    assert one_sentence("my coating", of_first(edges()), of_first(force())) == (
        "How my coating sticks is decided by roughness with wavelengths from 37 [29.6, 46.2] nm to "
        "1.7 [1.36, 2.12] µm; its predicted pull-off force is 640 [512, 800] nN at a range of "
        "adhesion of 5.6 nm and a work of adhesion of 46.3 mJ/m²."
    )


def test_forces_with_continued_roughness_stand_beside_that_of_the_scans():
    changed = of_first(continued(force(), small=0.25))
    sentence = one_sentence("x", of_first(edges()), changed)
    assert sentence.endswith(
        "its predicted pull-off force is 640 [512, 800] nN with the roughness that its scans show, "
        "but 160 [128, 200] nN if it goes on below 20 nm down to 5 nm as its spectrum does (the "
        "scans that contacts are made on do not tell), at a range of adhesion of 5.6 nm and a work "
        "of adhesion of 46.3 mJ/m²."
    )
    both = one_sentence("x", of_first(edges()), of_first(continued(force(), small=0.25, large=2)))
    assert_says(
        both, "but 160 [128, 200] nN if it goes on below 20 nm",
        "and 1.28 [1.02, 1.6] µN if it goes on above 1 µm up to 2.56 µm as its spectrum does (the",
    )  # fmt: skip


@pytest.mark.parametrize(
    ("text", "clause"),
    [
        ("at least 5 µm: the scans end here", "at least 5 µm (the scans end here)"),
        ("at least 5 µm [above 1.2 µm]: the scans end here",
         "at least 5 µm [above 1.2 µm] (the scans end here)"),
        ("at most 5 nm: no shorter cutoff was computed, no interval",
         "at most 5 nm (no shorter cutoff was computed)"),
        ("1.7 µm, no interval", "1.7 µm"),
    ],
)  # fmt: skip
def test_an_open_edge_says_why_within_the_sentence(text, clause):
    sentence = one_sentence("x", with_text(text), of_first(force()))
    assert f"from 37 [29.6, 46.2] nm to {clause}; its predicted" in sentence


def test_a_band_says_which_end_is_open():
    data = of_first(open_edges())
    assert is_open(data, "large") and not is_open(data, "small")
    text = band_sentences("my coating", data)
    assert_says(text, "The longest of these wavelengths is open, not found: at least 2.56 µm")
    assert "shortest" not in text and "conditional on this scan" in text
    assert "changes by less than 10 %" not in text  # which nobody has computed


def test_a_band_that_is_found_says_what_it_means():
    text = band_sentences("my coating", of_first(edges()))
    assert_says(text, "changes by less than 10 %", "95 % intervals, from 3 scans;")
    assert "open" not in text


def test_force_has_its_spread_and_where_its_interval_comes_from():
    text = force_sentences("my coating", of_first(force()))
    assert_says(
        text, "640 [512, 800] nN at a range of adhesion of 5.6 nm", "plastic contact",
        "95 % interval of the mean, from 3 scans",
        "Of single contacts 90 % lie between 256 nN and 1.15 µN.",
    )  # fmt: skip


def test_an_interval_of_the_mean_that_is_wider_than_the_spread_is_explained():
    data = of_first(force())
    assert "less than the interval" not in force_sentences("x", data)
    data["force_interval"] = data["force"] * xr.DataArray([0.1, 10.0], dims="bound")
    assert_says(force_sentences("x", data), "1.15 µN: less than the interval of the mean, as")


def test_force_without_interval_says_why():
    text = force_sentences("x", of_first(without_interval(force())))
    assert_says(text, "is 640 nN at a range", "(no interval: every contact feels all of this scan)")
    assert "[" not in text and "nan" not in text


def test_a_band_without_interval_says_why():
    data = of_first(edges())
    data["scale_ratio_interval"] = data["scale_ratio_interval"] * np.nan
    text = band_sentences("x", data.assign(interval_note="no interval: a single quarter"))
    assert text.endswith(" No interval: a single quarter.") and "95 %" not in text


def test_pooled_band_is_in_words():
    assert_says(pooled_sentence(edges(2)), "from 45 [36, 56.2] nm to 1.5 [1.2, 1.88] µm")
