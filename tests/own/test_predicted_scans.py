"""`hardcontact predict` reads scans, names their defects, and predicts from reliable waves."""

import json

import numpy as np
import pytest
import scan_files
from known_spectra import PAPER_CONTACT
from measurements import PIXEL, measurement, random_line, random_map
from prediction_command import predict_json, predict_text
from refusals import assert_says, refusal
from SurfaceTopography import UniformLineScan

from hardcontact.base.arrays import generator
from hardcontact.own.own_spectrum import read_own_spectrum
from hardcontact.scans.joined_spectrum import joined_spectrum
from hardcontact.surfaces.spectrum import spectrum_of_dataset
from hardcontact.theory.closed_form import closed_form

pytestmark = pytest.mark.usefixtures("quick_predictions")


@pytest.mark.parametrize("kind", ["map", "line scan"])
def test_a_scan_is_predicted_from_its_reliable_wavelengths(tmp_path, capsys, kind):
    """The numbers from its file are those of the library from its heights."""
    if kind == "map":
        heights = random_map(generator(3), 128, PIXEL).heights
        path = scan_files.write_scan(tmp_path / "scan.nc", heights.T, (128 * PIXEL, 128 * PIXEL))
    else:
        heights, path = random_line(generator(3), 1024, PIXEL).heights, tmp_path / "scan.xyz"
        scan_files.write_coordinates(UniformLineScan(heights, 1024 * PIXEL, unit="nm"), path)
    joined_scans = joined_spectrum([measurement(heights, PIXEL)], [None])
    spectrum = read_own_spectrum([path]).spectrum
    has_roughness = np.isfinite(joined_scans.joined_psd.values)
    assert spectrum.density == pytest.approx(
        joined_scans.joined_psd.values[has_roughness], rel=1e-4
    )
    assert spectrum.wavelength[-1] >= 4 * PIXEL
    numbers = predict_json(str(path))
    assert f"{path}: reliable from" in capsys.readouterr().err
    force = closed_form(spectrum, PAPER_CONTACT).force
    assert numbers["closed_form_force"]["value"] == pytest.approx(force)
    # The spectrum is extrapolated like those of masters, up to a roll-off beyond the scan.
    force = closed_form(spectrum_of_dataset(joined_scans), PAPER_CONTACT).force
    assert numbers["extrapolated_force"]["value"] == pytest.approx(force, rel=1e-3)
    rolloff = joined_scans.attrs["rolloff"]
    assert numbers["extrapolated_rolloff"]["value"] == pytest.approx(rolloff, rel=1e-3)


def test_the_force_on_pillars_is_not_predicted(tmp_path):
    """Gaussian heights of their spectrum give a hundredth of the sum over the pixels."""
    y, x = np.indices((128, 128)) % 32 - 15.5
    heights = 200.0 * (np.hypot(x, y) < 8) + generator(1).normal(0, 0.3, x.shape)
    path = scan_files.write_scan(tmp_path / "pillars.nc", heights, (5120.0, 5120.0))
    report = predict_text(str(path), "--json", str(tmp_path / "numbers.json"))
    assert_says(
        report, "closed form: no number: the heights are not those of an isotropic Gaussian"
    )
    assert "edge:" not in report and "error was measured" not in report
    numbers = json.loads((tmp_path / "numbers.json").read_text())
    assert numbers["closed_form_force"] == {"value": None, "unit": "N", "status": "steep_sidewalls"}
    smooth = 2 * np.pi * 250e-6 * 0.0463
    assert numbers["smooth_force"]["value"] == pytest.approx(smooth, rel=1e-4)
    assert "short_edge" not in numbers and "extrapolated_force" not in numbers


def test_members_of_a_container_are_joined_or_chosen(tmp_path):
    files = {}
    for number in (1, 2):
        heights, path = random_map(generator(number), 64, 10.0).heights, tmp_path / f"{number}.nc"
        files[path.name] = scan_files.write_scan(path, heights, (640.0, 640.0))
    datasets = [{"name": f"scan {file}", "datafile": {"original": file}} for file in files]
    path = scan_files.write_container(tmp_path / "twin.zip", datasets, files)
    joined_datasets = read_own_spectrum([path])
    second_dataset = read_own_spectrum([path], dataset="scan 2.nc")
    densities = [read_own_spectrum([file]).spectrum.density for file in files.values()]
    assert second_dataset.spectrum.density == pytest.approx(densities[1])
    assert joined_datasets.spectrum.density == pytest.approx(
        np.sqrt(densities[0] * densities[1]), rel=0.05
    )


def test_files_without_a_spectrum_are_refused_in_one_line(tmp_path):
    # Pixels of 50 µm: no wavelength of the spectrum is known, in a line scan or a map.
    rng = np.random.default_rng(3)
    positions = 50.0 * np.arange(64)
    np.savetxt(tmp_path / "line.txt", np.column_stack([positions, rng.normal(0, 0.05, 64)]))
    scan_files.write_scan(tmp_path / "map.nc", rng.normal(0, 50, (64, 64)), (3.2e6, 3.2e6))
    for name in ("line.txt", "map.nc"):
        message = refusal(predict_text, str(tmp_path / name), "--unit", "um")
        assert_says(message, "from 0.1 nm to 100 µm", "found 0", f"{name} from 200 µm (4 pixels)")
        assert message.endswith("is the unit of length right?")
        assert len(message.splitlines()) == 1, message
    (tmp_path / "table.csv").write_text("wavelength,wavelength_unit,c_iso,c_iso_unit\n")
    message = refusal(read_own_spectrum, [tmp_path / "map.nc", tmp_path / "table.csv"])
    assert_says(message, "table.csv: expected one table, or scans alone")
    message = refusal(read_own_spectrum, [tmp_path / "none.csv", tmp_path / "map.nc"])
    assert_says(message, "none.csv: expected a scan, found no such file")
