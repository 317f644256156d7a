"""The page in a browser without network: all fits and shows, tables and curves can be used."""

import csv

import numpy as np
import pytest
from answer_inputs import datasets, fit, open_edges, setting, topography
from browser import WIDTHS, needs_browser, shown, used

from hardcontact.answer.own_answer import own_answer
from hardcontact.answer.own_page import own_page

pytestmark = [pytest.mark.system, needs_browser]

LONG = "scans/" + "a-very-long-name-of-a-scan-" * 5 + "1.spm"


def with_long_names(data):
    """Files with names longer than a phone is wide."""
    spectra = data.spectra
    paths = spectra["path"].astype(object)
    paths[:] = LONG
    return data._replace(spectra=spectra.assign(path=paths.astype(str)))


def made_page(given, of=None):
    return own_page(own_answer(given, of or setting()))


CASES = {
    "one surface": lambda: made_page(
        with_long_names(datasets(edges=open_edges(), fit=fit())),
        setting([(LONG, "the reason why this part was left out " * 3)]),
    ),
    "two surfaces": lambda: made_page(
        datasets(2, topography=topography(2, "substitute"), fit=fit(2))
    ),
}


@pytest.mark.parametrize("case", CASES)
def test_page_fits_every_screen_and_shows_its_pictures(case, tmp_path):
    page = CASES[case]()
    frames = shown(page, tmp_path)
    assert [frame["screen"] for frame in frames] == list(WIDTHS)
    for frame in frames:
        assert frame["overflow"] == 0, frame
        # Scripts run, so that curves are drawn and their pictures left out.
        assert frame["loaded"] == frame["pictures"] == page.count('<div class="wide"><img'), frame
        assert frame["narrowest"] > 0.85 * min(frame["screen"], 400), frame
        assert frame["smallest"] >= 12, frame
        assert frame["requests"] == 0, frame


def test_a_page_that_is_too_wide_is_seen(tmp_path):
    wide = '<body><p style="width: 600px">wide</p><img src="data:image/png;base64,aaaa"></body>'
    phone, desk = shown(wide, tmp_path)
    assert phone["overflow"] > 0 and desk["overflow"] == 0
    assert phone["pictures"] == 1 and phone["loaded"] == 0


#: Sorts the first table by its first column, twice; downloads the ratios; reads them at a pointer.
USE = """
  const table = document.querySelector("table[data-name]"), sorted = [];
  const column = () => [...table.tBodies[0].rows].map(row => row.cells[0].textContent.trim());
  for (const _ of [1, 2]) {
    table.tHead.querySelector("button").click();
    sorted.push(column());
  }
  const figure = document.querySelector("figure.curve");
  let text;
  window.Blob = function (parts) { [text] = parts; };
  window.URL.createObjectURL = () => "#";
  [...figure.querySelectorAll("button")].find(one => one.textContent === "CSV").click();
  const over = figure.querySelector(".u-over"), place = over.getBoundingClientRect();
  const at = {clientX: place.left + 3, clientY: place.top + place.height / 2, bubbles: true};
  for (const kind of ["mouseenter", "mousemove"])
    over.dispatchEvent(new window.MouseEvent(kind, at));
  await new Promise(resolve => setTimeout(resolve, 100));
  const values = [...figure.querySelectorAll(".u-legend .u-value")].map(one => one.textContent);
  return {sorted, csv: text, values, name: figure.id};
"""


def test_tables_sort_and_curves_tell_and_give_their_values(tmp_path):
    given = datasets(edges=open_edges())
    told = used(made_page(given), USE, tmp_path)
    first, second = told["sorted"]
    assert sorted(first) == sorted(second) and first == second[::-1] and len(set(first)) > 2
    header, *rows = csv.reader(told["csv"].splitlines())
    cutoffs = [float(row[0]) for row in rows]
    # Under the pointer, at the left end, stands the value of the shortest cutoff.
    assert float(told["values"][0].split()[0]) == pytest.approx(min(cutoffs), rel=5e-3)
    ratios = given.edges.scale_ratio.isel(surface=0)
    known = np.unique(ratios.values[np.isfinite(ratios.values)])
    columns = range(1, len(header), 3)  # a value, and both ends of its interval
    downloaded = np.unique([float(row[at]) for row in rows for at in columns if row[at]])
    np.testing.assert_allclose(downloaded, known, rtol=1e-4)
