"""Hostile scans: nothing is executed or unpacked, and whatever a reader does ends in one line."""

import io
import json
import multiprocessing
import os
import pickle
import signal
import struct
import time
import zipfile
from functools import partial
from pathlib import Path

import h5py
import numpy as np
import pytest
import yaml
from refusals import assert_says, refusal
from scan_files import heights, scan

from hardcontact.surfaces import scan_formats, scans


class Payload:
    """Something whose unpickling makes a folder."""

    def __init__(self, path):
        self.path = path

    def __reduce__(self):
        return os.mkdir, (str(self.path),)


def archive(path, files):
    """Write a zip archive: name -> content."""
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as target:
        for name, content in files.items():
            target.writestr(name, content)
    return path


def meta(member, **other):
    """A container's meta.yml with one scan, called one."""
    entry = {"name": "one", "datafile": {"original": member}, "size": [320, 320], "unit": "nm"}
    return yaml.safe_dump({"surfaces": [{"topographies": [entry | other]}]})


def container(path, member, content):
    return archive(path, {"meta.yml": meta(member), member: content})


def text(values):
    lines = io.StringIO()
    np.savetxt(lines, values)
    return lines.getvalue()


def objects(payload):
    """A height map whose pixels are to be unpickled."""
    return np.array([[payload] * 32] * 32, object)


def pickled(path, payload):
    path.write_bytes(pickle.dumps(objects(payload)))


def array(path, payload):
    with open(path, "wb") as file:
        np.save(file, objects(payload), allow_pickle=True)


def arrays(path, payload):
    with open(path, "wb") as file:
        np.savez(file, h=objects(payload))


def array_in_container(path, payload):
    array(path, payload)
    container(path, "a.npy", path.read_bytes())


def yaml_with_a_call(path, payload):
    call = f"!!python/object/apply:os.mkdir [{payload.path}]"
    archive(path, {"meta.yml": f"surfaces: [{{topographies: [{call}]}}]"})


@pytest.mark.parametrize("write", [pickled, array, arrays, array_in_container, yaml_with_a_call])
def test_nothing_in_a_file_is_executed(tmp_path, write):
    payload = Payload(tmp_path / "made")
    write(tmp_path / "a.dat", payload)
    for member in ("", "one"):
        message = refusal(scans.read_scan, tmp_path / "a.dat", member)
        assert_says(message, "a.dat: expected", "found")
    assert not payload.path.exists()
    pickle.loads(pickle.dumps(payload))
    assert payload.path.is_dir()  # as it would have been


@pytest.mark.parametrize("name", ["../outside.txt", "/tmp/outside.txt", "a/../../outside.txt"])
def test_nothing_of_an_archive_is_written(tmp_path, monkeypatch, name):
    folder = tmp_path / "a" / "b"
    folder.mkdir(parents=True)
    monkeypatch.chdir(folder)
    path = container(folder / "a.zip", name, text(heights(32, 32)))
    height_map = scans.read_scan(path, "one")
    assert height_map.heights.shape == (32, 32) and height_map.pixel_size == pytest.approx(10)
    assert [file for file in tmp_path.rglob("*") if file.is_file()] == [path]
    assert not Path("/tmp/outside.txt").exists()


def declaring(path, size):
    """Let the last file of an archive declare another size once unpacked."""
    content = bytearray(path.read_bytes())
    struct.pack_into("<I", content, content.rindex(b"PK\1\2") + 24, size)
    path.write_bytes(content)


def encrypted(path):
    """Let the last file of an archive claim to be encrypted."""
    content = bytearray(path.read_bytes())
    content[content.rindex(b"PK\1\2") + 8] |= 1
    path.write_bytes(content)


@pytest.mark.parametrize("member", ["", "one"])  # an archive of no known kind, and a container
def test_archives_are_held_against_limits_before_they_are_read(tmp_path, member):
    files = {"a.txt": text(heights(32, 32))} | ({"meta.yml": meta("a.txt")} if member else {})
    path = tmp_path / "a.zip"
    for change, part in (
        (lambda: declaring(path, 2**31), "bytes once unpacked"),
        (lambda: encrypted(path), "without a password"),
    ):
        archive(path, files)
        change()
        assert_says(refusal(scans.read_scan, path, member), "a.zip: expected", part)
    with pytest.warns(UserWarning, match="Duplicate"), zipfile.ZipFile(path, "w") as target:
        for name in (*files, "a.txt"):
            target.writestr(name, "1 2 3")
    assert_says(refusal(scans.read_scan, path, member), "each file once")


def repeated(member, count):
    """A meta.yml in which many scans have one data file."""
    (entry,) = yaml.safe_load(meta(member))["surfaces"][0]["topographies"]
    entries = [entry | {"name": f"scan {number}"} for number in range(count)]
    return json.dumps({"surfaces": [{"topographies": entries}]})


