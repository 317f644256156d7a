"""Captions as plain text: the configuration in its places, no markup left."""

import pytest
from docutils.utils import SystemMessage
from jinja2 import UndefinedError
from refusals import assert_says, refusal
from repository import PAPER, ROOT

from hardcontact.answer.captions import caption
from hardcontact.figures.catalogue import FIGURES, OF_PAPER

CONFIDENCE = '{% set share = 100 * snakemake.config["inference"]["confidence"] %}\n'


def test_a_caption_names_the_values_of_the_study():
    template = (
        CONFIDENCE + "**Fig. 1.** Its {{ '%g' | format(share) }} %\ninterval.\n\nFrom\n``a.nc``."
    )
    shown = caption(template, {"inference": {"confidence": 0.8}})
    assert shown == ("Fig. 1", "Its 80 % interval.", "From a.nc.")


@pytest.mark.parametrize("name", FIGURES)
def test_captions_of_figures_have_a_title_and_no_markup(name):
    shown = caption((ROOT / f"workflow/report/{name}.rst").read_text(), PAPER)
    assert shown.short and 10 < len(shown.title) < 80
    assert not any(mark in " ".join(shown) for mark in ("{", "}", "**", "``", "\n"))


@pytest.mark.parametrize("name", OF_PAPER)
def test_captions_of_the_story_are_short_and_have_more(name):
    shown = caption((ROOT / f"workflow/report/{name}.rst").read_text(), PAPER)
    assert 20 < len(shown.short.split()) <= 60 and shown.more


@pytest.mark.parametrize("template", ["No title.", "The **title** late.", ""])
def test_a_caption_without_a_title_is_refused(template):
    assert_says(refusal(caption, template, {}), "expected", "in bold", "found")


def test_a_key_that_is_not_there_is_an_error():
    with pytest.raises(UndefinedError, match="confidence"):
        caption(CONFIDENCE, {"inference": {}})


@pytest.mark.filterwarnings("ignore")
def test_what_is_no_markup_is_an_error(capsys):
    with pytest.raises(SystemMessage, match="Inline strong"):
        caption("**Fig. 1: no end", {})
