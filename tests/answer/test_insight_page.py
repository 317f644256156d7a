"""The page on what decides the band: every part with question, answer and figure."""

import pytest
from figure_inputs.published_tables import published_constants
from figure_inputs.registry import INPUTS
from figure_inputs.scales import band
from html_page import Page
from paper_study import png
from refusals import assert_says

from hardcontact.answer.captions import Caption
from hardcontact.answer.insight_page import PARTS, AnsweredPart, insight_page
from hardcontact.figures.catalogue import OF_INSIGHT

HOSTILE = 'a < b & "c" <script>alert(1)</script>'


def made_page(text="Said.", substitutes=("UNCD", "NCD")):
    parts = {
        name: AnsweredPart(
            part.question,
            [f"{text} {name}", text],
            f"{text} Of the band: {name}.",
            png((90, 90, 90)),
            Caption(text, text),
        )
        for name, part in PARTS.items()
    }
    return insight_page(parts, substitutes, 0.9, published_constants(), band())


def test_every_figure_of_the_chapter_has_a_part_in_its_order():
    assert list(PARTS) == list(OF_INSIGHT)
    questions = [part.question for part in PARTS.values()]
    assert all(question.endswith("?") for question in questions)
    assert len(set(questions)) == len(questions)
    datasets = [figure.datasets for figure in OF_INSIGHT.values()]
    assert datasets == [(name.removeprefix("fig_"),) for name in OF_INSIGHT]


def test_the_page_shows_question_answer_and_figure_of_each_part():
    html = made_page()
    shown = Page(html)
    assert shown.texts["h2"] == [part.question for part in PARTS.values()]
    assert shown.texts["strong"] == [f"Said. {name}" for name in PARTS]
    assert len(shown.values("src")) == len(PARTS)
    assert all(source.startswith("data:image/png;base64,") for source in shown.values("src"))
    assert {link[1:] for link in shown.values("href")} == set(PARTS) <= set(shown.values("id"))
    opening = shown.texts["p"][0].replace("\u00a0", " ")
    assert_says(opening, "from 60 [42, 90] nm to 1.67 [1.17, 2.5] µm; of each, polished UNCD 160 [")
    assert_says(opening, "to no edge; UNCD 32 [", "The paper finds those from 43 nm to 1.8 µm")
    assert opening.endswith("intervals of 90 %.")
    assert shown.texts["p"][1].startswith("Substitute surfaces: UNCD and NCD.")


def test_what_a_part_means_for_the_band_opens_the_page_and_closes_the_part():
    shown = Page(made_page())
    for name, part in PARTS.items():
        said = f"Said. Of the band: {name}."
        assert f"{part.question} {said}" in shown.texts["li"]
        assert f"For the band. {said}" in shown.texts["p"]


def test_measured_surfaces_are_not_called_substitutes():
    assert Page(made_page(substitutes=())).texts["p"][1] == "All surfaces are measured."


def test_what_parts_say_is_text_not_markup():
    assert "script" not in Page(made_page(HOSTILE, [HOSTILE])).attributes


@pytest.mark.parametrize("name", PARTS)
def test_a_part_answers_in_sentences_from_its_datasets(name):
    (dataset,) = OF_INSIGHT[name].datasets
    given = [INPUTS[one]() for one in (dataset, *PARTS[name].beside)]
    sentences = PARTS[name].sentences(*given)
    assert len(sentences) >= 3
    for sentence in (*sentences, PARTS[name].of_band(*given)):
        assert sentence[0].isupper() and sentence.endswith(".")
        assert not {"nan", "inf", "None"} & set(sentence.replace("[", " ").split())
