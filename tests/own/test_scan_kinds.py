"""Kinds of scans: a prediction reads them correctly, or names their defect."""

import json

import numpy as np
import pytest
from measurements import map_of
from refusals import assert_says

from hardcontact.base.random import generator
from hardcontact.own.predict import predict, predict_arguments
from hardcontact.surfaces.spectrum import smooth_rolloff

PIXELS = 128
Y, X = np.indices((PIXELS, PIXELS)) - PIXELS / 2


def rough(seed, rms_height, pixel=40.0, hurst=0.8, rolloff=800.0):
    """Return heights in nm of a self-affine map."""
    heights = map_of(
        generator(seed, "cases"), PIXELS, pixel, lambda q: smooth_rolloff(q, 1e6, rolloff, hurst)
    ).heights
    return heights * (rms_height / heights.std())


def predicted(path, heights, pixel=40.0, *options):
    """Write a text as Gwyddion does, in metres; return report and numbers of the prediction."""
    size = pixel * heights.shape[1] / 1e3
    head = [f"Width: {size:.4f} µm", f"Height: {size:.4f} µm", "Value units: m"]
    rows = ["\t".join(f"{1e-9 * height:.6e}" for height in row) for row in heights]
    path.write_text("\n".join([*(f"# {line}" for line in head), *rows]), "utf-8")
    numbers = path.with_suffix(".json")
    report = predict(predict_arguments([str(path), "--json", str(numbers), *options]))
    return report, json.loads(numbers.read_text())


WHOLE = rough(1, 8.0) + 35


def test_only_a_scan_with_a_defect_has_a_caution(tmp_path):
    report, _ = predicted(tmp_path / "a.txt", WHOLE)
    assert "a.txt: reliable from" in report and "take care: " + str(tmp_path) not in report
    clipped = np.minimum(WHOLE, np.quantile(WHOLE, 0.9))
    report, _ = predicted(tmp_path / "a.txt", clipped)
    assert_says(report, f"take care: {tmp_path}/a.txt: 10 % of its pixels have the highest value")


def test_the_rms_height_of_a_grating_is_kept(tmp_path):
    """20 nm over the square root of two."""
    grating = 20 * np.cos(2 * np.pi * (X + 0.5) / 16) + rough(6, 0.5)
    report, numbers = predicted(tmp_path / "a.txt", grating)
    assert numbers["rms_height"]["value"] == pytest.approx(14.15, rel=0.1)
    assert "times that across" in report


def test_quadratic_levelling_recovers_the_force_of_a_bowed_scan(tmp_path):
    flat = rough(4, 1.5)
    bowed = flat - (X**2 + Y**2 / 2) * 0.004
    _, flat_numbers = predicted(tmp_path / "flat.txt", flat)
    report, bowed_numbers = predicted(tmp_path / "a.txt", bowed, 40.0, "--levelling", "quadratic")
    force = flat_numbers["pull_off_force"]["value"]
    assert bowed_numbers["pull_off_force"]["value"] == pytest.approx(force, rel=0.05)
    assert "curvature" not in report


def test_a_cleavage_face_sticks_like_a_smooth_surface(tmp_path):
    _, numbers = predicted(tmp_path / "a.txt", rough(7, 0.05, 8.0, 0.5, 200.0), 8.0)
    assert 0.97 < numbers["force_ratio"]["value"] <= 1
    assert numbers["short_edge"]["value"] is None and numbers["long_edge"]["value"] is None
