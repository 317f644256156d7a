"""The tiny study's datasets are labelled and described, also beside a measured scan."""

import numpy as np
import pytest
import xarray as xr
from comparison import undescribed_variables
from own_studies import uncd_heights
from paper_numbers import SUBSTRATES
from repository import run_tiny_study
from scan_files import write_scan

from hardcontact.base.arrays import generator
from hardcontact.base.dataset import read_dataset
from hardcontact.surfaces.height_map import HeightMap
from hardcontact.surfaces.levelling import level_plane


def test_substitutes_are_labelled(results, finished):
    final = {path.stem: read_dataset(path) for path in results.glob("*.nc")}
    surfaces = {name: data for name, data in final.items() if "source" in data}
    assert surfaces.keys() >= {"topography", "adhesion", "filtered_forces", "fit", "edges"}
    for name, data in surfaces.items():
        assert set(data.source.values.ravel()) <= {"substitute"}, name
    assert set(SUBSTRATES) <= set(final["adhesion"].surface.values)
    store = finished / "results" / "store-tiny"
    maps = [path for kind in ("scans", "mirrored", "masters")
            for path in store.glob(f"{kind}/**/*.nc")]  # fmt: skip
    assert maps
    for path in maps:
        with xr.open_dataset(path) as data:
            assert data.attrs["source"] == "substitute", path


def test_every_variable_of_the_study_has_a_unit_and_a_meaning(results):
    # The numbers of claims stand in one variable, each in the unit of its claim.
    assert undescribed_variables(results) == [("sets", "value")]
    text = (results / "datasets.md").read_text("utf-8")
    assert {f"## {path.name}" for path in results.glob("*.nc")} <= {*text.splitlines()}


# A measured scan among substitutes

TABLE = """\
surface\tlabel\tscan\tsource\tpath\tdataset
uncd\tmy UNCD\t1\tmeasured\tmine.nc\t
mcd\tMCD\t1\tsubstitute\tresources/spectra/mcd.csv\t
mcd\tMCD\t2\tsubstitute\tresources/spectra/mcd.csv\t
ruby\truby\t1\tsubstitute\tresources/spectra/ruby.csv\t
"""
OWN = {
    "study": "own", "surfaces": "own.tsv", "indent": {"surface": "uncd"},
    "substitutes": {"featured_surface": "none"},
}  # fmt: skip


def test_a_study_may_have_an_own_scan_among_substitutes(finished_copy):
    folder = finished_copy  # with the scans of the substitutes
    (folder / "own.tsv").write_text(TABLE)
    heights = uncd_heights(generator(1), rms=3.0)
    write_scan(folder / "mine.nc", heights.T, (2500.0, 2500.0))
    run = run_tiny_study(folder, "topography", "adhesion", overlays=[OWN])
    assert run.returncode == 0, run.stdout[-3000:]
    topography, adhesion = (
        read_dataset(folder / f"results/own/{name}.nc") for name in ("topography", "adhesion")
    )
    uncd = topography.sel(surface="uncd")
    assert uncd.source == "measured" and topography.source.sel(surface="mcd") == "substitute"
    levelled_rms = level_plane(HeightMap(heights, 2500 / 128)).heights.std()
    np.testing.assert_allclose(uncd.rms_height, [levelled_rms, np.nan], rtol=1e-5)
    assert uncd.scan_size == pytest.approx(2500)
    force = adhesion.pull_off_force
    scan_force = force.sel(surface="uncd", scan=1, sphere_scan=1)
    rigid, plastic = (scan_force.sel(contact_model=model) for model in ("rigid", "plastic"))
    assert (rigid > 0).all() and (plastic >= rigid).all()
    assert force.sel(surface="uncd", scan=2).isnull().all()
    assert force.sel(surface="mcd", sphere_scan=1).notnull().all()
