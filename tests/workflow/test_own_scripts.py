"""The scripts of own surfaces: files in, files out."""

import runpy
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from known_masters import LARGE, SMALL, scales
from known_spectra import rough
from repository import ROOT

from hardcontact.insight.summits import draw_size
from hardcontact.records import dataset
from hardcontact.records.origin import canonical
from hardcontact.surfaces.joined_spectrum import described_spectrum
from hardcontact.surfaces.spectrum import WAVEVECTORS, spectrum_dataset

CONTACTS = ("contact_y", "contact_x")
NAMES = {"label": ("surface", ["A", "B"]), "basis": ("surface", ["measured"] * 2)}


class Named(list):
    """Files or lists of them by name, and all by place, as Snakemake gives them."""

    def __init__(self, **files):
        super().__init__(np.hstack(list(files.values())).tolist())
        vars(self).update(files)


@pytest.fixture
def run(tmp_path, monkeypatch):
    """Run a script on files of the folder and return what it wrote."""
    monkeypatch.chdir(tmp_path)
    # A job that fails ends its process, which here is that of all tests.
    monkeypatch.setattr("hardcontact.records.job.os._exit", lambda code: pytest.fail("job failed"))

    def made(script, parameters, **inputs):
        snakemake = SimpleNamespace(
            input=Named(**inputs),
            output=Named(data="made.nc"),
            params=SimpleNamespace(canonical=canonical(parameters)),
            threads=1,
            log=["script.log"],
        )
        path = ROOT / f"workflow/scripts/{script}.py"
        runpy.run_path(str(path), {"snakemake": snakemake})
        return dataset.read("made.nc")

    return made


def adhesion():
    forces = np.exp(0.2 * np.random.default_rng(1).standard_normal((2, 3, 1, 2, 1, 4, 4)))
    forces = (
        forces * np.array([[1.0, 2.0, 4.0], [1.0, 1.2, 1.5]])[:, None, None, None, :, None, None]
    )
    dims = ("surface", "scan", "sphere_scan", "contact_model", "rho", *CONTACTS)
    return xr.Dataset(
        {"pull_off_force": (dims, 1e-6 * forces), **NAMES},
        {"surface": ["a", "b"], "contact_model": ["rigid", "plastic"], "rho": [1.0, 2.0, 4.0]},
        {"sphere_radius": 5e3},
    )


def topography():
    lengths = {"scan_size": 2500.0, "rms_height_mean": 2.0, "pixel_size": 20.0}
    return xr.Dataset(
        {name: ("surface", [value] * 2) for name, value in lengths.items()}, {"surface": ["a", "b"]}
    )


@pytest.fixture
def force(run):
    """Return the forces predicted from datasets, which it makes."""
    masters = scales([[SMALL, LARGE]] * 2).assign(transition=("side", [20.0, 4e3]))
    files = {
        "adhesion": adhesion(),
        "scales": masters.assign_attrs(rho=2.0),
        "topography": topography(),
        "spectra": xr.concat(
            [spectrum_dataset(rough().density)] * 2, pd.Index(["a", "b"], name="surface")
        ),
    }
    for name, data in files.items():
        dataset.write(data, f"{name}.nc")
    contact = {"preload": 1e-5, "hardness": 25e9, "window": 12_500.0, "count": 4}
    parameters = {
        "work": 0.05, "rho": 2.0, "radius": 5e3, "contact": contact, "confidence": 0.95,
        "scans": {"a": 1, "b": 1}, "tiles": 2, "tolerance": 0.1,
    }  # fmt: skip
    return run("predict_force", parameters, **{name: f"{name}.nc" for name in files})


def test_forces_are_predicted(force):
    assert force.force.sel(surface="a", rho=2.0).values == pytest.approx(1e-7, rel=0.2)
    assert force.attrs["work_of_adhesion"] == 0.05
    np.testing.assert_allclose(force.draw_size, draw_size(rough(), 5e3, 400.0))


def test_own_forces_are_fitted(run, force, tmp_path):
    dataset.write(force, "force.nc")
    rows = [f"{s},{f},nN" for s, f in (("a", 90), ("a", 110), ("a", 100), ("b", 60), ("b", 62))]
    (tmp_path / "my.csv").write_text("\n".join(["surface,value,unit", *rows]))
    parameters = {"samples": 200, "confidence": 0.95, "seed": 1}
    inputs = {name: f"{name}.nc" for name in ("adhesion", "force", "topography")}
    fit = run("fit_forces", parameters, **inputs, forces="my.csv")
    assert fit.tests.values.tolist() == [3, 2] and fit.attrs["basis"] == "measured"
    np.testing.assert_allclose(fit.measured_force, [100e-9, 61e-9])


def test_edges_are_found(run):
    rng = np.random.default_rng(2)
    unfiltered = np.exp(0.2 * rng.standard_normal((2, 2, 2, 4, 4)))
    ratio = np.array([[1.0, 1.3, np.nan, np.nan], [np.nan, np.nan, 1.4, 1.02]])
    ratio = ratio[..., None, None] * np.exp(0.02 * rng.standard_normal((2, 2, 2, 4, 4, 4)))
    dims = ("surface", "realization", "side")
    masters = xr.Dataset(
        {
            "pull_off_force": (
                (*dims, "cutoff_wavelength", *CONTACTS), ratio * unfiltered[:, :, :, None],
            ),
            "unfiltered_pull_off_force": ((*dims, *CONTACTS), unfiltered),
            "unfiltered_wavelength": (("surface", "side"), [[1.0, 5e3]] * 2),
            **NAMES,
        },
        {
            "surface": ["a", "b"],
            "realization": [1, 2],
            "side": ["small", "large"],
            "cutoff_wavelength": [20.0, 50.0, 1000.0, 2000.0],
        },
        {"rho": 5.6, "sphere_radius": 5e3},
    )  # fmt: skip
    means = (masters[name].mean(CONTACTS) for name in list(masters)[:2])
    dataset.write(masters.assign(ratio=next(means) / next(means)), "scales.nc")
    parameters = {"scans": {"a": 1, "b": 1}, "tiles": 1, "tolerance": 0.1, "confidence": 0.95}
    edges = run("find_band_edges", parameters, scales="scales.nc")
    assert (edges.edge_status == "found").all() and edges.edge_interval.notnull().any()
    assert edges.conditional.values.tolist() == [1, 1]
    assert edges.pooled_edge.sizes == {"side": 2}


def test_spectra_go_with_their_surfaces_in_any_order(run):
    parameters = {"surfaces": ["b", "a"], "labels": {"a": "A", "b": "B"}, "descriptions": {}}
    files = {}
    for name, level in (("b", 2.0), ("a", 1.0)):
        bands = pd.DataFrame(
            {"longest_nm": [1e4], "shortest_nm": [1.0], "basis": ["measured"], "source": [name]}
        )
        stored = spectrum_dataset(level * WAVEVECTORS**-3.0).assign_attrs(
            basis="substitute", calibrated_to_table1="", bands=bands.to_csv(index=False)
        )
        dataset.write(described_spectrum(stored, f"{name}.csv"), f"{name}.nc")
        files[name] = f"{name}.nc"
    spectra = run("aggregate_spectra", parameters, spectra=list(files.values()))
    for name, level in (("a", 1.0), ("b", 2.0)):
        of_surface = spectra.sel(surface=name)
        assert of_surface.label.item() == name.upper() and of_surface.notes.item() == name
        np.testing.assert_allclose(of_surface.spectrum, level * WAVEVECTORS**-3.0)
