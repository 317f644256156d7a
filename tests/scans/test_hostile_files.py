"""Hostile files are refused in one line; nothing is executed or written, no other file is read."""

import io
import json
import multiprocessing
import os
import signal
import struct
import time
import zipfile

import h5py
import numpy as np
import pytest
import yaml
from refusals import assert_says, refusal
from scan_files import random_heights, write_scan

from hardcontact.scans import reading


class Payload:
    """An object that makes a folder when it is unpickled."""

    def __init__(self, folder):
        self.folder = folder

    def __reduce__(self):
        return os.mkdir, (str(self.folder),)


def write_zip(path, files):
    """Write a zip archive: name -> content."""
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as target:
        for name, content in files.items():
            target.writestr(name, content)


def matrix_text(heights):
    lines = io.StringIO()
    np.savetxt(lines, heights)
    return lines.getvalue()


def meta_yml(dataset="a.txt", **changes):
    """Return the list of a container of one scan, called "one"."""
    entry = {"name": "one", "datafile": {"original": dataset}, "size": [320, 320], "unit": "nm"}
    return yaml.safe_dump({"surfaces": [{"topographies": [entry | changes]}]})


def write_one_scan(path, content, dataset="a.txt"):
    """Write a container of one scan with this content."""
    write_zip(path, {"meta.yml": meta_yml(dataset), dataset: content})


def list_writer(content):
    """Return a writer of a container of one good text, with this list of scans."""
    return lambda path: write_zip(
        path, {"meta.yml": content, "a.txt": matrix_text(random_heights())}
    )


def hdf5_writer(write_content, is_in_container):
    """Return a writer of an HDF5 file, alone or in a container."""

    def write_file(path):
        file = path.with_suffix(".h5") if is_in_container else path
        with h5py.File(file, "w") as target:
            write_content(target, path.parent / "outside.h5")
        if is_in_container:
            write_one_scan(path, file.read_bytes(), "a.h5")

    return write_file


def add_external_storage(file, outside_path):
    file.create_dataset("h", (32, 32), "f8", external=[(str(outside_path), 0, h5py.h5f.UNLIMITED)])


def add_external_link(file, outside_path):
    file["e"] = h5py.ExternalLink(outside_path, "/")
    file["h"] = h5py.SoftLink("/e/h")


def add_virtual_dataset(file, outside_path):
    layout = h5py.VirtualLayout((32, 32), "f8")
    layout[:] = h5py.VirtualSource(outside_path, "h", (32, 32))
    file.create_virtual_dataset("h", layout)


def add_too_many_pixels(file, _):
    file.create_dataset("h", (10**6, 10**6), "f8", chunks=(8, 8))


def write_pickled_array(path):
    with open(path, "wb") as file:
        payloads = np.array([[Payload(path.parent / "made")] * 32] * 32, object)
        np.save(file, payloads, allow_pickle=True)


#: Bytes from the start of an entry in the directory of a zip to its flags and to its file's size.
FLAGS_OFFSET, FILE_SIZE_OFFSET = 8, 24


def altered_zip_writer(offset, form, value):
    """Return a writer of a zip with a false value in the last entry of its directory."""

    def write_file(path):
        write_one_scan(path, bytes(2**20))
        content = bytearray(path.read_bytes())
        struct.pack_into(form, content, content.rindex(b"PK\1\2") + offset, value)
        path.write_bytes(content)

    return write_file


def write_huge_file(path):
    path.touch()
    os.truncate(path, reading.MAX_FILE_BYTES + 1)


