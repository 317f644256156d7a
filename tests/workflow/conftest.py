"""Fixtures of studies of your surfaces that several files of tests share."""

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from own_studies import forces_on, make_study, run_new, run_quick, uncd_heights, write_spm
from repository import copy_repository, run_snakemake_with_forks
from scan_files import write_container, write_coordinates, write_scan
from shared_study import shared_study
from SurfaceTopography import UniformLineScan

from hardcontact.base.arrays import generator

#: How runs save time: by one realization of the masters, which is enough for the files of a study,
#: and by jobs as forks.
FAST = {"overlays": ["few.yaml"], "run": run_snakemake_with_forks}


def own_repository(folder):
    """Copy the repository into a folder, with a folder of scans; return the copy."""
    study = copy_repository(folder / "study")
    (study / "scans").mkdir()
    (study / "few.yaml").write_text("quick: {band: {masters: 1}}")
    return study


def write_scans(scans):
    """Write a rectangle and a line scan, a container of a map with gaps, and scans of a sphere."""
    write_spm(scans / "rectangle.001", uncd_heights(generator(1), 128, rms=3.0)[:96], 2000.0)
    profile = np.concatenate(uncd_heights(generator(2), 64, 20_000.0)[:8])
    write_coordinates(UniformLineScan(profile, 160_000.0, unit="nm"), scans / "line.txt")
    gaps = np.ma.masked_array(uncd_heights(generator(3), 128, rms=3.0).T, False)
    gaps[5:9, 40] = np.ma.masked
    write_scan(scans / "map.nc", gaps, (2500.0, 2500.0))
    entry = {"name": "map", "datafile": {"original": "map.nc"}}
    write_container(scans / "twin.zip", [entry], {"map.nc": scans / "map.nc"})
    x = (np.arange(128) - 63.5) * 2500 / 128
    shape = -(x[:, None] ** 2 + x**2) / (2 * 250e3)  # a sphere of the radius of the paper's
    for number in range(2):
        ball = shape + uncd_heights(generator(6, number), rms=2.0)
        write_spm(scans / f"ball-{number}.001", ball, 2500.0)


@pytest.fixture(scope="session")
def own_study(tmp_path_factory):
    """Return the repository with the study `several-quick`; not to be changed."""
    return shared_study(tmp_path_factory, study_of_all_file_kinds)


def study_of_all_file_kinds(folder):
    """Make a study of files of all kinds on a rough sphere, whose forces follow RANGE and WORK."""
    study = own_repository(folder)
    write_scans(study / "scans")
    choices = [
        "--surface", "My film", "scans/rectangle.001", "scans/line.txt",
        "--surface", "twin", "scans/twin.zip", "--tip", "5 nm",
        "--sphere", "scans/ball-0.001", "scans/ball-1.001", "--forces", "my.csv",
    ]  # fmt: skip
    write_forces(study, {"my_film": [1.0], "twin": [1.0]})
    done = run_new(study, "several", *choices)
    assert done.returncode == 0, done.stdout
    # Forces are known once the contacts are computed.
    run = run_quick(study, "several", "adhesion", **FAST)
    assert run.returncode == 0, run.stdout[-3000:]
    adhesion = xr.load_dataset(study / "results/several-quick/adhesion.nc")
    rng = generator(8, "tests")
    surfaces = adhesion.surface.values
    write_forces(study, {surface: forces_on(adhesion, surface, rng) for surface in surfaces})
    run = run_quick(study, "several", **FAST)
    assert run.returncode == 0, run.stdout[-3000:]
    return study


def write_forces(folder, forces):
    """Write a table of measured forces in µN, by surface."""
    rows = [
        {"surface": surface, "value": f"{force:.4f}", "unit": "uN"}
        for surface, surface_forces in forces.items()
        for force in surface_forces
    ]
    pd.DataFrame(rows).to_csv(folder / "my.csv", index=False)


@pytest.fixture(scope="session")
def probe(tmp_path_factory):
    """Return the results of a study of a small probe on one scan."""
    return shared_study(tmp_path_factory, study_of_a_small_probe) / "results/probe-quick"


def study_of_a_small_probe(folder):
    """Make a study of one scan of 1 µm under a sphere of 5 µm; return its folder."""
    study = own_repository(folder)
    write_spm(study / "scans/probe.001", uncd_heights(generator(4), 128, 1000.0, 3.0), 1000.0)
    options = ["--radius", "5um", "--hardness", "5GPa", "--preload", "100nN", "--range", "2nm"]
    options += ["--work", "30 mJ/m2"]
    make_study(study, "probe", "scans/probe.001", *options, **FAST)
    return study
