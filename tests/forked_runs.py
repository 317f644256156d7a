"""Snakemake, run within a process of its own in which the other packages are loaded already."""

import multiprocessing
import os
import shutil
import sys
from pathlib import Path

import pytest
from repository import PARTS


def forked(function, *arguments):
    """Return what a function returns in a process of its own, which starts without the library."""
    context = multiprocessing.get_context("fork")
    ours, theirs = context.Pipe()
    process = context.Process(target=lambda: theirs.send(function(*arguments)))
    process.start()
    theirs.close()
    try:
        return ours.recv()
    except EOFError:
        pytest.fail("the process ended without a result; see above what it printed")
    finally:
        process.join()


def without_library():
    """Forget the library that this process has loaded."""
    for name in [name for name in sys.modules if name.partition(".")[0] == "hardcontact"]:
        del sys.modules[name]


def linked_copy(finished, folder):
    """Copy what a finished study needs, to be changed, beside links to its results."""
    folder.mkdir()
    for part in PARTS:
        copy = shutil.copytree if (finished / part).is_dir() else shutil.copy2
        copy(finished / part, folder / part)
    for part in ("results", ".snakemake"):
        (folder / part).symlink_to(finished / part)
    return folder


def run_here(folder, *arguments):
    """Run Snakemake in this process, in a folder with its own library; return what it printed."""
    from snakemake.cli import main

    os.chdir(folder)
    without_library()
    sys.path.insert(0, str(folder / "workflow"))
    sys.stdout = sys.stderr = open("output", "w", buffering=1)
    code = 0
    try:
        main(list(arguments))
    except SystemExit as error:
        code = error.code
    text = Path("output").read_text()
    assert not code, f"{text}{code}"
    return text
