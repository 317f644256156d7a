"""Results that several files of tests look at: of the paper, and of own surfaces."""

import pandas as pd
import pytest
import xarray as xr
from own_studies import forces_on, made, new, quick, rough, spm
from repository import copy_repository

from hardcontact.numbers.random import generator


@pytest.fixture(scope="session")
def results(finished):
    """Return the results of the quick study; not to be changed."""
    return finished / "results" / "quick"


@pytest.fixture(scope="session")
def folder(tmp_path_factory):
    """Copy the repository, with a folder of scans, for all studies of own surfaces."""
    folder = copy_repository(tmp_path_factory.mktemp("own") / "study")
    (folder / "scans").mkdir()
    return folder


@pytest.fixture(scope="session")
def measured(folder):
    """Five scans each of two surfaces, on which forces were measured that follow RANGE and WORK."""
    surfaces = []
    for label, rms in (("bare", 4.0), ("coated", 15.0)):
        files = [folder / f"scans/{label}-{number}.001" for number in range(5)]
        for number, file in enumerate(files):
            spm(file, rough(generator(8, label, number), rms=rms), 2500.0)
        surfaces += ["--surface", label, *files]
    # Forces are known once the contacts are computed.
    assert new(folder, "pair", *surfaces).returncode == 0
    run = quick(folder, "pair", "adhesion")
    assert run.returncode == 0, run.stdout[-3000:]
    adhesion = xr.load_dataset(folder / "results/pair-quick/adhesion.nc")
    rng = generator(8, "tests")
    rows = [
        {"surface": surface, "value": f"{force:.4f}", "unit": "uN"}
        for surface in ("bare", "coated")
        for force in forces_on(adhesion, surface, rng)
    ]
    pd.DataFrame(rows).to_csv(folder / "my.csv", index=False)
    return made(folder, "pair", "--overwrite", *surfaces, "--forces", "my.csv")[0]


@pytest.fixture(scope="session")
def probe(folder):
    """A small probe on one scan."""
    spm(folder / "scans/probe.001", rough(generator(4), 128, 1000.0, 3.0), 1000.0)
    options = ["--radius", "5um", "--hardness", "5GPa", "--preload", "100nN", "--range", "2nm"]
    return made(folder, "probe", "scans/probe.001", *options, "--work", "30 mJ/m2")[0]
