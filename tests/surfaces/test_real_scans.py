"""Measured scans: their numbers, and a study with one's own scan among substitutes."""

import numpy as np
import pytest
import xarray as xr
from repository import ROOT, copy_repository, run_snakemake

from hardcontact.surfaces.height_map import level
from hardcontact.surfaces.scan_defects import examine
from hardcontact.surfaces.scans import list_scans, read_scan

SCANS = ROOT / "../shared/scans"
pytestmark = pytest.mark.skipif(not SCANS.is_dir(), reason="no folder ../shared/scans")

AFM = (SCANS / "afm-10um-512.di").resolve()
CONTAINER = (SCANS / "uncd-demo-container.zip").resolve()
MEMBER = "gain_control_uncd_35.001"


@pytest.mark.parametrize(
    ("path", "member", "size", "rms_height"),
    [(AFM, "", 10_000.0, 14.3), (CONTAINER, MEMBER, 100.0, 4.69)],
)
def test_real_scans_have_their_levelled_rms_height(path, member, size, rms_height):
    scan = read_scan(path, member)
    assert scan.heights.shape == (512, 512)
    assert scan.size == pytest.approx(size)
    assert level(scan).heights.std() == pytest.approx(rms_height, abs=0.05)


def test_the_real_container_is_read_whole():
    measurements = [read_scan(CONTAINER, dataset) for dataset in list_scans(CONTAINER)]
    assert [measurement.kind for measurement in measurements] == ["line scan", "map", "line scan"]
    tem, afm, stylus = measurements
    assert [measurement.tip_radius for measurement in measurements] == [None, 26.0, 5000.0]
    assert [measurement.file_unit for measurement in measurements] == ["nm", "nm", "mm"]
    assert afm.channel == "Height" and afm.pixel_size == pytest.approx(100 / 512)
    length = (len(tem.heights) - 1) * tem.pixel_size
    assert length == pytest.approx(228.9, abs=tem.pixel_size)  # 76 uneven points
    assert any("resampled" in note for note in tem.notes)
    assert len(stylus.heights) == 3001 and stylus.pixel_size == pytest.approx(99.6, abs=0.05)
    assert not any("resampled" in note for note in stylus.notes)
    assert [measurement.undefined for measurement in measurements] == [0, 0, 0]


def test_real_scans_have_no_defect():
    files = [(AFM, ""), *((CONTAINER, dataset) for dataset in list_scans(CONTAINER))]
    assert not any(examine(read_scan(*file)).defects for file in files)


TABLE = f"""\
surface\tlabel\tscan\tsource\tpath\tdataset
uncd\tmy UNCD\t1\tmeasured\t{AFM}\t
mcd\tMCD\t1\tsubstitute\tresources/spectra/mcd.csv\t
mcd\tMCD\t2\tsubstitute\tresources/spectra/mcd.csv\t
ruby\truby\t1\tsubstitute\tresources/spectra/ruby.csv\t
"""
#: The scan is 512 pixels of 19.5 nm, 1024 when mirrored; masters of more tiles need more pixels.
#: Its relief needs ranges of 0.25 nm or more.
OWN = {
    "study": "own",
    "surfaces": "own.tsv",
    "adhesion": {"ranges": ["0.5 nm", "1 nm", "5.6 nm"]},
    "scales": {"large": {"pixels": 4096}},
    "scan": {"featured_surface": "none"},
    "sets": {"small": {"pixels": 4096}, "large": {"pixels": 4096}},
    "indent": {"surface": "uncd"},
}


@pytest.mark.study
def test_a_study_with_an_own_scan(tmp_path):
    folder = copy_repository(tmp_path / "study")
    (folder / "own.tsv").write_text(TABLE)
    run = run_snakemake(folder, "topography", "adhesion", overlays=[OWN])
    assert run.returncode == 0, run.stdout[-3000:]
    topography = xr.load_dataset(folder / "results/own/topography.nc")
    adhesion = xr.load_dataset(folder / "results/own/adhesion.nc")
    uncd = topography.sel(surface="uncd")
    assert uncd.basis == "measured" and topography.basis.sel(surface="mcd") == "substitute"
    assert float(uncd.rms_height.sel(scan=1)) == pytest.approx(14.3, abs=0.05)
    assert np.isnan(uncd.rms_height.sel(scan=2))
    assert float(uncd.scan_size) == pytest.approx(10_000.0)
    force = adhesion.pull_off_force
    scan_force = force.sel(surface="uncd", scan=1, sphere_scan=1)
    rigid = scan_force.sel(contact_model="rigid")
    plastic = scan_force.sel(contact_model="plastic")
    assert (rigid > 0).all() and (plastic >= rigid).all()
    assert force.sel(surface="uncd", scan=2).isnull().all()
    assert force.sel(surface="mcd", sphere_scan=1).notnull().all()
