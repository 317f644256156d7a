"""Run Snakemake in a separate process that has already loaded the other packages."""

import multiprocessing
import os
import shutil
import sys
from pathlib import Path

import pytest
from repository import PARTS


def forked(function, *arguments):
    """Return the result of a function in a separate process, which starts without the library."""
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


def forget_library():
    """Forget the library that this process has loaded."""
    for name in [name for name in sys.modules if name.partition(".")[0] == "hardcontact"]:
        del sys.modules[name]


def linked_copy(finished, folder):
    """Copy the sources of a finished study, to be changed, and link its results."""
    (folder / "tests").mkdir(parents=True)
    for name in PARTS:
        copy = shutil.copytree if (finished / name).is_dir() else shutil.copy2
        copy(finished / name, folder / name)
    for name in ("results", ".snakemake"):
        (folder / name).symlink_to(finished / name)
    return folder


def run_here(folder, *arguments):
    """Run Snakemake in this process, in a folder with its own library; return its output."""
    from snakemake.cli import main

    os.chdir(folder)
    forget_library()
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
