"""The quick study's datasets: units, origin, physics; the same seed, the same values."""

import numpy as np
import pytest
import xarray as xr
from paper_numbers import SUBSTRATES
from repository import copy_repository, run_snakemake
from small_study import QUICK_PATTERNS

from hardcontact.base import dataset
from hardcontact.contact.contact import Contact


@pytest.fixture(scope="module")
def final(results):
    """Return the final datasets by name."""
    return {path.stem: dataset.read(path) for path in sorted(results.glob("*.nc"))}


def test_every_number_has_a_unit(final):
    missing_units = [
        (name, key)
        for name, data in final.items()
        for key, variable in data.variables.items()
        if variable.dtype.kind == "f"
        and "units" not in variable.attrs
        and (name, key) != ("sets", "value")  # of claims, each in its own unit
    ]
    assert final.keys() >= {"topography", "adhesion", "scales", "inference", "band"}
    assert missing_units == []


def test_datasets_say_where_they_come_from(final):
    keys = {"title", "history", "parameters", "versions", "code_digest", "input_digests"}
    assert {name: keys - data.attrs.keys() for name, data in final.items()} == dict.fromkeys(
        final, set()
    )


def test_substitutes_are_labelled(final, finished):
    surfaces = {name: data for name, data in final.items() if "basis" in data}
    assert surfaces.keys() >= {"topography", "adhesion", "scales", "inference", "band"}
    for name, data in surfaces.items():
        assert set(data.basis.values.ravel()) <= {"substitute"}, name
    assert set(SUBSTRATES) <= set(final["adhesion"].surface.values)
    store = finished / "results" / "store-quick"
    maps = [path for kind in ("scans", "stitched", "masters", "substitutes")
            for path in store.glob(f"{kind}/**/*.nc")]  # fmt: skip
    assert maps
    for path in maps:
        with xr.open_dataset(path) as data:
            assert data.attrs["basis"].startswith("substitute"), path


def test_forces_are_positive_and_complete(results):
    force = dataset.read(results / "adhesion.nc").pull_off_force
    assert np.isfinite(force).all() and (force > 0).all()
    assert force.sizes["contact_y"] == force.sizes["contact_x"] == 6
    rigid, plastic = (force.sel(contact_model=model) for model in ("rigid", "plastic"))
    assert (plastic >= rigid).all()


def test_elastic_contacts_carry_the_preload(results):
    data = dataset.read(results / "elastic.nc")
    load = data.contact_area * 1e-18 * data.mean_pressure
    np.testing.assert_allclose(load, data.attrs["preload"], rtol=1e-5)
    assert (data.peak_pressure >= data.mean_pressure).all()
    assert ((0 <= data.share_above_hardness) & (data.share_above_hardness <= 1)).all()
    assert (data.rigid_pull_off_force > 0).all() and (data.elastic_pull_off_force > 0).all()
    # The pressure drawn is that of the first contact on a surface's first scan, about its peak.
    peak = data.peak_pressure.isel(scan=0, contact=0)
    np.testing.assert_array_equal(data.pressure.max(["y", "x"]), peak)


def test_indents_grow_with_the_load_and_the_one_drawn_is_the_median(results):
    data = dataset.read(results / "indent.nc")
    assert (data.depth.diff("preload") > 0).all()
    assert (data.lateral_size >= data.edge_length).all() and (data.indent_count >= 1).all()
    pixel = float(data.x.diff("x").mean())
    for preload in data.preload.values:
        contact_pixels = Contact(
            radius=data.sphere_radius, preload=preload, hardness=data.hardness
        ).pixels(pixel)
        largest = np.rint((data.edge_length.sel(preload=preload) / pixel) ** 2)
        assert (largest + data.indent_count.sel(preload=preload) - 1 <= contact_pixels).all()
        assert ((data.indent_count.sel(preload=preload) == 1) <= (largest == contact_pixels)).all()
    deepest = data.preload.max()
    depths = np.sort(data.depth.sel(preload=deepest).values, axis=None)
    assert data.indentation.sel(preload=deepest).max() == depths[depths.size // 2]


def test_one_or_two_asperities_carry_the_share_that_is_looked_at(results):
    data = dataset.read(results / "asperities.nc")
    assert (data.largest_share <= data.two_largest_share).all() and (data.extent > 0).all()
    for patches, name in ((1, "largest_share"), (2, "two_largest_share")):
        patch_data = data[name].where(data.patch_count <= patches, drop=True)
        assert patch_data.size and (patch_data.fillna(1) >= data.attrs["share"] - 1e-9).all()
    assert (data.two_largest_share < 1).all() and (data.patch_count >= 1).all()


# The same seed, the same values


def values_of(folder):
    """Bytes of every variable of the scans and spectra in a store."""
    return {
        (path.relative_to(folder).as_posix(), name): variable.values.tobytes()
        for kind in ("spectra", "substitutes", "scans", "stitched")
        for path in folder.glob(f"{kind}/**/*.nc")
        for name, variable in dataset.read(path).variables.items()
    }


def test_the_same_seed_gives_the_same_values(finished, tmp_path):
    folder = copy_repository(tmp_path / "again")
    rows = {"uncd": (1, "flat"), "ruby": (2, "sphere-R250um")}
    scans = [
        QUICK_PATTERNS.stitched.format(surface=surface, variant="study", scan=scan, shape=shape)
        for surface, (scan, shape) in rows.items()
    ]
    run = run_snakemake(folder, *scans)
    assert run.returncode == 0, run.stdout[-3000:]
    reference_values, repeated_values = (
        values_of(study_folder / "results/store-quick") for study_folder in (finished, folder)
    )
    assert {f"{QUICK_PATTERNS.store}/{path}" for path, _ in repeated_values} >= set(scans)
    assert all(reference_values[key] == values for key, values in repeated_values.items())