#: Lists in YAML, a0 to a11, each nine times its predecessor: *a11 has 9^11 letters.
ALIASES = "a0: &a0 [x]\n" + "".join(
    f"a{k}: &a{k} [{', '.join([f'*a{k - 1}'] * 9)}]\n" for k in range(1, 12)
)
#: A list of one scan whose unit is such a list.
ALIASED_UNIT = ALIASES + (
    "surfaces: [{topographies: "
    "[{name: one, datafile: {original: a.txt}, size: [320, 320], unit: *a11}]}]\n"
)
MANY_SCANS = [{"datafile": {"original": f"{number}.txt"}} for number in range(3000)]
#: Writers of a file, and a part of its refusal.
HOSTILE = {
    "missing": (lambda path: None, "found no such file"),
    "empty": (lambda path: path.write_bytes(b""), "1 to 1073741824 bytes"),
    "folder": (os.mkdir, "found a folder"),
    "pipe": (os.mkfifo, "no regular file"),
    "device": (lambda path: path.symlink_to("/dev/zero"), "no regular file"),
    "huge": (write_huge_file, "1 to 1073741824 bytes"),
    "picture": (lambda path: path.write_bytes(b"P5\n2 2\n9\n" + bytes(4)), "a picture, whose grey"),
    "model": (lambda path: path.write_text("#VRML 2.0\n1 2 3 0 0 0\n"), "a model of triangles"),
    "values in volts": (
        lambda path: path.write_text("# Value units: V\n" + matrix_text(random_heights())),
        "values in V, which is no unit of length: multiply them",
    ),
    "words": (lambda path: path.write_text("sample,good\n" * 5000), "none of its readers takes"),
    "pickled array": (write_pickled_array, "data of type 'object'"),
    # Twice the memory that the test allows: the child may have some free memory at its start.
    "zip bomb": (lambda path: write_one_scan(path, bytes(2**27)), "MemoryError"),
    "lying zip": (altered_zip_writer(FILE_SIZE_OFFSET, "<I", 1000), "Bad CRC-32"),
    "encrypted zip": (altered_zip_writer(FLAGS_OFFSET, "<H", 1), "encrypted"),
    "container in a container": (
        lambda path: write_one_scan(path, meta_yml().encode(), "inner.zip"),
        "none of its readers takes",
    ),
    "pixels": (hdf5_writer(add_too_many_pixels, True), "16 to 8192 pixels per row"),
    "external storage": (hdf5_writer(add_external_storage, False), "open external raw data file"),
    "external link": (hdf5_writer(add_external_link, True), "none of its readers takes"),
    "virtual data": (hdf5_writer(add_virtual_dataset, False), "a readable scan"),
    "many scans": (
        list_writer(json.dumps({"surfaces": [{"topographies": MANY_SCANS}]})), "at most 1000 scans",
    ),
    "call in a list": (
        list_writer("surfaces: [{topographies: [!!python/object/apply:os.mkdir [made]]}]"),
        "lists surfaces",
    ),
    "aliases": (list_writer(ALIASES + "surfaces: *a11\n"), "lists surfaces"),
    "deep list": (list_writer("[" * 1200), "lists surfaces"),
    "aliased unit": (list_writer(ALIASED_UNIT), "a readable scan"),
    "no text": (list_writer(meta_yml(["a.txt"])), "lists surfaces"),
    "letters": (list_writer(meta_yml("b\n\033[31m.txt")), "a dataset that names one scan"),
    "size in words": (list_writer(meta_yml(size="long")), "2 positive numbers"),
    "unit of no length": (list_writer(meta_yml(unit="V")), "a unit of length"),
    "infinite size": (list_writer(meta_yml(size=[float("inf")] * 2)), "2 positive numbers"),
    "large size": (list_writer(meta_yml(size=[1e30] * 2)), "pixels and differences of height"),
    "no height scale": (list_writer(meta_yml(height_scale=float("nan"))), "positive height scale"),
    "steep heights": (list_writer(meta_yml(height_scale=1e6)), "a mean slope of at most 10"),
    "channel": (list_writer(meta_yml(data_source=99)), "a data_source from 0 to 0"),
}  # fmt: skip


def read_all_scans(path):
    for dataset in reading.list_scans(path):
        # Unit and size are given, so that no file is refused for lack of them.
        reading.read_scan(path, dataset, unit="nm", map_size=320.0)


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """Return a folder, also for temporary files, with a file that no scan may read."""
    with h5py.File(tmp_path / "outside.h5", "w") as file:
        file["h"] = random_heights()
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    monkeypatch.setattr("tempfile.tempdir", None)
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.parametrize("name", HOSTILE)
def test_a_hostile_file_is_refused_in_one_line(folder, monkeypatch, name):
    monkeypatch.setattr(reading, "SMALL_FILE_MEMORY", 2**26)
    monkeypatch.setattr(reading, "SMALL_FILE_SECONDS", 1)
    write, message_part = HOSTILE[name]
    path = folder / "a.zip"
    write(path)
    files_before = sorted(folder.rglob("*"))
    start = time.monotonic()
    message = refusal(read_all_scans, path)
    assert time.monotonic() - start < 60  # a few seconds of computing, on a busy machine
    assert message.isprintable() and len(message) < reading.MAX_MESSAGE_LENGTH + 500  # for the path
    assert_says(message, f"{path}: expected", "found", message_part)
    assert sorted(folder.rglob("*")) == files_before  # nothing unpacked, executed or left behind


def test_a_member_with_the_name_of_another_file_is_read_in_its_archive(folder):
    write_one_scan(folder / "a.zip", matrix_text(random_heights()), "../outside.txt")
    files_before = sorted(folder.parent.rglob("*"))
    np.testing.assert_allclose(reading.read_scan(folder / "a.zip", "one").heights, random_heights())
    assert sorted(folder.parent.rglob("*")) == files_before


def crash(_):
    os.kill(os.getpid(), signal.SIGSYS)


def loop(_):
    while True:
        pass


def hoard(_):
    return {"heights": np.ones(2**28)}


def write_a_file(_):
    with open(reading.__file__, "a"):
        return {}


def read_a_file(_):
    with open("/etc/hostname") as file:
        return {"text": file.read()}


def chatter(_):
    os.write(1, b"reader was here")
    os.write(2, b"reader was here")
    raise RuntimeError("two\nlines \033[31m")


@pytest.mark.parametrize(
    ("reader", "message_part"),
    [
        (crash, "whose reader stops"),
        (loop, "takes more than 1 s"),
        (hoard, "MemoryError"),
        # The child may open no file, so each open fails like this.
        (write_a_file, "Too many open files"),
        (read_a_file, "Too many open files"),
        (chatter, "(RuntimeError: two lines [31m)"),
    ],
)
def test_a_misbehaving_reader_is_stopped(folder, monkeypatch, capfd, reader, message_part):
    monkeypatch.setattr(reading, "MAX_SECONDS", 1)
    path = write_scan(folder / "a.nc")
    message = refusal(reading.read_in_child, reader, path)
    assert_says(message, "a.nc: expected a readable", "found", message_part)
    assert capfd.readouterr() == ("", "")
    assert multiprocessing.active_children() == []


def test_a_child_cannot_write_to_a_file_that_is_open(folder):
    with open(folder / "open.txt", "wb", buffering=0) as file:

        def write(_):
            file.write(b"reader was here")
            return {}

        assert_says(refusal(reading.read_in_child, write, write_scan(folder / "a.nc")), "OSError")
    assert (folder / "open.txt").read_bytes() == b""
