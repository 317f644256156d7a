"""The page in a browser without network, on a phone and on a desk: all fits, all pictures show."""

import json
import os
import re
import shutil
import subprocess
from html import escape, unescape

import pytest
from answer_inputs import datasets, fit, open_edges, setting, topography

from hardcontact.answer.own_surfaces import answer

pytestmark = pytest.mark.system

BROWSERS = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
OPTIONS = [
    "--headless", "--hide-scrollbars", "--disable-gpu", "--disable-quic", "--no-first-run",
    "--disable-background-networking", "--disable-component-update", "--disable-sync",
    "--host-resolver-rules=MAP * ~NOTFOUND", "--virtual-time-budget=20000", "--dump-dom",
]  # fmt: skip
WIDTHS = (390, 1200)

#: Widths and pictures of each frame, written into the document when all frames have loaded.
LOOK = """
<script>
addEventListener("load", () => {
  const found = [...document.querySelectorAll("iframe")].map(frame => {
    const page = frame.contentDocument, root = page.documentElement;
    const images = [...page.images];
    return {
      screen: root.clientWidth,
      content: root.scrollWidth,
      furthest: Math.max(...[...page.querySelectorAll("body *")].map(
        element => element.getBoundingClientRect().right)),
      images: images.length,
      loaded: images.filter(image => image.complete && image.naturalWidth > 0).length,
      narrowest: Math.min(...images.map(image => image.clientWidth)),
      smallest: Math.min(...[...page.querySelectorAll("p, td, li, figcaption, small")].map(
        element => parseFloat(page.defaultView.getComputedStyle(element).fontSize))),
    };
  });
  const result = document.createElement("pre");
  result.textContent = JSON.stringify(found);
  document.body.append(result);
});
</script>
"""

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


def seen(page, folder):
    """What a browser without network makes of a page at each of WIDTHS."""
    browser = next(filter(None, map(shutil.which, BROWSERS)), None)
    if browser is None:
        pytest.skip(f"no browser found: {', '.join(BROWSERS)}")
    frames = "".join(
        f'<iframe width="{width}" height="900" style="border: 0" srcdoc="{escape(page)}"></iframe>'
        for width in WIDTHS
    )
    wrapper = folder / "wrapper.html"
    wrapper.write_text(f"<!DOCTYPE html><html><body>{frames}{LOOK}</body></html>", "utf-8")
    as_root = ["--no-sandbox"] if os.geteuid() == 0 else []  # which the browser asks of root
    command = [browser, *OPTIONS, *as_root, f"--user-data-dir={folder / 'profile'}"]
    run = subprocess.run(
        [*command, wrapper.as_uri()], capture_output=True, text=True, timeout=120, check=True
    )
    found = re.findall(r"<pre>(.*?)</pre>", run.stdout, re.DOTALL)
    assert found, run.stderr[-2000:]
    return json.loads(unescape(found[-1]))


@pytest.mark.parametrize("case", CASES)
def test_page_fits_every_screen_and_shows_its_pictures(case, tmp_path):
    page = CASES[case]().page
    frames = seen(page, tmp_path)
    assert [frame["screen"] for frame in frames] == list(WIDTHS)
    for frame in frames:
        assert frame["content"] <= frame["screen"], frame
        assert frame["furthest"] <= frame["screen"], frame
        assert frame["loaded"] == frame["images"] == page.count("<img ") > 4, frame
        assert frame["narrowest"] > 0.85 * min(frame["screen"], 400), frame
        assert frame["smallest"] >= 12, frame


def test_a_page_that_is_too_wide_is_seen(tmp_path):
    wide = '<body><p style="width: 600px">wide</p><img src="data:image/png;base64,aaaa"></body>'
    phone, desk = seen(wide, tmp_path)
    assert phone["content"] > phone["screen"] and desk["content"] <= desk["screen"]
    assert phone["images"] == 1 and phone["loaded"] == 0