ALIASES = "a0: &a0 [x]\n" + "".join(
    f"a{k}: &a{k} [{', '.join([f'*a{k - 1}'] * 9)}]\n" for k in range(1, 12)
)


def aliased(key):
    """A meta.yml with one scan, of which this key is a list of 9^11 letters."""
    entry = f"{{name: one, datafile: {{original: a.txt}}, size: [320, 320], {key}: *a11}}"
    return ALIASES + f"surfaces: [{{topographies: [{entry}]}}]\n"


@pytest.mark.parametrize(
    ("content", "part"),
    [
        (" ".join(map(str, range(2**18))), "meta.yml of at most 1048576 bytes"),
        (ALIASES + "surfaces: *a11\n", "lists surfaces"),
        (ALIASES + "surfaces: [{topographies: [{name: *a11, datafile: 1}]}]\n", "lists surfaces"),
        ("surfaces: &a\n- topographies: *a\n", "lists surfaces"),
        ("[" * 1200, "lists surfaces"),
        ("surfaces: [{topographies: [{name: &n one}]}]\n---\nb: *n", "lists surfaces"),
        ("", "lists surfaces"),
        (b"\xff\xfe\x00", "lists surfaces"),
        (meta("a.txt", size=[float("inf")] * 2), "2 positive numbers"),
        (meta("a.txt", size=[320.0]), "2 positive numbers"),
        (meta("a.txt", size=[1e30] * 2), "pixels and differences of height"),
        (meta("a.txt", size=[-1, -1]), "2 positive numbers"),
        (meta("a.txt", height_scale=-1), "a positive height scale"),
        (meta("a.txt", height_scale=float("nan")), "a positive height scale"),
        (meta("a.txt", data_source=99), "a data_source from 0 to 0"),
        (repeated("a.txt", 3000), "a.txt 3000 times"),
        (meta("a.txt", height_scale=1e30), "pixels and differences of height"),
        (meta("a.txt", height_scale=1e6), "a mean slope of at most 10"),
        (meta("b\n\033[31m.txt"), "no printable text"),
        (meta("b.txt"), "the data file b.txt"),
        (meta(["a.txt"]), "lists surfaces"),
        (meta("a.txt", size="large"), "the size of a.txt"),
        (meta("a.txt", size=["1", "1"]), "the size of a.txt"),
        (meta("a.txt", unit={"nm": 1}), "the unit of a.txt"),
        (aliased("unit"), "the unit of a.txt"),
        (aliased("description"), "the description of a.txt"),
    ],
)
def test_descriptions_of_a_container_are_data(tmp_path, content, part):
    path = archive(tmp_path / "a.zip", {"meta.yml": content, "a.txt": text(heights(32, 32))})
    assert_says(refusal(scans.read_scan, path, "one"), "a.zip: expected", "found", part)


def test_index_json_is_read_before_meta_yml(tmp_path):
    index = json.dumps(yaml.safe_load(meta("b.txt")))
    files = {"meta.yml": meta("a.txt"), "index.json": index, "b.txt": text(heights(32, 32))}
    path = archive(tmp_path / "a.zip", files)
    assert scans.list_measurements(path) == ["b.txt"]
    np.testing.assert_allclose(scans.read_scan(path, "one").heights, heights(32, 32))
    for damaged in ("", "[" * 100_000, "[1]", '{"surfaces": 1}'):
        archive(path, files | {"index.json": damaged})
        for read in (scans.list_measurements, scans.read_measurement):
            assert_says(refusal(read, path), "a.zip: expected index.json that lists surfaces")


def test_a_container_in_a_container_is_no_scan(tmp_path):
    inner = container(tmp_path / "inner.zip", "a.txt", text(heights(32, 32)))
    path = container(tmp_path / "a.zip", "inner.zip", inner.read_bytes())
    assert_says(refusal(scans.read_scan, path, "one"), "none of its readers takes")


@pytest.mark.parametrize("pixels", [8, 8193, 10**6])
def test_declared_pixels_are_held_against_limits_before_they_are_read(tmp_path, pixels):
    with h5py.File(tmp_path / "a.h5", "w") as file:
        file.create_dataset("h", (pixels, pixels), "f8", chunks=(8, 8))
    path = container(tmp_path / "a.zip", "a.h5", (tmp_path / "a.h5").read_bytes())
    message = refusal(scans.read_scan, path, "one")
    assert_says(message, "16 to 8192 pixels along an edge", f"found {pixels} x {pixels}")


def test_large_files_are_refused_unread(tmp_path):
    with open(tmp_path / "a.di", "wb") as file:
        file.truncate(2**30 + 1)
    assert_says(refusal(scans.read_scan, tmp_path / "a.di"), "at most 1073741824 bytes")


def of_virtual(file, outside):
    layout = h5py.VirtualLayout((32, 32), "f8")
    layout[:] = h5py.VirtualSource(outside, "h", (32, 32))
    file.create_virtual_dataset("h", layout)


