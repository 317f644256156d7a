"""Mutated files of a user give a result or one clear line per problem, in a short time."""

import random
import re
import time

import numpy as np
import pytest
from repository import DESCRIPTION_HEADER, ROOT
from scan_files import MAP_WRITERS, write_nanoscope
from SurfaceTopography import Topography

from hardcontact.config.descriptions import refuse_description
from hardcontact.config.force_table import read_forces
from hardcontact.config.selected_surfaces import surface_table
from hardcontact.own.own_spectrum import read_own_spectrum
from hardcontact.scans.reading import list_scans, read_scan
from hardcontact.surfaces.substitute_spectra import described_rms_height

NUMBER = re.compile(rb"\d+")
#: Bytes that replace a number, or are inserted anywhere.
NASTY = [
    b"", b"-1", b"0", b"nan", b"inf", b"1e400", b"1e-400", b"9" * 5000, b"2026-01-01", b"2.5",
    b"\0", b"\xff", b"\xef\xbb\xbf", b"\x1b[31m", b"\r", b"\n", b"\t", b'"', b"'", b",", b"{",
    b"[" * 1000, b"*a", b"&a ", b"- ", b": ", b"!!python/object ", b"<x>", "\u2028\u202e".encode(),
    b"x" * 10**5,
]  # fmt: skip


def mutate(content, rng):
    """Return the content after at most five changes of a bit, a piece or a number."""
    content = bytearray(content)
    for _ in range(rng.choice([1, 1, 2, 5])):
        position = rng.randrange(len(content) + 1)
        length = rng.choice([0, 1, 8, 100])
        match rng.choice(["flip", "cut", "number", "nasty", "repeat", "zero", "end"]):
            case "flip" if position < len(content):
                content[position] ^= 1 << rng.randrange(8)
            case "cut":
                content[position : position + length] = b""
            case "number" if numbers := [*NUMBER.finditer(content)]:
                number = rng.choice(numbers)
                content[number.start() : number.end()] = rng.choice(NASTY)
            case "nasty":
                content[position:position] = rng.choice(NASTY)
            case "repeat":
                content[position:position] = content[position : position + length] * rng.choice(
                    [1, 100]
                )
            case "zero":
                content[position : position + length] = bytes(length)
            case "end":
                content[position:] = b""
    return bytes(content)


def scan_contents(folder):
    """Return small scans in several formats, and real scans if there are any, by file name."""
    heights = np.random.default_rng(1).standard_normal((20, 20))
    topography = Topography(heights, (200.0, 200.0), unit="nm")
    for kind, write in MAP_WRITERS.items():
        write(topography, folder / f"a.{kind}")
    write_nanoscope(folder / "a.di", (10 * heights).astype(int), (200, 200))
    paths = [*folder.iterdir(), *(ROOT / "../shared/scans").glob("*.[dz]i*")]
    return {path.name: path.read_bytes() for path in sorted(paths)}


def read_scans(path):
    for dataset in list_scans(path):
        read_scan(path, dataset, undefined_pixels="harmonic")


def text_contents(folder):
    """Return matrices, one with decimal commas, and points with gaps, by file name."""
    heights = np.random.default_rng(1).standard_normal((20, 20))
    y, x = np.indices(heights.shape) / 100
    points = np.column_stack([x.ravel(), y.ravel(), heights.ravel()])[9:]
    np.savetxt(folder / "a.csv", heights, "%.4f", ",")
    np.savetxt(folder / "b.csv", heights, "%.4f", ";")
    np.savetxt(folder / "a.xyz", points, "%.4f", header="Höhe", encoding="latin-1")
    files = {path.name: path.read_bytes() for path in sorted(folder.iterdir())}
    return files | {"b.csv": files["b.csv"].replace(b".", b",")}


SPECTRUM = "wavelength,wavelength_unit,c_iso,c_iso_unit\n" + "".join(
    f"{10 ** (1 + k / 9):.4g},nm,{100 * 10 ** (k / 3):.4g},nm4\n" for k in range(19)
)
DESCRIPTION = (
    f"{DESCRIPTION_HEADER}inf,10,self-affine,1e7,1000,0.8,,,published,none\n"
    "10,1,power law,,,0.8,,,assumed,none\n"
)


def read_description(path):
    refuse_description(path, set())
    described_rms_height(path, 4000.0)


#: Kinds of input: functions that return whole contents by file name, and that read a file.
KINDS = {
    "scan": (scan_contents, read_scans),
    "text": (
        text_contents,
        lambda path: read_scan(path, undefined_pixels="harmonic", unit="um,nm", map_size=200.0),
    ),
    "spectrum": (lambda _: {"a.csv": SPECTRUM.encode()}, lambda path: read_own_spectrum([path])),
    "forces": (
        lambda _: {"a.csv": b"surface,value,unit\na,1,uN\nb,2.5,nN\na,3,uN\n"},
        lambda path: read_forces(path, ["a", "b"], 250e3),
    ),
    "description": (lambda _: {"a.csv": DESCRIPTION.encode()}, read_description),
    "surfaces": (
        lambda _: {
            "a.tsv": b"surface\tlabel\tscan\tsource\tpath\tdataset\n"
            + f"a\tA\t1\tmeasured\t{__file__}\t\na\tA\t2\tmeasured\t{random.__file__}\t\n".encode()
        },
        surface_table,
    ),
}


@pytest.mark.filterwarnings("ignore::RuntimeWarning")  # Mutated heights overflow.
@pytest.mark.parametrize("kind", KINDS)
def test_every_damaged_file_is_read_or_refused_in_clear_lines(tmp_path, kind):
    whole_contents, read_file = KINDS[kind]
    (tmp_path / "whole").mkdir()
    contents = whole_contents(tmp_path / "whole")
    rng, refusals = random.Random(2026), 0
    for number in range(20):
        name = rng.choice(sorted(contents))
        path = tmp_path / f"{number}-{name}"
        path.write_bytes(mutate(contents[name], rng))
        start = time.monotonic()
        try:
            read_file(path)
        except ValueError as error:
            refusals += 1
            lines = str(error).splitlines()
            assert lines and all("expected" in line for line in lines), path
            assert all(line.isprintable() and len(line) < 3000 for line in lines), path
        assert time.monotonic() - start < 20, path
        path.unlink()
    assert refusals > 0
