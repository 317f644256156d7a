"""What the page of the paper's study is made from, small: claims, datasets, figures, captions."""

from functools import cache
from io import BytesIO

import numpy as np
import yaml
from figure_inputs.scales import band, scales
from figure_inputs.scan_size import scan_size
from figure_inputs.sets import sets
from figure_inputs.surfaces import topography
from paper_claims import CONSTANTS, STATEMENTS
from PIL import Image
from repository import ROOT

from hardcontact.answer.captions import Caption
from hardcontact.answer.paper_answer import paper_answer, paper_page
from hardcontact.claims.evaluation import COLUMNS
from hardcontact.claims.verdicts import VERDICTS
from hardcontact.figures.catalogue import OF_PAPER

CITATION = yaml.safe_load((ROOT / "CITATION.cff").read_text("utf-8"))
DEPARTURES = "# Where it departs\n\n1. **First.** 1 < 2.\n\n## Substitutes\n\nRandom surfaces.\n"


def claims():
    """Every statement of the paper, each with numbers of its own and one verdict after another."""
    numbers = np.arange(len(STATEMENTS)) + 1.0
    return STATEMENTS.assign(
        computed=1.01 * numbers,
        low=np.where(numbers % 3, 0.9 * numbers, np.nan),
        high=np.where(numbers % 3, 1.1 * numbers, np.nan),
        frequency=np.where(numbers % 3, 0.58, np.nan),
        stability=np.where(numbers % 3, 0.9, np.nan),
        verdict=[VERDICTS[number % len(VERDICTS)] for number in range(len(STATEMENTS))],
        basis="substitute scans",
    )[list(COLUMNS)]


@cache
def datasets(contacts=20, pixels=512):
    """The datasets that the page takes numbers from, not to be changed; the band has two edges."""
    maps = ("surface", "row"), np.zeros((5, pixels))
    return {
        "topography": topography().drop_dims("row").assign(example_heights=maps),
        "scales": scales().assign(pull_off_force=("contact_y", np.ones(contacts))),
        "band": band(),
        "sets": sets(),
        "scan_size": scan_size(),
    }


def answer(rows=None, **changed):
    """The answer of the study, of other claims or datasets if they are given."""
    return paper_answer(claims() if rows is None else rows, datasets() | changed, CONSTANTS)


def png(colour, size=(12, 8)):
    """A picture of one colour."""
    written = BytesIO()
    Image.new("RGB", size, colour).save(written, "PNG")
    return written.getvalue()


def figures():
    """A picture for each figure of the study, each of another colour."""
    return {name: png((20 * place, 0, 0)) for place, name in enumerate(OF_PAPER)}


def captions():
    """A caption for each figure."""
    return {
        name: Caption(f"Of {name}: a < b", f"It shows {name}: 1 < 2.", "And more.")
        for name in OF_PAPER
    }


def made_page(of=None, departures=DEPARTURES):
    """The page."""
    return paper_page(answer() if of is None else of, figures(), captions(), departures, CITATION)