def of_external_storage(file, outside):
    place = [(str(outside), 0, h5py.h5f.UNLIMITED)]
    file.create_dataset("h", (32, 32), "f8", external=place)


def of_a_link(file, outside):
    file["e"] = h5py.ExternalLink(outside, "/")
    file["h"] = h5py.SoftLink("/e/h")


@pytest.mark.parametrize("write", [of_virtual, of_external_storage, of_a_link])
def test_no_other_file_is_read(tmp_path, write):
    with h5py.File(tmp_path / "outside.h5", "w") as file:
        file["h"] = heights(32, 32)
    with h5py.File(tmp_path / "a.h5", "w") as file:
        write(file, tmp_path / "outside.h5")
    container(tmp_path / "a.zip", "a.h5", (tmp_path / "a.h5").read_bytes())
    for path, member in (("a.h5", ""), ("a.zip", "one")):
        message = refusal(scans.read_scan, tmp_path / path, member)
        assert_says(message, f"{path}: expected heights in this file", "in another one")


def of_many_groups(path):
    with h5py.File(path, "w") as file:
        for number in range(1001):
            file.create_group(str(number))


def of_many_levels(path):
    with h5py.File(path, "w") as file:
        file.create_group("a/" * 2000)


def of_many_files(path):
    archive(path, {str(number): "" for number in range(5001)})


def of_many_scans(path):
    entries = [{"datafile": {"original": f"{number}.txt"}} for number in range(3000)]
    archive(path, {"index.json": json.dumps({"surfaces": [{"topographies": entries}]})})


def that_inflates(path):
    archive(path, {"a.npy": bytes(2**24)})


def with_an_archive_that_inflates(path):
    that_inflates(path)
    container(path, "a.npz", path.read_bytes())


def that_lies(path):
    container(path, "a.txt", bytes(2**26))
    declaring(path, 1000)


def of_another_compression(path):
    with zipfile.ZipFile(path, "w", zipfile.ZIP_LZMA) as target:
        target.writestr("a.txt", text(heights(32, 32)))


@pytest.mark.parametrize(
    ("write", "part"),
    [
        (of_many_groups, "at most 1000 groups"),
        (of_many_levels, "20 levels"),
        (of_many_files, "at most 5000 files"),
        (of_many_scans, "at most 1000 scans"),
        (that_inflates, "200 times those of the archive"),
        (with_an_archive_that_inflates, "200 times those of the archive"),
        (that_lies, "Bad CRC-32"),
        (of_another_compression, "stored or deflated"),
        (os.mkfifo, "no regular file"),
    ],
)
def test_what_would_take_long_is_refused_at_once(tmp_path, write, part):
    path = tmp_path / "a.zip"
    write(path)
    start = time.monotonic()
    message = refusal(lambda: [*map(partial(scans.read_scan, path), scans.list_measurements(path))])
    assert_says(message, "a.zip: expected", part)
    assert time.monotonic() - start < 5  # on a machine with other work; alone it takes 0.3 s


def crash(_path):
    os.kill(os.getpid(), signal.SIGSYS)


def loop(_path):
    while True:
        pass


def hoard(_path):
    return bytearray(2**31)


def chatter(_path):
    os.write(1, b"reader was here")
    os.write(2, b"reader was here")
    raise RuntimeError("two\nlines \033[31m")


def test_small_files_take_little_memory(tmp_path, monkeypatch):
    monkeypatch.setattr(scan_formats, "open_topography", lambda _path: bytearray(2**30))
    assert_says(refusal(scans.read_scan, scan(tmp_path / "a.nc")), "MemoryError")


def test_what_a_terminal_would_obey_is_no_name_of_a_channel(tmp_path):
    with h5py.File(tmp_path / "a.h5", "w") as file:
        file["\033[31mh"] = heights(32, 32)
    path = container(tmp_path / "a.zip", "a.h5", (tmp_path / "a.h5").read_bytes())
    assert scans.read_measurement(path, "one").channel == " [31mh"


@pytest.mark.parametrize(
    ("reader", "part"),
    [
        (crash, "whose reader crashes"),
        (loop, "takes more than 1 s"),
        (hoard, "MemoryError"),
        (chatter, "(RuntimeError: two lines [31m)"),
    ],
)
def test_whatever_a_reader_does(tmp_path, monkeypatch, capfd, reader, part):
    monkeypatch.setattr(scan_formats, "open_topography", reader)
    monkeypatch.setattr(scans, "TIME_LIMIT", 1)
    monkeypatch.setattr(scans, "MEMORY_LIMIT", 2**30)
    monkeypatch.chdir(tmp_path)
    start = time.monotonic()
    message = refusal(scans.read_scan, scan(tmp_path / "a.nc"))
    assert_says(message, "a.nc: expected a readable scan, found", part)
    assert time.monotonic() - start < 30
    assert capfd.readouterr() == ("", "")
    assert [path.name for path in tmp_path.iterdir()] == ["a.nc"]
    assert multiprocessing.active_children() == []
