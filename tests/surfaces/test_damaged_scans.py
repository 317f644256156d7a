"""Damaged scans in bulk: a valid map or one clear line, bounded, silent, nothing left behind."""

import io
import json
import os
import random
import re
import subprocess
import sys
import zipfile
from collections import Counter
from pathlib import Path

import numpy as np
import pytest
from refusals import assert_says
from repository import ROOT

from hardcontact.surfaces.scans import read_scan

SCANS = ROOT / "../shared/scans"
AFM, CONTAINER = SCANS / "afm-10um-512.di", SCANS / "uncd-demo-container.zip"
MEMBER = "gain_control_uncd_35.001"
HEADER, TEXT = 40960, 14000  # bytes before the data of AFM, and those of them that are not zero
NUMBER = re.compile(rb"-?\d+\.?\d*(?:e[+-]?\d+)?")
NUMBERS = [
    b"", b"abc", b"0", b"-1", b"nan", b"inf", b"1e30", b"1e-30", b"1e200", b"1e400", b"65536",
    b"4294967296", b"999999999999", b"512 " * 2000,
]  # fmt: skip
ENTRIES = [
    b"Samps/line", b"Number of lines", b"Scan Size", b"Data offset", b"Data length",
    b"Bytes/pixel", b"@2:Z scale", b"@Sens. Zsens", b"Version", b"Date",
]  # fmt: skip
EXTENSIONS = ["di", "spm", "nc", "txt", "npy", "npz", "mat", "sur", "x3p", "h5", "zip", "gwy"]

#: Reads the scans named on its standard input and prints what became of each, with its memory
#: limited far below what the mutants declare.
WORKER = """
import json, resource, sys, time
from hardcontact.surfaces.scans import read_scan
resource.setrlimit(resource.RLIMIT_AS, (3 << 30, 3 << 30))
for line in sys.stdin:
    path, member = json.loads(line)
    start = time.monotonic()
    try:
        scan = read_scan(path, member)
        height = float(abs(scan.heights).max())
        outcome = {"pixels": scan.heights.shape, "pixel": scan.pixel_size, "height": height}
    except ValueError as error:
        outcome = {"refused": str(error)}
    print(json.dumps(outcome | {"path": path, "seconds": time.monotonic() - start}), flush=True)
"""


def flipped(content, rng, first, last, count):
    """The content with `count` bits flipped between two offsets."""
    content = bytearray(content)
    for _ in range(count):
        content[rng.randrange(first, last)] ^= 1 << rng.randrange(8)
    return bytes(content)


def without(content, rng):
    """The content without some bytes from its middle."""
    start = rng.randrange(len(content))
    return content[:start] + content[start + rng.randrange(1, 5000) :]


def renumbered(content, rng, first=0, last=None):
    """The content with one number between two offsets replaced by a huge or wrong one."""
    number = rng.choice(list(NUMBER.finditer(content, first, last or len(content))))
    return content[: number.start()] + rng.choice(NUMBERS) + content[number.end() :]


def redeclared(content, rng):
    """A Nanoscope file that declares another size, offset, scale or version."""
    entry = rng.choice(ENTRIES)
    line = rng.choice(list(re.finditer(rb"\\" + re.escape(entry) + rb": [^\r]*\d", content)))
    return renumbered(content, rng, line.start() + len(entry), line.end())


def repacked(content, change):
    """An archive with each file changed by `change(name, bytes)`."""
    target = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(content)) as old, zipfile.ZipFile(target, "w") as new:
        for name in old.namelist():
            new.writestr(name, change(name, old.read(name)), zipfile.ZIP_DEFLATED)
    return target.getvalue()


