"""Studies of your surfaces: small scans in files of microscopes, and commands on them."""

import json

import numpy as np
from forked_runs import run_program
from measurements import random_map
from repository import environment, run_snakemake
from scan_files import write_nanoscope

#: Height in nm of an integer of a Nanoscope file.
HEIGHT_STEP = 0.1
#: Range of adhesion in nm of your forces: a computed one.
RANGE = 5.6
#: Work of adhesion in J/m² of your forces.
WORK = 0.05


def run_new(folder, *arguments):
    """Run `hardcontact new` in a folder, a copy of the repository."""
    words = ["new", *map(str, arguments)]
    return run_program(folder, "hardcontact.commands.command_line", words, environment(folder))


def run_quick(folder, name, *arguments, overlays=(), run=run_snakemake):
    """Run the study of config/NAME.yaml at quick effort, with further overlays (paths)."""
    files = [f"config/{name}.yaml", *overlays]
    return run(folder, *arguments, "--configfile", *map(str, files), "--config", "effort=quick")


def make_study(folder, name, *arguments, **options):
    """Make and run a study of files, with options of `run_quick`; return the folder of results."""
    new = run_new(folder, name, *arguments)
    assert new.returncode == 0, new.stdout
    run = run_quick(folder, name, **options)
    assert run.returncode == 0, run.stdout[-3000:]
    return folder / "results" / f"{name}-quick"


def read_answer(results):
    """Return the answer of a study as its answer.json has it."""
    return json.loads((results / "answer.json").read_text("utf-8"))


def read_quantities(results):
    """Return the quantities of an answer by surface, "" for the whole study, and name."""
    surfaces = {}
    for row in read_answer(results)["quantities"]:
        surfaces.setdefault(row["surface"], {})[row["name"]] = row
    return surfaces


def uncd_heights(rng, pixels=128, size=2500.0, rms=None):
    """Return heights (y, x) in nm of UNCD's spectrum, scaled to an rms height if it is given."""
    heights = random_map(rng, pixels, size / pixels).heights
    return heights if rms is None else heights * rms / heights.std()


def write_spm(path, heights, size):
    """Write heights (y, x) in nm on square pixels as a Nanoscope file; size (nm) along x."""
    rows, columns = heights.shape
    return write_nanoscope(path, np.round(heights / HEIGHT_STEP), (size, size * rows / columns))


def forces_on(adhesion, surface, rng):
    """Return 40 log-normal forces (µN) whose mean is that of a surface at RANGE and WORK."""
    surface_forces = adhesion.pull_off_force.sel(surface=surface, contact_model="plastic")
    mean = WORK * float(surface_forces.sel(rho=RANGE, method="nearest").mean()) * 1e6
    return mean * np.exp(rng.normal(-(0.5**2) / 2, 0.5, size=40))
