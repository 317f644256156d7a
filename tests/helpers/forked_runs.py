"""Run programs in forks of this process, which have loaded all packages but the library."""

import ast
import importlib
import logging
import multiprocessing
import os
import runpy
import subprocess
import sys
import tempfile
import threading
import traceback
import warnings
from pathlib import Path
from types import SimpleNamespace

import pytest


def run_forked(function, *arguments):
    """Return the result of a function in a fork of this process, which it cannot change."""
    context = multiprocessing.get_context("fork")
    receiver, sender = context.Pipe(duplex=False)
    process = context.Process(target=lambda: sender.send(function(*arguments)))
    process.start()
    sender.close()
    try:
        return receiver.recv()
    except EOFError:
        pytest.fail("the process ended without a result; see above what it printed")
    finally:
        process.join()


def use_library_of(folder):
    """Forget the library that this process has loaded, and work in a folder with its own."""
    names = [name for name in sys.modules if name.startswith(("hardcontact", "snakemake_logger"))]
    for name in names:
        del sys.modules[name]
    sys.path.insert(0, str(Path(folder, "workflow")))
    os.chdir(folder)


def run_program(folder, module, words, environment):
    """Run the `main` of a module in a folder with its own library, with words as its arguments.

    Returns the exit code and the text of output and errors.
    """
    (run,) = run_programs(folder, module, [words], environment)
    return run


def run_programs(folder, module, runs, environment, load=lambda: None):
    """Return the result of `run_program` for several runs, each a list of words.

    `load` loads parts of the library once for all runs.
    """
    importlib.import_module(module)  # Its packages are loaded once for all runs.

    def run_each():
        use_library_of(folder)
        load()
        return [run_captured(module, words, environment) for words in runs]

    return run_forked(run_each)


def run_captured(module, words, environment):
    """Run the `main` of a module in a fork; return the exit code and the text."""
    with tempfile.TemporaryFile() as output:
        code = run_forked(call_main, module, words, environment, output.fileno())
        output.seek(0)
        return SimpleNamespace(returncode=code, stdout=output.read().decode())


def call_main(module, words, environment, output):
    """Run the `main` of a module with output to a file descriptor; return the exit code."""
    sys.dont_write_bytecode = False  # The next run in this folder need not compile again.
    os.environ.update(environment)
    for descriptor in (1, 2):
        os.dup2(output, descriptor)
    sys.stdout = sys.stderr = open_output()
    if shell := sys.modules.get("snakemake.shell"):
        shell.STDOUT = None  # Jobs write to the same output, not where pytest captures.
    # A job whose fork comes while another thread writes to pytest's log would wait for it forever.
    logging.getLogger().handlers.clear()
    sys.argv = [module, *words]
    warnings.resetwarnings()
    warnings.simplefilter("ignore")
    try:
        return importlib.import_module(module).main() or 0
    except SystemExit as end:
        if isinstance(end.code, str):
            print(end.code)
            return 1
        return end.code or 0


def open_output():
    """Return a new stream to the standard output of this process."""
    return open(1, "w", buffering=1, encoding="utf-8", closefd=False)


#: Packages that many jobs need, and that take a second to load.
JOB_PACKAGES = (
    "snakemake.cli", "matplotlib.pyplot", "matplotlib.backends.backend_pdf",
    "matplotlib.backends.backend_svg", "scipy.stats", "SurfaceTopography",
)  # fmt: skip


def load_job_packages():
    """Load JOB_PACKAGES in this process, from which forks have them."""
    for name in JOB_PACKAGES:
        importlib.import_module(name)


def fork_jobs():
    """Let Snakemake run scripts in forks of this process, not in a Python that starts for each.

    A fork has the packages of this process, and what its script and earlier ones import.
    """
    from snakemake.benchmark import benchmarked
    from snakemake.script import PythonScript

    lock = threading.Lock()

    def execute_script(script, path, edit=False):
        with lock:  # A fork during an import would wait for its end forever.
            for node in ast.parse(script.source).body:
                if isinstance(node, ast.ImportFrom):
                    importlib.import_module(node.module)
            job = os.fork()
        if job == 0:
            run_script(path)
        with benchmarked(job, script.bench_record):
            _, status = os.waitpid(job, 0)
        if status:
            raise subprocess.CalledProcessError(os.waitstatus_to_exitcode(status), path)

    PythonScript.execute_script = execute_script


def run_script(path):
    """Run a script, then end this process, without its exit handlers."""
    # Another thread may have held the lock of the inherited stream during the fork.
    sys.stdout = sys.stderr = open_output()
    code = 1
    try:
        runpy.run_path(path, run_name="__main__")
        code = 0
    except SystemExit as end:
        code = end.code or 0
    except BaseException:
        traceback.print_exc()
    finally:
        sys.stdout.flush()
        os._exit(code)
