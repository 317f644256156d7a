"""The radius of the tip: where it is stated, which one counts, what is no radius."""

import numpy as np
import pytest
from scan_files import container, heights

from hardcontact.surfaces.scan_heights import stated_tip_radius
from hardcontact.surfaces.scans import read_measurement


def instrument(value, unit):
    return {"instrument": {"parameters": {"tip_radius": {"value": value, "unit": unit}}}}


def test_the_file_counts_before_its_container():
    radius, notes = stated_tip_radius(instrument(12.5, "µm"), instrument(10, "nm"))
    assert radius == pytest.approx(12500.0)
    assert notes == ["tip radius of 1.25e+04 nm stated by the file"]
    radius, notes = stated_tip_radius({}, instrument(10, "nm") | {"description": "tip radius 7 nm"})
    assert (radius, notes) == (10.0, ["tip radius of 10 nm stated by the container"])


@pytest.mark.parametrize(
    ("words", "radius"),
    [
        ("Tip radius: 8 nm.", 8.0),
        ("Initial tip radii - 17 nm. \nFinal tip radii - 26 nm (no image).", 26.0),
        ("Scan sizes - 300 µm. Tip radius - ~5µm.", 5000.0),
        ("tip radius = 12.5 um", 12500.0),
    ],
)
def test_of_radii_in_words_the_largest_counts(words, radius):
    found, (note,) = stated_tip_radius({}, {"description": words})
    assert found == pytest.approx(radius)
    assert f"{radius:.4g} nm" in note and "description" in note


@pytest.mark.parametrize(
    "metadata",
    [
        {},
        {"description": None},
        {"description": "Tip radius unknown. Scan size 10 nm."},
        {"description": "Tip radius 8"},
        {"instrument": {"name": "AFM"}},
        {"instrument": None},
        instrument("sharp", "nm"),
        instrument(8, "V"),
        instrument(8, None),
        instrument(8, ["nm"]),
        instrument([8], "nm"),
        instrument(float("nan"), "nm"),
        instrument(0, "nm"),
        instrument(-8, "nm"),
        instrument(1, "km"),
    ],
)
def test_what_is_no_radius(metadata):
    assert stated_tip_radius(metadata, metadata) == (None, [])


def test_radius_in_a_stylus_file(tmp_path):
    rows = "\n".join(f"{0.1 * k:.1f},{height:.6f}," for k, height in enumerate(heights(40) / 100))
    text = "Scan Parameters,\nStylus,Radius: 2.5 um\nScan Data,\n\nLateral um,Raw Micrometer,\n"
    (tmp_path / "a.csv").write_text(text + rows + "\n")
    measured = read_measurement(tmp_path / "a.csv")
    assert (measured.kind, measured.tip_radius) == ("profile", pytest.approx(2500.0))
    assert measured.pixel_size == pytest.approx(100.0)
    np.testing.assert_allclose(measured.heights, 10 * heights(40), atol=1e-3)


def test_radius_in_a_container(tmp_path):
    np.savetxt(tmp_path / "a.txt", heights())
    entry = {"name": "one", "datafile": {"original": "a.txt"}, "size": [320, 320], "unit": "nm"}
    path = container(
        tmp_path / "a.zip", [entry | instrument(10, "nm")], {"a.txt": tmp_path / "a.txt"}
    )
    assert read_measurement(path, "one").tip_radius == 10.0
