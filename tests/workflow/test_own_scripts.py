"""The scripts of own surfaces: files in, files out."""

import runpy
from types import SimpleNamespace

import numpy as np
import pytest
import xarray as xr
from repository import ROOT

from hardcontact.records import dataset
from hardcontact.records.origin import canonical

CONTACTS = ("contact_y", "contact_x")
NAMES = {"label": ("surface", ["A", "B"]), "basis": ("surface", ["measured"] * 2)}


class Named(list):
    """Files by name or place, as Snakemake gives them."""

    def __init__(self, **files):
        super().__init__(files.values())
        vars(self).update(files)


@pytest.fixture
def run(tmp_path, monkeypatch):
    """Run a script on files of the folder and return what it wrote."""
    monkeypatch.chdir(tmp_path)
    # A job that fails ends its process, which here is that of all tests.
    monkeypatch.setattr("hardcontact.records.log.os._exit", lambda code: pytest.fail("job failed"))

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


SIZES = {"a": 2500.0, "b": 2500.0}


def test_forces_are_predicted(run):
    dataset.write(adhesion(), "adhesion.nc")
    parameters = {"work": 0.05, "rho": 2.0, "sizes": SIZES, "confidence": 0.95}
    force = run("predict_force", parameters, adhesion="adhesion.nc")
    assert force.force.sel(surface="a", rho=2.0).values == pytest.approx(1e-7, rel=0.2)
    assert force.attrs["work_of_adhesion"] == 0.05


def test_own_forces_are_fitted(run, tmp_path):
    dataset.write(adhesion(), "adhesion.nc")
    rows = [f"{s},{f},nN" for s, f in (("a", 90), ("a", 110), ("a", 100), ("b", 60), ("b", 62))]
    (tmp_path / "my.csv").write_text("\n".join(["surface,value,unit", *rows]))
    parameters = {"sizes": SIZES, "samples": 200, "confidence": 0.95, "seed": 1}
    fit = run("fit_forces", parameters, adhesion="adhesion.nc", forces="my.csv")
    assert fit.tests.values.tolist() == [3, 2] and fit.attrs["basis"] == "measured"
    np.testing.assert_allclose(fit.measured_force, [100e-9, 61e-9])


def test_edges_are_found(run):
    rng = np.random.default_rng(2)
    unfiltered = np.exp(0.2 * rng.standard_normal((2, 2, 2, 4, 4)))
    ratio = np.array([[1.0, 1.3, np.nan, np.nan], [np.nan, np.nan, 1.4, 1.02]])
    ratio = ratio[..., None, None] * np.exp(0.02 * rng.standard_normal((2, 2, 2, 4, 4, 4)))
    dims = ("surface", "realization", "side")
    scales = xr.Dataset(
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
    means = (scales[name].mean(CONTACTS) for name in list(scales)[:2])
    dataset.write(scales.assign(ratio=next(means) / next(means)), "scales.nc")
    parameters = {"scans": {"a": 1, "b": 1}, "tiles": 1, "tolerance": 0.1, "confidence": 0.95}
    edges = run("find_band_edges", parameters, scales="scales.nc")
    assert (edges.edge_status == "found").all() and edges.edge_interval.notnull().any()
    assert edges.conditional.values.tolist() == [1, 1]
    assert edges.pooled_edge.sizes == {"side": 2}
