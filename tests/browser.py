"""Pages as a headless browser shows them, where one is installed."""

import json
import re
import shutil
import subprocess
from html import escape, unescape

import pytest

BROWSER = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "chrome"))), None)
OPTIONS = [
    "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
    "--disable-background-networking", "--disable-component-update", "--disable-sync",
    "--host-resolver-rules=MAP * ~NOTFOUND",
]  # fmt: skip
needs_browser = pytest.mark.skipif(BROWSER is None, reason="no browser is installed")

#: Measures each frame when all are loaded, and leaves the measures in the document.
PROBE = """<script>onload = () => { document.body.dataset.shown = JSON.stringify(
  [...document.querySelectorAll("iframe")].map(frame => {
    const page = frame.contentDocument, root = page.documentElement
    return {
      overflow: root.scrollWidth - root.clientWidth,
      pictures: [...page.images].filter(one => one.complete && one.naturalWidth).length,
      requests: frame.contentWindow.performance.getEntriesByType("resource")
        .filter(one => !one.name.startsWith("data:")).length,
      seconds: performance.now() / 1000,
    }})) }</script>"""


def shown(html, folder, widths=(390, 1200)):
    """Open a page at each width (pixels), without network, and return what was measured."""
    frames = "".join(
        f'<iframe width="{width}" height="844" style="border: 0" srcdoc="{escape(html)}"></iframe>'
        for width in widths
    )
    probe = folder / "probe.html"
    probe.write_text(f'<!DOCTYPE html><meta charset="utf-8"><body>{frames}{PROBE}</body>', "utf-8")
    command = [BROWSER, *OPTIONS, f"--user-data-dir={folder / 'profile'}", "--dump-dom"]
    made = subprocess.run(
        [*command, probe.as_uri()], capture_output=True, text=True, timeout=120, check=True
    )
    found = re.search(r'<body data-shown="(.*?)">', made.stdout)
    return json.loads(unescape(found[1]))
