"""What own forces say, in words: what is measured is called so, and open ends are told."""

import numpy as np
import pytest
from answer_inputs import datasets, fit
from refusals import assert_says

from hardcontact.answer import fit_curve
from hardcontact.answer.first_sentences import first_sentences, fit_sentences

FEW = ", too few to tell how they scatter: the upper end is uncertain"


def test_one_force_gives_the_work_at_each_range():
    text = fit_sentences(fit_curve.of_answer(fit()))
    assert_says(
        text, "Measured: 640 [576, 704] nN on my coating (40 tests; scans: from 3 scans)",
        "One mean force: every range", "46.3 [37, 57.9] mJ/m² at the range of 5.6 nm asked for",
        "19.6 [15.7, 24.5] mJ/m² at 1 nm", "73.2 [58.6, 91.5] mJ/m² at 14 nm", "95 % intervals",
    )  # fmt: skip
    assert "published" not in text.lower() and "goes on" not in text


def test_the_work_with_continued_roughness_stands_beside_that_of_the_scans():
    data = fit_curve.of_answer(fit())
    data["continued_differs"].loc[{"side": "small"}] = 1
    assert "asked for, or 23.1 [18.5, 28.9] mJ/m² there if the roughness goes on below 20 nm" in (
        fit_sentences(data)
    )


def test_several_forces_give_range_and_work():
    text = fit_sentences(fit_curve.of_answer(fit(2)))
    assert_says(text, "1.3 [1.17, 1.43] µN on twin", "Range 5.6 nm, work 46 mJ/m²", "region:")
    assert_says(text, "my coating: 46.3 [37, 57.9] mJ/m²", "twin: 46.3 [")


def test_a_fit_without_intervals_has_none():
    data = fit_curve.of_answer(fit())
    for name in ("measured_force", "work_of_adhesion"):
        data[f"{name}_interval"] = data[f"{name}_interval"] * np.nan
    assert "[" not in fit_sentences(data)


def test_an_answer_begins_with_the_prediction_and_then_what_was_measured():
    (text,) = first_sentences(datasets(fit=fit())).values()
    assert text.startswith(first_sentences(datasets())["my_coating"])
    assert text.endswith(
        " Measured, by its own forces: 640 [576, 704] nN (40 tests), which means a work of "
        "adhesion of 46.3 [37, 57.9] mJ/m² at a range of 5.6 nm. One mean force: every range of "
        "adhesion has its own work of adhesion."
    )
    changed = fit()
    changed["continued_differs"].loc[{"side": "small"}] = 1
    (text,) = first_sentences(datasets(fit=changed)).values()
    assert ", or 23.1 [18.5, 28.9] mJ/m² if the roughness goes on below 20 nm." in text


@pytest.mark.parametrize(("work", "told"), [(10.0, False), (50.8, True)])
def test_a_work_beyond_that_of_any_solids_asks_for_the_unit(work, told):
    given = fit()
    given["work_of_adhesion"] = given["work_of_adhesion"] * 0 + work
    (text,) = first_sentences(datasets(fit=given)).values()
    assert ("is the unit of the forces right?" in text) is told


def test_forces_of_several_surfaces_give_range_and_work_at_once():
    texts = first_sentences(datasets(2, fit=fit(2)))
    together = " The forces measured on 2 surfaces together: range 5.6 nm, work 46 mJ/m² ("
    assert all(together in text for text in texts.values())
    only = first_sentences(datasets(2, fit=fit()))
    assert "Measured" in only["my_coating"] and "easured" not in only["twin"]


@pytest.mark.parametrize(("high", "told"), [(700.0, False), (900.0, True)])
def test_an_upper_end_that_few_tests_leave_open_is_explained(high, told):
    data = fit_curve.of_answer(fit())
    data["measured_force_interval"].loc[{"bound": "high"}] = 1e-9 * high
    assert (FEW in fit_sentences(data)) is told