def mutants(afm, container):
    """Kind, extension and bytes of every mutant; equal in every run."""
    rng = random.Random(2021)
    for name, content in (("di", afm), ("zip", container)):
        yield "empty", name, b""
        for k in range(20):
            yield "truncated", name, content[: int((0.001 + k / 20.1) * len(content))]
        for _ in range(15):
            yield "cut", name, without(content, rng)
        for extension in EXTENSIONS:
            yield f"renamed {name}", extension, content
    for count in (1, 1, 1, 3, 10, 100):
        for _ in range(8):
            yield "header flipped", "di", flipped(afm, rng, 0, TEXT, count)
            yield "data flipped", "di", flipped(afm, rng, HEADER, len(afm), count)
            yield "archive flipped", "zip", flipped(container, rng, 0, len(container), count)
    for _ in range(60):
        yield "redeclared", "di", redeclared(afm, rng)
    for _ in range(20):
        start, length = rng.randrange(TEXT), rng.choice([1, 16, 4096])
        yield "zeroed", "di", afm[:start] + bytes(length) + afm[start + length :]
        yield "inserted", "di", afm[:start] + rng.randbytes(length) + afm[start:]
        yield (
            "meta.yml", "zip",
            repacked(container, lambda n, c: renumbered(c, rng) if n == "meta.yml" else c),
        )  # fmt: skip
        yield (
            "member", "zip",
            repacked(container, lambda n, c: redeclared(c, rng) if n.endswith(".001") else c),
        )  # fmt: skip


@pytest.fixture(scope="module")
def outcomes(tmp_path_factory):
    """What became of every mutant: a list of dicts; the worker leaves nothing in its folders."""
    if not SCANS.is_dir():
        pytest.skip("no folder ../shared/scans")
    folder = tmp_path_factory.mktemp("mutants")
    kinds, lines = {}, []
    for k, (kind, extension, content) in enumerate(
        mutants(AFM.read_bytes(), CONTAINER.read_bytes())
    ):
        path = folder / f"{k}.{extension}"
        path.write_bytes(content)
        kinds[str(path)] = kind
        container = extension == "zip" and kind != "renamed di" or kind == "renamed zip"
        lines.append(json.dumps([str(path), MEMBER if container else ""]))
    scratch = tmp_path_factory.mktemp("scratch")
    run = subprocess.run(
        [sys.executable, "-c", WORKER],
        cwd=scratch,
        env=os.environ | {"PYTHONPATH": str(ROOT / "workflow"), "TMPDIR": str(scratch)},
        input="\n".join(lines),
        text=True,
        capture_output=True,
        timeout=1500,
    )
    assert (run.returncode, run.stderr) == (0, "")
    assert list(scratch.iterdir()) == []
    results = [json.loads(line) for line in run.stdout.splitlines()]
    assert [outcome["path"] for outcome in results] == list(kinds)
    for path in kinds:
        os.unlink(path)
    return [outcome | {"kind": kinds[outcome["path"]]} for outcome in results]


@pytest.mark.study
def test_every_mutant_is_a_scan_or_one_clear_line(outcomes):
    assert len(outcomes) == 380
    for outcome in outcomes:
        assert outcome["seconds"] < 60, outcome
        if "refused" in outcome:
            assert_says(outcome["refused"], Path(outcome["path"]).name, "expected", "found")
            assert outcome["refused"].isprintable() and len(outcome["refused"]) < 600, outcome
            assert "Traceback" not in outcome["refused"]
        else:
            assert outcome["pixels"][0] == outcome["pixels"][1] <= 8192
            assert 1e-3 <= outcome["pixel"] <= 1e7 and outcome["height"] <= 1e7


@pytest.mark.study
def test_what_becomes_of_mutants_follows_from_what_was_done(outcomes):
    taken = Counter(outcome["kind"] for outcome in outcomes if "refused" not in outcome)
    count = Counter(outcome["kind"] for outcome in outcomes)
    for kind in ("empty", "truncated", "cut"):
        assert taken[kind] == 0
    for kind in ("renamed di", "renamed zip", "data flipped"):
        assert taken[kind] == count[kind]
    for kind in ("header flipped", "redeclared", "zeroed", "inserted", "meta.yml", "member"):
        assert 0 < taken[kind] < count[kind], (kind, taken[kind])


def test_bits_flipped_in_the_data_change_their_pixels_alone(tmp_path):
    if not SCANS.is_dir():
        pytest.skip("no folder ../shared/scans")
    path = tmp_path / "a.di"
    path.write_bytes(flipped(AFM.read_bytes(), random.Random(1), HEADER, HEADER + 2**19, 10))
    difference = read_scan(path).heights != read_scan(AFM).heights
    assert 0 < np.count_nonzero(difference) <= 10
