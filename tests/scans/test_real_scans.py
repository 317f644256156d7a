"""Measured scans have their numbers and no defect, and a study of them has plausible answers."""

import pytest
import xarray as xr
from own_studies import make_study, read_answer, read_quantities
from repository import ROOT

from hardcontact.scans.defects import level_and_list_defects
from hardcontact.scans.reading import list_scans, read_scan
from hardcontact.surfaces.levelling import level_plane

SCANS = ROOT / "../shared/scans"
pytestmark = pytest.mark.skipif(not SCANS.is_dir(), reason="no folder ../shared/scans")

AFM = (SCANS / "afm-10um-512.di").resolve()
CONTAINER = (SCANS / "uncd-demo-container.zip").resolve()
MEMBER = "gain_control_uncd_35.001"


@pytest.mark.parametrize(
    ("path", "dataset", "size", "rms_height"),
    [(AFM, "", 10_000.0, 14.3), (CONTAINER, MEMBER, 100.0, 4.69)],
)
def test_real_scans_have_their_levelled_rms_height(path, dataset, size, rms_height):
    scan = read_scan(path, dataset)
    assert scan.heights.shape == (512, 512)
    assert scan.size == pytest.approx(size)
    assert level_plane(scan).heights.std() == pytest.approx(rms_height, abs=0.05)


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
    assert [measurement.undefined_count for measurement in measurements] == [0, 0, 0]


def test_real_scans_have_no_defect():
    files = [(AFM, ""), *((CONTAINER, dataset) for dataset in list_scans(CONTAINER))]
    assert not any(level_and_list_defects(read_scan(*file)).defects for file in files)


@pytest.mark.system
def test_a_study_of_real_scans_has_plausible_roughness_edges_and_forces(repository):
    results = make_study(repository, "both", CONTAINER, AFM)
    surface = read_quantities(results)["both"]
    assert surface["scan_size"]["value"] == 10_000.0
    assert surface["scan_1_rms_height"]["value"] == pytest.approx(14.3, abs=0.1)
    kinds = xr.load_dataset(results / "spectra.nc")["kind"].values.ravel()
    assert set(kinds) == {"map", "line scan"}
    mean = surface["mean_force"]
    assert mean["low"] < mean["value"] < mean["high"]
    # The paper finds 43 nm, this study 37 nm on UNCD.
    assert 20 < surface["short_edge"]["value"] < 100
    cautions = {note["code"] for note in read_answer(results)["notes"] if note["kind"] == "caution"}
    assert "conditional_intervals" in cautions
    # Waves shorter than the scans show keep the sphere clearly away.
    assert surface["extrapolated_force_short"]["value"] < 0.7 * mean["value"]
