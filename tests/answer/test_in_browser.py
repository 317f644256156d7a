"""The page in a browser without network, on a phone and on a desk: all fits, all pictures show."""

import pytest
from answer_inputs import datasets, fit, open_edges, setting, topography
from browser import WIDTHS, needs_browser, shown

from hardcontact.answer.own_surfaces import answer

pytestmark = [pytest.mark.system, needs_browser]

LONG = "scans/" + "a-very-long-name-of-a-scan-" * 5 + "1.spm"


def with_long_names(data):
    """Files with names longer than a phone is wide."""
    spectra = data.spectra
    paths = spectra["path"].astype(object)
    paths[:] = LONG
    return data._replace(spectra=spectra.assign(path=paths.astype(str)))


CASES = {
    "one surface": lambda: answer(
        with_long_names(datasets(edges=open_edges(), fit=fit())),
        setting([(LONG, "the reason why this part was left out " * 3)]),
    ),
    "two surfaces": lambda: answer(
        datasets(2, topography=topography(2, "substitute"), fit=fit(2)), setting()
    ),
}


@pytest.mark.parametrize("case", CASES)
def test_page_fits_every_screen_and_shows_its_pictures(case, tmp_path):
    page = CASES[case]().page
    frames = shown(page, tmp_path)
    assert [frame["screen"] for frame in frames] == list(WIDTHS)
    for frame in frames:
        assert frame["overflow"] == 0, frame
        assert frame["loaded"] == frame["pictures"] == page.count("<img ") > 4, frame
        assert frame["narrowest"] > 0.85 * min(frame["screen"], 400), frame
        assert frame["smallest"] >= 12, frame
        assert frame["requests"] == 0, frame


def test_a_page_that_is_too_wide_is_seen(tmp_path):
    wide = '<body><p style="width: 600px">wide</p><img src="data:image/png;base64,aaaa"></body>'
    phone, desk = shown(wide, tmp_path)
    assert phone["overflow"] > 0 and desk["overflow"] == 0
    assert phone["pictures"] == 1 and phone["loaded"] == 0
