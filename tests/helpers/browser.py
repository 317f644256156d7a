"""Pages as a headless browser without network shows them, where one is installed."""

import json
import os
import re
import shutil
import subprocess
from html import escape, unescape
from importlib.resources import files

import pytest

BROWSER_NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome")
BROWSER = next(filter(None, map(shutil.which, BROWSER_NAMES)), None)
OPTIONS = [
    "--headless", "--hide-scrollbars", "--disable-gpu", "--disable-quic", "--no-first-run",
    "--disable-background-networking", "--disable-component-update", "--disable-sync",
    "--host-resolver-rules=MAP * ~NOTFOUND", "--virtual-time-budget=3000", "--dump-dom",
]  # fmt: skip
needs_browser = pytest.mark.skipif(BROWSER is None, reason="no browser is installed")
#: Widths of the screens of a phone and a desktop, and the height of the phone's, in pixels.
WIDTHS = (390, 1200)
HEIGHT = 844
#: Schemes of colours; the browser's setting `preferredColorScheme` is an index of them.
SCHEMES = ("dark", "light")

#: Measures the page in each frame when all are loaded, and leaves the measures, lengths in pixels,
#: in the document.
PROBE = """<script>onload = () => { document.body.dataset.shown = JSON.stringify(
  [...document.querySelectorAll("iframe")].map(frame => {
    const page = frame.contentDocument, root = page.documentElement, images = [...page.images]
    const texts = [...page.querySelectorAll("p, td, li, figcaption, small")]
    return {
      title: page.title,
      screen: root.clientWidth,
      overflow: root.scrollWidth - root.clientWidth,
      pictures: images.length,
      loaded: images.filter(image => image.complete && image.naturalWidth).length,
      smallestFont: Math.min(...texts.map(text => parseFloat(getComputedStyle(text).fontSize))),
      requests: frame.contentWindow.performance.getEntriesByType("resource")
        .filter(entry => !entry.name.startsWith("data:")).length,
    }})) }</script>"""


def measure_pages(pages, folder):
    """Open each page at each of WIDTHS, and return the measures of PROBE, page by page."""
    frames = "".join(
        f'<iframe width="{width}" height="{HEIGHT}" style="border: 0" srcdoc="{escape(html)}">'
        "</iframe>"
        for html in pages
        for width in WIDTHS
    )
    return _run_in_browser(frames + PROBE, folder)


def run_on_pages(actions, folder):
    """Open pages, act on each in turn by a script, and return the results.

    An action is a page and a script: the body of a function of the page's `document` and `window`
    that returns something for JSON.
    """
    pages = "".join(
        f'<iframe width="{WIDTHS[-1]}" height="{HEIGHT}" srcdoc="{escape(html)}"></iframe>'
        for html, _ in actions
    )
    functions = ", ".join(f"async (document, window) => {{{script}}}" for _, script in actions)
    act = f"""<script>onload = async () => {{
      const results = [];
      for (const [number, act] of [{functions}].entries()) {{
        const page = window.frames[number];
        results.push(await act(page.document, page));
      }}
      document.body.dataset.shown = JSON.stringify(results); }}</script>"""
    return _run_in_browser(pages + act, folder)


def audit_page(html, folder, scheme):
    """Return what axe finds at a page with nothing folded, in one of SCHEMES.

    The result has `dark`, whether the scheme is dark, the number of `passes`, rules that the page
    meets, and its `faults`.
    """
    axe = (files("axe_playwright_python") / "axe.min.js").read_text("utf-8")
    act = """<script>onload = async () => {
      document.querySelectorAll("details:not(.zoom)").forEach(fold => { fold.open = true; });
      const {passes, violations} = await axe.run();
      const dark = matchMedia("(prefers-color-scheme: dark)").matches;
      const faults = violations.map(fault => [fault.id, fault.nodes.map(node => node.html)]);
      const result = {dark, passes: passes.length, faults};
      document.body.dataset.shown = JSON.stringify(result); }</script>"""
    # The policy of a page forbids other scripts than its own.
    page = re.sub("<meta http-equiv.*?>", "", html)
    page = page.replace("</body>", f"<script>{axe}</script>{act}</body>")
    return _result_of_script(
        page, folder, f"--blink-settings=preferredColorScheme={SCHEMES.index(scheme)}"
    )


def _run_in_browser(body, folder):
    """Return the result that the script of a body leaves in it."""
    return _result_of_script(f'<!DOCTYPE html><meta charset="utf-8"><body>{body}</body>', folder)


def _result_of_script(document, folder, *options):
    """Return the result that a script of a document leaves in it."""
    probe = folder / "probe.html"
    probe.write_text(document, "utf-8")
    root_options = ["--no-sandbox"] if os.geteuid() == 0 else []  # root needs it
    command = [BROWSER, *OPTIONS, *options, *root_options, f"--user-data-dir={folder / 'profile'}"]
    run = subprocess.run(
        [*command, probe.as_uri()], capture_output=True, text=True, timeout=120, check=True
    )
    result = re.search(r'<body data-shown="(.*?)">', run.stdout)
    return json.loads(unescape(result[1]))
