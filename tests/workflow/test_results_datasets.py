"""The tiny study's datasets are labelled, and the same seed gives the same values."""

import numpy as np
import pytest
import xarray as xr
from paper_numbers import SUBSTRATES
from repository import copy_repository, run_snakemake
from small_study import TINY_PATTERNS

from hardcontact.base import dataset


@pytest.fixture(scope="module")
def final(results):
    """Return the final datasets by name."""
    return {path.stem: dataset.read(path) for path in sorted(results.glob("*.nc"))}


def test_substitutes_are_labelled(final, finished):
    surfaces = {name: data for name, data in final.items() if "basis" in data}
    assert surfaces.keys() >= {"topography", "adhesion", "scales", "fit", "edges"}
    for name, data in surfaces.items():
        assert set(data.basis.values.ravel()) <= {"substitute"}, name
    assert set(SUBSTRATES) <= set(final["adhesion"].surface.values)
    store = finished / "results" / "store-tiny"
    maps = [path for kind in ("scans", "stitched", "masters")
            for path in store.glob(f"{kind}/**/*.nc")]  # fmt: skip
    assert maps
    for path in maps:
        with xr.open_dataset(path) as data:
            assert data.attrs["basis"] == "substitute", path


def test_forces_are_positive_and_complete(results):
    force = dataset.read(results / "adhesion.nc").pull_off_force
    assert np.isfinite(force).all() and (force > 0).all()
    assert force.sizes["contact_y"] == force.sizes["contact_x"] == 6
    rigid, plastic = (force.sel(contact_model=model) for model in ("rigid", "plastic"))
    assert (plastic >= rigid).all()


# The same seed, the same values


def values_of(folder):
    """Bytes of every variable of the scans and spectra in a store."""
    return {
        (path.relative_to(folder).as_posix(), name): variable.values.tobytes()
        for kind in ("spectra", "scans", "stitched")
        for path in folder.glob(f"{kind}/**/*.nc")
        for name, variable in dataset.read(path).variables.items()
    }


def test_the_same_seed_gives_the_same_values(finished, tmp_path):
    folder = copy_repository(tmp_path / "again")
    rows = {"uncd": (1, "flat"), "ruby": (2, "sphere-R250um")}
    scans = [
        TINY_PATTERNS.stitched.format(surface=surface, scan=scan, shape=shape)
        for surface, (scan, shape) in rows.items()
    ]
    run = run_snakemake(folder, *scans)
    assert run.returncode == 0, run.stdout[-3000:]
    reference_values, repeated_values = (
        values_of(study_folder / "results/store-tiny") for study_folder in (finished, folder)
    )
    assert {f"{TINY_PATTERNS.store}/{path}" for path, _ in repeated_values} >= set(scans)
    assert all(reference_values[key] == values for key, values in repeated_values.items())
